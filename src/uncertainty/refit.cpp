#include "uncertainty/refit.hpp"

#include <utility>

#include "estimate/impact_problem.hpp"

namespace recoil {

LeastSquaresOptions refit_options() {
  LeastSquaresOptions options;
  options.function_tolerance = 1e-9;
  options.gradient_tolerance = 1e-10;
  options.parameter_tolerance = 1e-8;
  options.max_iterations = 100;
  options.finish = false;
  options.strategies = {Strategy::gauss_newton, Strategy::box_descent};
  return options;
}

ReweightingOptions refit_reweighting_options() {
  ReweightingOptions options;
  options.minimiser = refit_options();
  options.minimiser.close_enough = 0.3;  // the next round continues from there
  options.parameters = 0.02;
  options.scale = 0.01;
  options.replicate = true;
  return options;
}

LeastSquaresResult refit(const FitResult& fitted, const Observations& sample) {
  const Noise& noise = fitted.weights.noise;
  if (sample.weights_depend_on_fit()) {
    return reweighted_fit(fitted.model, sample, noise, fitted.theta, refit_reweighting_options())
        .run;
  }
  const Weights weights = first_weights(sample, noise);
  return minimise(impact_problem(fitted.model, sample, weights), fitted.theta, refit_options());
}

std::optional<std::vector<double>> estimate_with_constant_moved(const FitResult& fitted,
                                                                std::size_t k, double by) {
  const std::vector<UncertainConstant>& constants = fitted.model.constants;
  Observations data = fitted.data;
  data.constants.clear();
  for (const UncertainConstant& constant : constants) data.constants.push_back(constant.stated);
  data.constants[k] = constants[k].moved(constants[k].stated, by);
  LeastSquaresResult run =
      minimise(impact_problem(fitted.model, data, fitted.weights), fitted.theta, refit_options());
  if (!run.ended()) return std::nullopt;
  return std::move(run.theta);
}

bool has_answer(const LeastSquaresResult& refit, const FitResult& fitted) {
  return refit.ended() && (!refit.covariance.empty() || fitted.covariance.empty());
}

}  // namespace recoil
