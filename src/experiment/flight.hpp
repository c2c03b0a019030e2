#pragma once

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace recoil::flight {

/// Free flight between the probe plane and the surface, a height h below it, in vacuum. Velocities
/// are magnitudes [m/s], times [s], heights [m]. Air drag is neglected. At 1e-4 Torr there is
/// none; in air at 1 atm Stokes drag takes 18 mu h / (rho d^2) each way, 0.016 m/s from a 50 um
/// steel sphere over 1 mm.

/// The speed at the surface of a sphere that has speed `at_plane` at the plane:
/// v_s^2 = v_p^2 + 2 g h.
inline double surface_velocity(double at_plane, double height) {
  return std::sqrt(at_plane * at_plane + 2.0 * standard_gravity * height);
}

/// The slowest rebound at the surface that climbs back to the plane: sqrt(2 g h).
inline double slowest_return(double height) { return std::sqrt(2.0 * standard_gravity * height); }

/// The time from the passage down with speed `down` to the passage up with speed `up`:
/// t = (sqrt(down^2 + 2 g h) - down + sqrt(up^2 + 2 g h) - up) / g. The contact itself, below a
/// microsecond, is neglected.
inline double round_trip(double down, double up, double height) {
  return (surface_velocity(down, height) - down + surface_velocity(up, height) - up) /
         standard_gravity;
}

/// The height from which `round_trip` would have taken `time`: with A = g t + down + up,
/// sqrt(down^2 + 2 g h) = (A + (down^2 - up^2) / A) / 2, from which h follows. It may be negative
/// for times that no flight has.
inline double implied_height(double down, double up, double time) {
  const double sum = standard_gravity * time + down + up;
  const double at_surface = 0.5 * (sum + (down * down - up * up) / sum);
  return (at_surface * at_surface - down * down) / (2.0 * standard_gravity);
}

/// The longest time after a passage down with speed `down` at which its rebound can come by.
inline double longest_round_trip(double down, double height) {
  return round_trip(down, 0.0, height);
}

/// The time above the plane after a passage up with speed `up`: 2 v / g.
inline double time_above(double up) { return 2.0 * up / standard_gravity; }

}  // namespace recoil::flight
