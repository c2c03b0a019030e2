#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "mechanism/mechanism.hpp"

namespace recoil {

/// z of the spheres at which a point is sampled: the Chebyshev-Lobatto points of [-spread_reach,
/// spread_reach], where the normal distribution of z is cut off. Among some tens of impacts none
/// lies further out; beyond, the picture "normal" is not known to hold.
const std::array<double, spread_nodes>& spread_positions();

/// The scale that gives the cut distribution the standard deviation 1: what varies with the
/// standard deviation s is s cut_scale() z. 1.0476.
double cut_scale();

/// ln of the mean of exp(s cut_scale() z) over the cut distribution.
template <class T>
T cut_lognormal_mean(const T& s) {
  const auto within = [](const T& shift) {
    return normal_probability(spread_reach - shift) -
           normal_probability(-1.0 * shift - spread_reach);
  };
  const T shift = s * cut_scale();
  return 0.5 * shift * shift + logarithm(within(shift) / within(T(0.0)));
}

/// The weight of each node in the polynomial through all of them, at z.
std::array<double, spread_nodes> interpolation_weights(double z);

/// The e^2 that a point shows when its spheres differ: the square of the mean e of those that come
/// back. `squares[k]` is e^2, continued below zero, of the sphere at spread_positions()[k]; between
/// them it is interpolated by a polynomial. When even the last sphere is captured the value goes on
/// below zero along its e^2, with a slope that is continuous; spheres that are all alike give back
/// their own e^2.
/// @param seen the e^2 below which a rebound is not seen: it is left out of the mean like a capture
/// @param sizes that the spheres have, where they are stated; otherwise z is normal
template <class T>
T survivors_square(std::span<const T> squares, const T& seen, const MixedSizes& sizes = {});

}  // namespace recoil
