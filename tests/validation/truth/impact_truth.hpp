#pragma once

namespace recoil {

/// The adhesion of a truth: the ring of Li, Dunn & Brach (1999), Johnson, Kendall & Roberts (1971)
/// or Derjaguin, Muller & Toporov (1975).
enum class TrueAdhesion { ring, jkr, dmt };

/// One sphere in contact, in SI units and over the contact radius a, with the dampings of Li, Dunn
/// & Brach (1999, eq. 5) on the two parts of the force, that of the adhesion taking energy out:
///   m n'' = -F_e (1 + C_H n') + F_a (1 + C_A s),  F_e = K a^3 / r,
///   ring: F_a = 2 pi a f0,                 n = a^2 / r,
///   JKR:  F_a = (6 pi W K a^3)^(1/2),      n = a^2 / r - (8 pi W a / (3 K))^(1/2),
///   DMT:  F_a = 2 pi W r,                  n = a^2 / r,
/// s = -n' on rebound (n' < 0); on approach 0, or -n' when both phases are damped.
struct TrueContact {
  TrueAdhesion law = TrueAdhesion::ring;
  double stiffness = 0.0;  ///< K [Pa]
  double adhesion = 0.0;   ///< f0 at this size [N/m] of the ring, W [J/m2] of JKR and DMT
  double radius = 0.0;     ///< r [m]
  double mass = 0.0;       ///< m [kg]
  double C_H = 0.0;        ///< [s/m]
  double C_A = 0.0;        ///< [s/m]
  bool damped_in_both_phases = false;
};

struct TrueImpact {
  bool rebounded = false;
  double restitution = 0.0;    ///< e [1]; 0 when captured
  double deepest = 0.0;        ///< largest penetration [m]
  double contact_time = 0.0;   ///< [s]; until it turns inwards again when captured
  double adhesion_loss = 0.0;  ///< what the damping of the adhesion takes, of m V^2 / 2 [1]
};

/// One impact at `velocity` [m/s] > 0 from touch (n = 0) to the least n, by GSL's Dormand-Prince
/// 8(7) steps at a relative tolerance of 1e-12 along a path on which a changes by n' per unit. The
/// turning point and the release are reached exactly by taking n' or a as the independent variable
/// of the last step (Henon 1982, Physica D 5, 412-414). e is good to 1e-9 and better, except within
/// 1e-6 of the capture velocity.
/// @throws ComputationError when the integration does not end.
TrueImpact true_impact(const TrueContact& contact, double velocity);

}  // namespace recoil
