#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "data/measured_sizes.hpp"

namespace recoil {

/// At how many spheres the mean over the spheres of a point is sampled, and how far out: the nodes
/// lie at z from -spread_reach to spread_reach (`spread_positions`).
inline constexpr std::size_t spread_nodes = 9;
inline constexpr double spread_reach = 2.5;

/// Part of a size distribution in which diameters are spread evenly; z is linear in ln d.
struct SizePiece {
  double from = 0.0;  ///< z of its smallest and
  double to = 0.0;    ///< of its largest diameter; the same for a single diameter
  double weight = 0.0;
  /// A quadrature over it: the weights of the answers at the nodes in that of each of its spheres.
  struct Sphere {
    double weight = 0.0;
    std::array<double, spread_nodes> of_node{};
  };
  std::vector<Sphere> spheres;
};

/// The sizes over which every point of a dataset averages, whatever their distribution. The sphere
/// at z has the diameter d = mean exp(s shape(z)).
struct MixedSizes {
  double spread = 0.0;                       ///< s, standard deviation of ln d [1]; 0: all alike
  std::array<double, spread_nodes> shape{};  ///< of the sphere at each node [1]
  double rate = 0.0;                         ///< d ln d / d z at the stated sizes [1]
  std::shared_ptr<const std::vector<SizePiece>> pieces;
  double slowest_seen = 0.0;  ///< rebounds below it are not seen [m/s]

  bool mixed() const { return spread > 0.0; }
};

/// Spheres spread evenly within each bin; the nodes span all of them. Where the height h of the
/// measuring plane is stated, a rebound slower than (2 g h)^(1/2) at the surface does not reach it.
MixedSizes mixed_sizes_of(const MeasuredSizes& sizes);

}  // namespace recoil
