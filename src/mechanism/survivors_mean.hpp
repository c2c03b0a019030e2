#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "mechanism/mechanism.hpp"

namespace recoil {

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

/// The weights of the nodes in the interpolating polynomial at z.
std::array<double, spread_nodes> interpolation_weights(double z);

/// The e^2 of a point whose spheres differ: the square of the mean e of the rebounds. `squares[k]`
/// is e^2, continued below zero, of the sphere at spread_positions()[k]; a polynomial interpolates
/// between them. If all spheres are captured, the value continues below zero with the e^2 of the
/// last one, with a continuous slope. For equal spheres the result is their e^2.
/// @param seen rebounds with a smaller e^2 are not detected, and excluded like captures
/// @param sizes the stated distribution; otherwise z is normal
template <class T>
T survivors_square(std::span<const T> squares, const T& seen, const MixedSizes& sizes = {});

}  // namespace recoil
