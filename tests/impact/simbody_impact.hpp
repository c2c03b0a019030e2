#pragma once

namespace recoil {

/// e of a sphere of radius and mass 1 that hits a half-space at velocity 1, by Simbody: Hertz's
/// contact with C_H. NaN when it has not left after twice the time of an elastic contact.
/// @param accuracy of Simbody's integrator
double restitution_by_simbody(double C_H, double accuracy);

}  // namespace recoil
