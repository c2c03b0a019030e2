#include "uncertainty/refit.hpp"

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
  options.parameters = 0.02;
  options.scale = 0.01;
  return options;
}

LeastSquaresResult refit(const ImpactModel& model, const Observations& sample,
                         std::span<const double> start) {
  if (sample.weights_depend_on_fit()) {
    return reweighted_fit(model, sample, start, refit_reweighting_options()).run;
  }
  return minimise(impact_problem(model, sample), start, refit_options());
}

bool has_answer(const LeastSquaresResult& refit, const FitResult& fitted) {
  return refit.ended() && (!refit.covariance.empty() || fitted.covariance.empty());
}

}  // namespace recoil
