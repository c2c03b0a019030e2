#pragma once

namespace recoil {

/// One sphere under Johnson, Kendall & Roberts (1971) or Derjaguin, Muller & Toporov (1975), in SI
/// units and over the contact radius a, with the dampings of Li, Dunn & Brach (1999) on the two
/// parts of the force:
///   m n'' = -F_e (1 + C_H n') + F_a (1 + C_A s),
///   JKR: F_e = K a^3 / r, F_a = (6 pi W K a^3)^(1/2), n = a^2 / r - (8 pi W a / (3 K))^(1/2),
///   DMT: F_e = K a^3 / r, F_a = 2 pi W r,             n = a^2 / r,
/// s = -n' on rebound (n' < 0); on approach 0, or -n' when both phases are damped.
struct AdhesiveContact {
  bool jkr = true;         ///< else DMT
  double stiffness = 0.0;  ///< K [Pa]
  double work = 0.0;       ///< W [J/m2]
  double radius = 0.0;     ///< r [m]
  double mass = 0.0;       ///< m [kg]
  double C_H = 0.0;        ///< [s/m]
  double C_A = 0.0;        ///< [s/m]
  bool damped_in_both_phases = false;
};

/// e [1] of one impact at `velocity` [m/s] > 0, 0 when captured: from touch (n = 0) to the least n,
/// by GSL's Dormand-Prince 8(7) steps at a relative tolerance of 1e-12 along a path on which a
/// changes by n' per unit. Turning point and release are reached exactly, as under
/// `ring_adhesion_impact`.
/// @throws ComputationError when the integration does not end.
double adhesive_restitution(const AdhesiveContact& contact, double velocity);

}  // namespace recoil
