#pragma once

#include <Eigen/Dense>
#include <vector>

#include "estimate/model.hpp"
#include "estimate/observation.hpp"

namespace recoil {

/// The expected scatter of the impacts of a planned point.
struct PlannedScatter {
  double scatter = 0.05;          ///< sd of e of one impact, over e [1]
  double floor = 0.01;            ///< the part of that sd that does not depend on e [1]
  double spread = 0.05;           ///< relative sd of the capture velocity from impact to impact [1]
  double velocity_error = 0.0;    ///< relative sd of V, shared by the impacts of a point [1]
  double diameter_error = 0.0;    ///< relative sd of d, shared by the impacts of a point [1]
  bool rebound_measured = false;  ///< e is a quotient of two velocities and shares the error of V
  int events = 20;                ///< number of impacts of one point
};

/// The expected result of one planned point.
struct PointOutlook {
  double information = 0.0;  ///< Fisher information about its e^2: 1 / variance [1]
  double captured = 0.0;     ///< expected captured share of its impacts [1]
  double restitution = 0.0;  ///< expected mean e of those that rebound [1]
  double sd = 0.0;           ///< sd of that mean [1]; 0 if less than half an impact rebounds
};

/// The Fisher information about e^2 of a point, under the likelihood with which points are fitted
/// (`weighted_residual`). m is its e^2, continued below zero for a capture; m_V and m_d are d m / d
/// ln V and d m / d ln d. Let z = m / s, with s = spread |m_V| the scatter of e^2 from impact to
/// impact and tau its error from the errors of V and d. Near capture (m < 30 s)
///   I = n_eff phi(z)^2 / (Phi(z) Phi(-z)) / (s^2 + tau^2)        from the count of captures
///     + G'(z)^2 / s / (sd_mean^2 + G'(z)^2 tau^2 / s)            from the mean of the rebounds,
/// with G of `root_of_positive_normal`. Elsewhere it is 1 / w^2, w^2 = sd^2 (4 psi^2 + 2 sd^2) +
/// tau^2, times the information of a normal deviate censored at 0 (Amemiya, T. (1973), Econometrica
/// 41, 997-1016).
PointOutlook point_outlook(double m, double m_V, double m_d, const PlannedScatter& scatter);

/// The parameters that an experiment must determine together: the free ones in relative terms (d ln
/// theta; theta itself where it is 0), and the material constants in units of their standard
/// deviations. The points may determine the constants, too, as in a fit with Materials::adjusted: a
/// fit that holds the constants has at least these errors.
struct PlannedParameters {
  std::vector<std::size_t> slots;
  std::vector<double> unit;  ///< unit of each parameter, in the unit of the slot
  Eigen::MatrixXd known;     ///< information before any point: 1 for a constant, 0 otherwise
};
PlannedParameters planned_parameters(const ImpactModel& model, const std::vector<double>& theta);

/// Points that could be measured, with their expected results.
struct PossiblePoints {
  std::vector<PointConditions> at;
  std::vector<PointOutlook> outlook;
  Eigen::MatrixXd slopes;  ///< d e^2 / d PlannedParameters [points x p]

  /// `slopes` times the square root of the information: rows of a DesignProblem.
  Eigen::MatrixXd rows() const;
};

/// The possible points at the conditions `at`.
/// @param scatter per dataset
/// @throws ComputationError if an impact cannot be solved
PossiblePoints possible_points(const ImpactModel& model, const std::vector<double>& theta,
                               const PlannedParameters& parameters, std::vector<PointConditions> at,
                               const std::vector<PlannedScatter>& scatter);

}  // namespace recoil
