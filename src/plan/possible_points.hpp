#pragma once

#include <Eigen/Dense>
#include <vector>

#include "estimate/fit_spec.hpp"
#include "estimate/model.hpp"
#include "estimate/observation.hpp"
#include "plan/plan_result.hpp"
#include "plan/point_outlook.hpp"

namespace recoil {

/// The parameters that an experiment has to determine together, in relative terms: those that are
/// free (d ln theta; theta itself where it is 0), and the constants of the materials in their
/// standard deviations, which are known with an error of 1.
struct PlannedParameters {
  std::vector<std::size_t> slots;
  std::vector<double> unit;  ///< of each: what 1 stands for, in that of the slot
  Eigen::MatrixXd known;     ///< information about them before any point
};
PlannedParameters planned_parameters(const ImpactModel& model, const std::vector<double>& theta);

/// Points that could be made, and what each of them would tell.
struct PossiblePoints {
  std::vector<PointConditions> at;
  std::vector<PointOutlook> outlook;
  std::vector<double> square;  ///< e^2, continued below zero
  Eigen::MatrixXd slopes;      ///< d e^2 / d PlannedParameters [points x p]

  /// `slopes` times the root of the information: rows of a DesignProblem.
  Eigen::MatrixXd rows() const;
};

/// How one point of the dataset will scatter: the options, and the errors of V and d as the fit
/// states them.
PlannedScatter planned_scatter(const PlanOptions& options, const NoiseSpec& noise,
                               const Dataset& dataset);

/// @throws ComputationError where the model has no answer
PossiblePoints possible_points(const ImpactModel& model, const std::vector<double>& theta,
                               const PlannedParameters& parameters, std::vector<PointConditions> at,
                               const std::vector<PlannedScatter>& scatter);

}  // namespace recoil
