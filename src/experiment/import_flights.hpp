#pragma once

#include "experiment/imported_points.hpp"

namespace recoil {

/// e = sqrt(h2 / h1), V = sqrt(2 g h1) without air;
/// sd(e) = (e/2) sqrt((s1/h1)^2 + (s2/h2)^2), sd(V) = (V/2) s1/h1. With `average`, drops from the
/// same height make one point: the mean e, its standard error from their scatter, and s1 once.
ImportedPoints read_heights(const ImportRequest& request);

/// Flights of duration t between bounces: a ball that leaves with v is back after t = 2 v / g and
/// hits with v again, so that V = g t_i / 2 and e = t_{i+1} / t_i at the bounce between them. With
/// an error tau of the time of one bounce
///   sd(e) = (tau / t_i) sqrt(1 + e + e^2) sqrt(2),   sd(V) = g tau / sqrt(2).
/// The release height, where it is given, is compared with what the first two flights say of it.
ImportedPoints read_intervals(const ImportRequest& request);

}  // namespace recoil
