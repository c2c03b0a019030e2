#pragma once

namespace recoil {

/// How the impacts of a planned point will scatter.
struct PlannedScatter {
  double scatter = 0.05;          ///< sd of one impact's e, over e [1]
  double floor = 0.01;            ///< and its part that does not depend on e [1]
  double spread = 0.05;           ///< sd of the capture velocity from impact to impact, over it [1]
  double velocity_error = 0.0;    ///< sd of V over V, shared by the impacts of a point [1]
  double diameter_error = 0.0;    ///< the same of d [1]
  bool rebound_measured = false;  ///< e is the quotient of two velocities: it shares the error of V
  int events = 20;                ///< impacts of one point
};

/// What one planned point will tell.
struct PointOutlook {
  double information = 0.0;  ///< about its e^2: 1 / variance [1]
  double captured = 0.0;     ///< expected share of its impacts [1]
  double restitution = 0.0;  ///< expected mean e of those that rebound [1]
  double sd = 0.0;           ///< of that mean; 0 where less than half an impact rebounds [1]
};

/// The Fisher information about e^2 of a point, under the likelihood with which points are fitted
/// (`weighted_residual`), where m is its e^2 (continued below zero for a capture) and m_V, m_d are
/// d m / d ln V, d m / d ln d. With z = m / s, s = spread |m_V| the scatter of e^2 from impact to
/// impact and tau its error by those of V and d, near capture (m < 30 s)
///   I = n_eff phi(z)^2 / (Phi(z) Phi(-z)) / (s^2 + tau^2)        from the count of captures
///     + G'(z)^2 / s / (sd_mean^2 + G'(z)^2 tau^2 / s)            from the mean of the rebounds,
/// G of `root_of_positive_normal`; elsewhere 1 / w^2, w^2 = sd^2 (4 psi^2 + 2 sd^2) + tau^2, times
/// that of a normal deviate censored at 0 (Amemiya, T. (1973), Econometrica 41, 997-1016).
PointOutlook point_outlook(double m, double m_V, double m_d, const PlannedScatter& scatter);

}  // namespace recoil
