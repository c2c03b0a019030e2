#pragma once

#include "predict/capture_contact.hpp"

namespace recoil {

/// The energies of an elastic contact with adhesion, Johnson, Kendall & Roberts (1971), Proc. R.
/// Soc. A 324, 301-313, without damping. All are multiples of
///   (w^5 R^4 / E*^2)^(1/3)  [J].
///
/// Along the equilibrium the load P and the approach delta at contact radius a are
///   P = 4 E* a^3 / (3 R) - sqrt(8 pi w E*) a^(3/2),   delta = a^2 / R - sqrt(2 pi w a / E*),
/// so that with a = alpha (w R^2 / E*)^(1/3) the energy stored against P is
///   U(alpha) = (8/15) alpha^5 - (4/3) sqrt(2 pi) alpha^(7/2) + pi alpha^2.
/// The contact closes at delta = 0 (alpha^3 = 2 pi), rests at P = 0 (alpha^3 = 9 pi / 2) and breaks
/// where d delta / d alpha = 0 (alpha^3 = pi / 8).
struct JkrEnergies {
  double incident = 0.0;  ///< gained from first touch to the depth of the well: 4.60 units [J]
  double rebound = 0.0;   ///< to be paid from that depth to separation: 11.69 units [J]

  /// What is lost in one cycle: 7.09 units [J].
  double lost() const { return rebound - incident; }
};

JkrEnergies jkr_energies(const CaptureContact& contact);

/// The velocity below which the sphere cannot pay that loss, sqrt(2 lost / m) [m/s]. It falls as
/// d^(-5/6). Above it e = sqrt(1 - (V_s / V)^2).
double jkr_capture_velocity(const CaptureContact& contact);

}  // namespace recoil
