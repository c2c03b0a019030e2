#pragma once

#include "experiment/flight.hpp"
#include "experiment/import_table.hpp"

namespace recoil {

/// A sphere's mass density [kg/m3], 0 when it is not known, and the surrounding air.
struct SphereInAir {
  Air air;
  double density = 0.0;
};

/// Is there air with an effect? Below 1e-3 Pa even the smallest sphere is not slowed down.
bool air_acts(const Air& air);

/// Drop height h1 and rebound height h2. In vacuum e = sqrt(h2 / h1), V = sqrt(2 g h1); in air V is
/// the end of the fall and e V the launch that rises to h2 (see AirFlight).
/// sd(e) = (e/2) sqrt((s1/h1)^2 + (s2/h2)^2), sd(V) = (V/2) s1/h1. Where several points come from
/// one height, its error is shared: setting_velocity_sd = (V/2) s1/h1 and sd(e) = (e/2) s2/h2. With
/// `average`, drops from the same height make one point: the mean e, its standard error from their
/// scatter, and s1 once. A rebound height of zero, or an e below `captured_below`, is a capture,
/// and in no mean.
ImportedPoints read_heights(const ImportRequest& request, const SphereInAir& sphere);

/// Flights of duration t between bounces. In vacuum a ball that leaves with v returns after t = 2 v
/// / g and hits with v again, so that V = g t_i / 2 and e = t_{i+1} / t_i at the bounce between
/// them. In air it leaves with the u_i that takes t_i and hits with less, w_i: V = w_i, e = u_{i+1}
/// / w_i. With an error tau of the time of one bounce
///   sd(e) = (tau / t_i) sqrt(1 + e + e^2) sqrt(2),   sd(V) = g tau / sqrt(2)
/// of the vacuum values; the relative errors are the same in air.
/// A cell that is empty splits the launch. The bounce after a stated release height h is a point,
/// V = sqrt(2 g h) in vacuum, e = g t_1 / (2 V), unless the first two flights show that bounces
/// before them are not listed; h is compared with the height that they imply.
ImportedPoints read_intervals(const ImportRequest& request, const SphereInAir& sphere);

}  // namespace recoil
