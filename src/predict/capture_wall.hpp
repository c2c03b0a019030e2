#pragma once

namespace recoil {

/// The capture velocity of Wall, John, Wang & Goren (1990), Aerosol Sci. Technol. 12, 926-946, as
/// eq. 4 of Li, Dunn & Brach (1999):
///   V* = (-2 dE / (m e^2))^(1/2),   dE = E_r - E_i,   e = (1 - K_1 / K_i)^(1/2)  (eq. 3),
/// K_1 being the kinetic energy that the impact itself loses out of K_i. For the root to be real dE
/// is negative: here the energies are those of the bound states, which lie below zero, so that a
/// bond that is stronger on parting has dE < 0. (Eq. 1 counts the same energies as positive.)
///
/// @param mass m [kg], > 0
/// @param restitution e [1], 0 < e <= 1
/// @param energy_difference dE [J]
/// @return V* [m/s]; 0 where dE >= 0, because then nothing is captured
double wall_capture_velocity(double mass, double restitution, double energy_difference);

}  // namespace recoil
