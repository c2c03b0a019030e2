#pragma once

#include <array>
#include <cstddef>

#include "data/measured_sizes.hpp"

namespace recoil {

/// At how many spheres the mean over the spheres of a point is sampled, and how far out, in
/// standard deviations of a normal variable z that stands for what makes them differ.
inline constexpr std::size_t spread_nodes = 9;
inline constexpr double spread_reach = 2.5;

/// The sizes over which every point of a dataset averages, whatever their distribution: its
/// quantile of (Phi(z) - Phi(-reach)) / (Phi(reach) - Phi(-reach)) is the diameter at z.
struct MixedSizes {
  double spread = 0.0;                       ///< s, standard deviation of ln d [1]; 0: all alike
  std::array<double, spread_nodes> shape{};  ///< ln(d / mean) / s of the sphere at each node
  double slowest_seen = 0.0;                 ///< rebounds below it are not seen [m/s]

  bool mixed() const { return spread > 0.0; }
};

/// Spheres spread evenly within each bin. Where the height h of the measuring plane is stated, a
/// rebound slower than (2 g h)^(1/2) at the surface does not reach it.
MixedSizes mixed_sizes_of(const MeasuredSizes& sizes);

}  // namespace recoil
