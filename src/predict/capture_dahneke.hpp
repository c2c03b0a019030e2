#pragma once

namespace recoil {

/// The capture velocity of Dahneke (1975), J. Colloid Interface Sci. 51, 58-65, as eq. 1 of Li,
/// Dunn & Brach (1999):
///   V* = [(2 / (m e^2)) (E_r - e^2 E_i)]^(1/2),
/// where e is the restitution of the contact itself, the incident energy counted with what the
/// adhesion adds on the way in (eq. 2):
///   e = [(m V_r^2 / 2) / (m V_i^2 / 2 + E_i)]^(1/2) where nothing is to be paid on the way out.
/// Both energies are positive: E_i is gained on the way in, E_r to be paid on the way out.
///
/// @param mass m [kg], > 0
/// @param restitution e [1], 0 < e <= 1
/// @param incident_energy E_i [J], >= 0
/// @param rebound_energy E_r [J], >= 0
/// @return V* [m/s]; 0 where E_r <= e^2 E_i, because then nothing is captured
double dahneke_capture_velocity(double mass, double restitution, double incident_energy,
                                double rebound_energy);

}  // namespace recoil
