#pragma once

namespace recoil {

/// Mean, its derivative and variance of sqrt(u + z) given u + z > 0, z standard normal: the
/// restitution of spheres that were not captured, in units of sqrt(scatter), where u is the
/// predicted e^2 in units of the scatter of e^2 from impact to impact.
///   G(u) = E[sqrt(u + z) | u + z > 0],  G' = E[(u + z)^(3/2) | .] - (u + lambda) G,
///   Var = u + lambda - G^2,  lambda = phi(u) / Phi(u).
/// To 1e-9 relative at any u: the trapezoid rule in sqrt(u + z), whose integrand is even and
/// analytic, interpolated from a table above u = -12, and the asymptotic series above u = 12.
struct RootMoments {
  double mean = 0.0;
  double slope = 0.0;  ///< d mean / d u
  double variance = 0.0;
};
RootMoments root_of_positive_normal(double u);

}  // namespace recoil
