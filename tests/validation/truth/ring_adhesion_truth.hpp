#pragma once

namespace recoil {

/// One sphere of the ring-adhesion model as it stands in the paper, in SI units: eq. 5 of Li, Dunn
/// & Brach (1999) with the adhesion damping always taking energy out,
///   m n'' = -sqrt(r) K n^(3/2) (1 + C_H n') + 2 pi sqrt(r n) f0 (1 + C_A s),
///   s = -n' on rebound (n' < 0); on approach 0, or -n' when both phases are damped.
struct RingAdhesionContact {
  double stiffness = 0.0;       ///< K [Pa]
  double adhesion_force = 0.0;  ///< f0 at this size [N/m]
  double radius = 0.0;          ///< r [m]
  double mass = 0.0;            ///< m [kg]
  double C_H = 0.0;             ///< [s/m]
  double C_A = 0.0;             ///< [s/m]
  bool damped_in_both_phases = false;
};

struct RingAdhesionImpact {
  bool rebounded = false;
  double restitution = 0.0;    ///< e [1]; 0 when captured
  double deepest = 0.0;        ///< largest penetration [m]
  double contact_time = 0.0;   ///< [s]; until it turns inwards again when captured
  double adhesion_loss = 0.0;  ///< what the damping of the adhesion takes, of m V^2 / 2 [1]
};

/// One impact at `velocity` [m/s] > 0, straight from the dimensional equation in (n, n') by GSL's
/// Dormand-Prince 8(7) steps at a relative tolerance of 1e-12. The turning point and the release
/// are reached exactly by exchanging the roles of time and n' (or n) in the last step (Henon 1982,
/// Physica D 5, 412-414). e is good to 1e-9 and better, except within 1e-6 of the capture velocity.
/// @throws ComputationError when the integration does not end.
RingAdhesionImpact ring_adhesion_impact(const RingAdhesionContact& contact, double velocity);

}  // namespace recoil
