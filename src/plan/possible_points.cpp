#include "plan/possible_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "estimate/predictor.hpp"

namespace recoil {

PlannedParameters planned_parameters(const ImpactModel& model, const std::vector<double>& theta) {
  PlannedParameters found;
  std::vector<double> information;
  for (std::size_t j = 0; j < model.slots.size(); ++j) {
    const ParameterSlot& slot = model.slots[j];
    if (!slot.moves()) continue;
    found.slots.push_back(j);
    if (slot.is_constant()) {
      const UncertainConstant& constant = model.constants[j - model.first_constant()];
      found.unit.push_back(1.0 / constant.deviation_slope(theta[j]));
      information.push_back(1.0);
    } else {
      found.unit.push_back(theta[j] != 0.0 ? std::abs(theta[j]) : 1.0);
      information.push_back(0.0);
    }
  }
  const Eigen::Map<const Eigen::VectorXd> diagonal(information.data(),
                                                   static_cast<Eigen::Index>(information.size()));
  found.known = diagonal.asDiagonal();
  return found;
}

PlannedScatter planned_scatter(const PlanOptions& options, const NoiseSpec& noise,
                               const Dataset& dataset) {
  PlannedScatter scatter;
  scatter.scatter = options.scatter;
  scatter.floor = options.floor;
  scatter.spread = options.spread;
  scatter.events = options.events;
  scatter.velocity_error = noise.velocity_relative_sd;
  scatter.diameter_error = noise.diameter_relative_sd;
  scatter.rebound_measured =
      std::any_of(dataset.columns.begin(), dataset.columns.end(),
                  [](const DataColumn& column) { return column.name == "rebound_velocity"; });
  return scatter;
}

PossiblePoints possible_points(const ImpactModel& model, const std::vector<double>& theta,
                               const PlannedParameters& parameters, std::vector<PointConditions> at,
                               const std::vector<PlannedScatter>& scatter) {
  PossiblePoints found;
  found.at = std::move(at);
  PointPredictor predictor(model, found.at);
  predictor.evaluate(theta, true);
  found.slopes.resize(static_cast<Eigen::Index>(found.at.size()),
                      static_cast<Eigen::Index>(parameters.slots.size()));
  std::vector<double> gradient(theta.size());
  for (std::size_t i = 0; i < found.at.size(); ++i) {
    const PointConditions& point = found.at[i];
    if (!predictor.at(i).usable()) {
      throw ComputationError(
          fmt::format("the impact at V = {:.6g} m/s, d = {:.6g} um has no answer", point.velocity,
                      point.diameter / units::um));
    }
    const double square = predictor.at(i).restitution_squared;
    found.square.push_back(square);
    found.outlook.push_back(point_outlook(square, predictor.velocity_slope(i) * point.velocity,
                                          predictor.diameter_slope(i) * point.diameter,
                                          scatter[point.dataset]));
    predictor.gradient_row(i, 1.0, gradient);
    for (std::size_t k = 0; k < parameters.slots.size(); ++k) {
      found.slopes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          gradient[parameters.slots[k]] * parameters.unit[k];
    }
  }
  return found;
}

Eigen::MatrixXd PossiblePoints::rows() const {
  Eigen::VectorXd weights(slopes.rows());
  for (std::size_t i = 0; i < outlook.size(); ++i) {
    weights(static_cast<Eigen::Index>(i)) = std::sqrt(outlook[i].information);
  }
  return weights.asDiagonal() * slopes;
}

}  // namespace recoil
