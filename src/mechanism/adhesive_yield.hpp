#pragma once

namespace recoil {

/// The energy recovered in the impact of a yielding adhesive sphere, with its slopes.
struct AdhesiveYield {
  bool yielded = false;    ///< if false, all energy is recovered and the radius does not change
  double recovered = 0.0;  ///< energy on the way back at zero approach; negative if the sphere
                           ///< does not get there
  double recovered_by_energy = 1.0;   ///< its derivative by `energy`
  double recovered_by_tension = 0.0;  ///< its derivative by `tension`
  double contact = 0.0;               ///< x at the turning point, if it yielded [1]
  double flatness = 1.0;              ///< R_p / R of the unloading [1]
  double flatness_by_energy = 0.0;
  double flatness_by_tension = 0.0;
};

/// The contact of Thornton & Ning (1998), Powder Technol. 99, 154-162, sections 4 and 5, with
/// adhesion at work while it yields. With x = a / a_Y, a_Y = pi R p_Y / (2 E*), forces in units of
/// pi a_Y^2 p_Y, approaches in a_Y^2 / R and energies in E_Y = pi p_Y a_Y^4 / R it has one
/// parameter, the tension of adhesion at a_Y divided by p_Y,
///   kappa = (2 W E* / (pi a_Y))^(1/2) / p_Y.
/// Loading follows JKR's approach x^2 - 2 kappa x^(1/2) from zero on. The pressure x s - kappa
/// x^(-1/2) / s, s = (1 - (r/a)^2)^(1/2), is limited to 1. This holds inside of the root s of x s -
/// kappa x^(-1/2) / s = 1, so that the force is
///   f = x^2 [(1 - s^2) + (2/3) x s^3 - 2 kappa x^(-1/2) s],       s = 1 below the limit.
/// Unloading is JKR with the flattened radius R_p / R = (2/3) x^3 / (f + 2 kappa x^(3/2)) at the
/// turning point, down to zero approach. The work of separation beyond, 7.09 (W^5 R_p^4 /
/// E*^2)^(1/3), is not included.
///
/// @param energy of the sphere at first contact, divided by E_Y [1], > 0
/// @param tension kappa [1], >= 0; 0 is Thornton & Ning's contact without adhesion
/// The work of loading is summed over 10 Gauss-Legendre nodes in x^(1/2), good to 1e-11 of it for
/// x up to 1000 times that at yield.
AdhesiveYield adhesive_yield(double energy, double tension);

}  // namespace recoil
