#include "estimate/impact_problem.hpp"

#include <memory>

#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"

namespace recoil {

LeastSquaresProblem impact_problem(const ImpactModel& model, const Observations& data,
                                   long* handovers) {
  LeastSquaresProblem problem;
  problem.residual_count = data.points.size();
  for (const ParameterSlot& slot : model.slots) {
    problem.lower.push_back(slot.lower);
    problem.upper.push_back(slot.upper);
    problem.log_scale.push_back(slot.log_scale);
    problem.fixed.push_back(!slot.free);
  }
  std::vector<PointConditions> points;
  for (const Observation& point : data.points) {
    points.push_back(point.conditions());
  }
  const auto predictor = std::make_shared<PointPredictor>(model, std::move(points));
  problem.evaluate = [predictor, &data, handovers](std::span<const double> theta,
                                                   std::span<double> residuals,
                                                   std::span<double> jacobian) {
    const std::size_t p = theta.size();
    const long handed_over = predictor->evaluate(theta, !jacobian.empty());
    if (handovers != nullptr) *handovers += handed_over;
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      if (!predictor->at(i).usable()) return false;
      const WeightedResidual r = weighted_residual(
          data.points[i], predictor->at(i).restitution_squared, data.noise.student);
      residuals[i] = r.value;
      if (!jacobian.empty()) predictor->gradient_row(i, r.slope, jacobian.subspan(i * p, p));
    }
    return true;
  };
  return problem;
}

}  // namespace recoil
