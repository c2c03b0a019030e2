#include "estimate/impact_problem.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

#include "core/interrupt.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_errors.hpp"

namespace recoil {
namespace {

double stated_constant(const ImpactModel& model, const Observations& data, std::size_t k) {
  return data.constants.empty() ? model.constants[k].stated : data.constants[k];
}

/// Fills the last rows of residuals and Jacobian, one for each uncertain constant.
void add_constants_rows(const ImpactModel& model, const Observations& data, double weight,
                        std::span<const double> theta, std::span<double> residuals,
                        std::span<double> jacobian) {
  const std::size_t p = theta.size();
  for (std::size_t k = 0; k < model.constants.size(); ++k) {
    const std::size_t row = data.points.size() + k;
    const std::size_t slot = model.first_constant() + k;
    const UncertainConstant& constant = model.constants[k];
    residuals[row] = weight * constant.deviation(theta[slot], stated_constant(model, data, k));
    if (jacobian.empty()) continue;
    const std::span<double> slopes = jacobian.subspan(row * p, p);
    std::fill(slopes.begin(), slopes.end(), 0.0);
    slopes[slot] = weight * constant.deviation_slope(theta[slot]);
  }
}

}  // namespace

std::vector<double> constant_deviations(const ImpactModel& model, const Observations& data,
                                        std::span<const double> theta) {
  std::vector<double> deviations;
  for (std::size_t k = 0; k < model.constants.size(); ++k) {
    deviations.push_back(model.constants[k].deviation(theta[model.first_constant() + k],
                                                      stated_constant(model, data, k)));
  }
  return deviations;
}

LeastSquaresProblem impact_problem(const ImpactModel& model, const Observations& data,
                                   const Weights& weights, std::shared_ptr<PointPredictor> points) {
  LeastSquaresProblem problem;
  problem.residual_count = data.points.size() + model.constants.size();
  for (const ParameterSlot& slot : model.slots) {
    problem.lower.push_back(slot.lower);
    problem.upper.push_back(slot.upper);
    problem.log_scale.push_back(slot.log_scale);
    problem.fixed.push_back(!slot.moves());
  }
  if (!model.constants.empty() && !model.adjusts_constants()) {
    problem.hold = [&model, &data](std::span<double> start) {
      for (std::size_t k = 0; k < model.constants.size(); ++k) {
        start[model.first_constant() + k] = stated_constant(model, data, k);
      }
    };
  }
  const auto predictor =
      points ? std::move(points) : std::make_shared<PointPredictor>(model, data.conditions());
  const auto shared = std::make_shared<const SharedErrors>(data, weights);
  problem.evaluate = [predictor, shared, &model, &data, &weights](std::span<const double> theta,
                                                                  std::span<double> residuals,
                                                                  std::span<double> jacobian) {
    if (called_off()) return false;  // the minimiser ends; its caller then checks for the interrupt
    const std::size_t p = theta.size();
    std::atomic<bool> answered = true;
    const auto take = [&](std::size_t first, std::span<const ImpactResult> answers) {
      for (std::size_t k = 0; k < answers.size(); ++k) {
        const std::size_t i = first + k;
        if (!answers[k].usable()) {
          answered = false;
          return;
        }
        const WeightedResidual r = weighted_residual(
            data.points[i], weights.points[i], answers[k].restitution_squared, data.noise.student);
        residuals[i] = r.value;
        if (jacobian.empty()) continue;
        predictor->gradient_row(i, answers[k], r.slope, jacobian.subspan(i * p, p));
      }
    };
    predictor->evaluate_blocks(theta, !jacobian.empty(), take);
    if (!answered) return false;
    shared->whiten(residuals);
    if (!jacobian.empty()) shared->whiten(jacobian, p);
    if (!model.constants.empty()) {
      add_constants_rows(model, data, weights.noise.constants_weight, theta, residuals, jacobian);
    }
    return true;
  };
  return problem;
}

}  // namespace recoil
