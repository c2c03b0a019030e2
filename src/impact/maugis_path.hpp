#pragma once

namespace recoil {

/// The places on the way of a sphere under MaugisLaw that depend on lambda alone, as s of
/// MaugisContact (below 0 across a gap); energies in pi W r (pi^2 W^2 r / K^2)^(1/3).
struct MaugisPath {
  double start = 0.0;        ///< after the jump in, which is at the approach n = -W / s0
  double start_slope = 0.0;  ///< d start / d lambda
  double release = 0.0;      ///< where it parts: the smallest n
  double resting = 0.0;      ///< P = 0
  double scale = 0.0;        ///< of s, so that start and release are of order one
  double energy_at_release = 0.0;
  double energy_slope = 0.0;    ///< d energy_at_release / d lambda
  double energy_at_rest = 0.0;  ///< less that at the release
  double cusp = 0.0;            ///< half the curvature of the energy in s about the release
};

/// @param lambda from 1e-6 to 1e6
MaugisPath maugis_path(double lambda);

}  // namespace recoil
