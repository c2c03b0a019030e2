#pragma once

#include "data/contact.hpp"

/// Capture velocities of older models.
namespace recoil {

/// The inputs of the older capture models for one sphere on one surface, in SI units.
struct CaptureContact {
  double diameter = 0.0;         ///< [m]
  double density = 0.0;          ///< density of the sphere [kg/m3]
  double reduced_modulus = 0.0;  ///< E* = (3/4) K [Pa]
  double adhesion_energy = 0.0;  ///< w = W_A, the work of adhesion [J/m2]

  double radius() const { return diameter / 2.0; }
  double mass() const { return sphere_mass(diameter, density); }  ///< [kg]
};

/// The contact of a dataset, with the K that its fit uses, at another diameter [m].
CaptureContact capture_contact(const ContactProperties& contact, double diameter);

/// The capture velocity of Dahneke (1975), J. Colloid Interface Sci. 51, 58-65, as eq. 1 of Li,
/// Dunn & Brach (1999):
///   V* = [(2 / (m e^2)) (E_r - e^2 E_i)]^(1/2),
/// where e is the restitution of the contact, whose incident energy includes the energy gained from
/// adhesion on approach (eq. 2):
///   e = [(m V_r^2 / 2) / (m V_i^2 / 2 + E_i)]^(1/2) if no energy is lost to adhesion on rebound.
///   Both energies are positive: E_i is gained on approach, E_r is lost on rebound.
///
/// @param mass m [kg], > 0
/// @param restitution e [1], 0 < e <= 1
/// @param incident_energy E_i [J], >= 0
/// @param rebound_energy E_r [J], >= 0
/// @return V* [m/s]; 0 if E_r <= e^2 E_i, as no sphere is then captured
double dahneke_capture_velocity(double mass, double restitution, double incident_energy,
                                double rebound_energy);

/// The energies of an elastic contact with adhesion, Johnson, Kendall & Roberts (1971), Proc. R.
/// Soc. A 324, 301-313, without damping. All are multiples of
///   (w^5 R^4 / E*^2)^(1/3)  [J].
///
/// Along the equilibrium the load P and the approach delta at contact radius a are
///   P = 4 E* a^3 / (3 R) - sqrt(8 pi w E*) a^(3/2),   delta = a^2 / R - sqrt(2 pi w a / E*),
/// so that with a = alpha (w R^2 / E*)^(1/3) the energy stored against P is
///   U(alpha) = (8/15) alpha^5 - (4/3) sqrt(2 pi) alpha^(7/2) + pi alpha^2.
/// The contact forms at delta = 0 (alpha^3 = 2 pi), is in equilibrium at P = 0 (alpha^3 = 9 pi / 2)
/// and breaks at d delta / d alpha = 0 (alpha^3 = pi / 8).
struct JkrEnergies {
  double incident = 0.0;  ///< gained from first touch to equilibrium: 4.60 units [J]
  double rebound = 0.0;   ///< needed from equilibrium to separation: 11.69 units [J]

  /// Lost in one cycle: 7.09 units [J].
  double lost() const { return rebound - incident; }
};

JkrEnergies jkr_energies(const CaptureContact& contact);

/// The velocity at which the kinetic energy equals that loss, sqrt(2 lost / m) [m/s], proportional
/// to d^(-5/6). Above it e = sqrt(1 - (V_s / V)^2).
double jkr_capture_velocity(const CaptureContact& contact);

/// The sticking velocity of Thornton & Ning (1998), Powder Technology 99, 154-162, with yield [m/s]
/// and adhesion throughout (their sections 4 and 5): the pressure of the JKR contact, p(r) = (2 E*
/// a / (pi R)) s - (2 w E* / (pi a))^(1/2) / s with s = (1 - r^2 / a^2)^(1/2), is limited to p_Y on
/// loading; unloading follows JKR with the flattened radius R_p = 4 E* a*^3 / (3 (F* + (8 pi w E*
/// a*^3)^(1/2))). At the sticking velocity the loading produces a contact that recovers exactly the
/// work of its separation. If adhesion alone makes the contact yield, it does so at touch. p_Y is
/// constant, without hardening.
/// @return the JKR velocity if the sphere does not yield; 0 without adhesion; NaN if it is captured
///   until it is completely flattened
double thornton_ning_plastic_velocity(const CaptureContact& contact, double yield_pressure);

/// The capture velocity of Wall, John, Wang & Goren (1990), Aerosol Sci. Technol. 12, 926-946, as
/// eq. 4 of Li, Dunn & Brach (1999):
///   V* = (-2 dE / (m e^2))^(1/2),   dE = E_r - E_i,   e = (1 - K_1 / K_i)^(1/2)  (eq. 3),
/// with K_1 the kinetic energy out of K_i that the impact itself loses. The root is real for dE <
/// 0: here the energies are those of the bound states, which are negative, so that a bond that is
/// stronger on separation has dE < 0. (Eq. 1 takes the same energies as positive.)
///
/// @param mass m [kg], > 0
/// @param restitution e [1], 0 < e <= 1
/// @param energy_difference dE [J]
/// @return V* [m/s]; 0 if dE >= 0, as no sphere is then captured
double wall_capture_velocity(double mass, double restitution, double energy_difference);

}  // namespace recoil
