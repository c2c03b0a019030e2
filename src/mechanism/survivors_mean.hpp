#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "data/measured_sizes.hpp"
#include "mechanism/dual.hpp"

namespace recoil {

/// The number of nodes for the mean over the spheres of a point, and their range: z from
/// -spread_reach to spread_reach (`spread_positions`).
inline constexpr std::size_t spread_nodes = 9;
inline constexpr double spread_reach = 2.5;

/// Part of a size distribution with a uniform density of diameters; z is linear in ln d.
struct SizePiece {
  double from = 0.0;  ///< z of its smallest diameter
  double to = 0.0;    ///< z of its largest diameter; equal to `from` for a single diameter
  double weight = 0.0;
  /// A sphere of a quadrature over the piece, and the weights that interpolate it from the nodes.
  struct Sphere {
    double weight = 0.0;
    std::array<double, spread_nodes> of_node{};
  };
  std::vector<Sphere> spheres;
};

/// The distribution of sizes over which every point of a dataset averages. The sphere at z has the
/// diameter d = mean exp(s shape(z)).
struct MixedSizes {
  double spread = 0.0;                       ///< s, standard deviation of ln d [1]; 0: equal sizes
  std::array<double, spread_nodes> shape{};  ///< of the sphere at each node [1]
  double rate = 0.0;                         ///< d ln d / d z at the stated sizes [1]
  std::shared_ptr<const std::vector<SizePiece>> pieces;
  double slowest_seen = 0.0;  ///< slower rebounds are not detected [m/s]

  bool mixed() const { return spread > 0.0; }
};

/// The distribution with a uniform density within each bin. The nodes span all bins. If the height
/// h of the measuring plane is stated, rebounds slower than (2 g h)^(1/2) at the surface do not
/// reach it.
MixedSizes mixed_sizes_of(const MeasuredSizes& sizes);

/// z of the nodes: the Chebyshev-Lobatto points of [-spread_reach, spread_reach], where the normal
/// distribution of z is truncated. Among some tens of impacts none is expected outside, and a
/// normal distribution is not known to hold there.
const std::array<double, spread_nodes>& spread_positions();

/// The factor 1.0476 that gives the truncated distribution of z the standard deviation 1: a
/// quantity with the standard deviation s is s cut_scale() z.
double cut_scale();

/// ln of the mean of exp(s cut_scale() z) over the truncated distribution.
template <class T>
T cut_lognormal_mean(const T& s) {
  const auto within = [](const T& shift) {
    return normal_probability(spread_reach - shift) -
           normal_probability(-1.0 * shift - spread_reach);
  };
  const T shift = s * cut_scale();
  return 0.5 * shift * shift + logarithm(within(shift) / within(T(0.0)));
}

/// The e^2 of a point whose spheres differ: the square of the mean e of the rebounds. `squares[k]`
/// is e^2, continued below zero, of the sphere at spread_positions()[k]; a polynomial interpolates
/// between them. If all spheres are captured, the value continues below zero with the e^2 of the
/// last one, with a continuous slope. For equal spheres the result is their e^2.
/// @param seen rebounds with a smaller e^2 are not detected, and excluded like captures
/// @param sizes the stated distribution; otherwise z is normal
template <class T>
T survivors_square(std::span<const T> squares, const T& seen, const MixedSizes& sizes = {});

}  // namespace recoil
