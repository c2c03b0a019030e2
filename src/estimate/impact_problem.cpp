#include "estimate/impact_problem.hpp"

namespace recoil {

LeastSquaresProblem impact_problem(const ImpactModel& model, const Observations& data) {
  LeastSquaresProblem problem;
  problem.residual_count = data.points.size();
  for (const ParameterSlot& slot : model.slots) {
    problem.lower.push_back(slot.lower);
    problem.upper.push_back(slot.upper);
    problem.log_scale.push_back(slot.log_scale);
    problem.fixed.push_back(!slot.free);
  }
  problem.evaluate = [&model, &data](std::span<const double> theta, std::span<double> residuals,
                                     std::span<double> jacobian) {
    const std::size_t p = theta.size();
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      const Observation& point = data.points[i];
      const Prediction at =
          predict(model, theta, point.dataset, point.diameter, point.velocity, !jacobian.empty());
      if (!at.usable()) return false;
      const WeightedResidual r = weighted_residual(point, at.restitution_squared);
      residuals[i] = r.value;
      for (std::size_t j = 0; !jacobian.empty() && j < p; ++j) {
        jacobian[i * p + j] = r.slope * at.gradient[j];
      }
    }
    return true;
  };
  return problem;
}

}  // namespace recoil
