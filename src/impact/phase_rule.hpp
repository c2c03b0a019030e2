#pragma once

#include <array>
#include <cstddef>

#include "impact/gauss_rule.hpp"

namespace recoil {

/// How the second phase of an impact ends.
enum class PhaseEnd { release, outer_turning_point };

/// The nodes of a phase: part[i] is how far the i-th lies on the way from the inner turning point
/// to the other end, rate[i] its derivative in s. Where u vanishes it does so like a root of the
/// way, so that u is smooth in s: the way is s^2 (1 + c (1 - s^2)), or sin^2(pi s / 2) if u
/// vanishes at both ends.
template <class Owner, std::size_t count, PhaseEnd end>
struct PhaseRule {
  GaussRule<Owner, count> gauss = GaussRule<Owner, count>::made();
  std::array<double, count> part = {}, rate = {};
  /// Draws the nodes a little towards the release, where adhesion brings zeros of u close to the
  /// way. The best for 12 and 16 nodes on the shipped fits, of 0, 0.15, 0.3, 0.45 and 0.6.
  static constexpr double crowding = 0.15;
  /// sum_j losses[i][j] f(s_j) = integral up to node i of an f that vanishes where u does.
  std::array<std::array<double, count>, count> losses = {};
  /// The same from the nodes of the rule with `few` of them.
  static constexpr std::size_t few = 8;
  std::array<std::array<double, few>, count> from_few = {};

  static constexpr PhaseRule made() {
    PhaseRule rule;
    constexpr auto coarse = GaussRule<Owner, few>::made();
    constexpr bool both = end == PhaseEnd::outer_turning_point;
    constexpr auto of_few = coarse.vanishing(both);
    const auto of_all = rule.gauss.vanishing(both);
    for (std::size_t i = 0; i < count; ++i) {
      const double s = rule.gauss.node[i];
      if (end == PhaseEnd::release) {
        rule.part[i] = s * s * (1.0 + crowding * (1.0 - s * s));
        rule.rate[i] = 2.0 * s * (1.0 + crowding * (1.0 - 2.0 * s * s));
      } else {
        constexpr double pi = 3.1415926535897932;
        const double sine = sine_of_quarters(s);
        rule.part[i] = sine * sine;
        rule.rate[i] = pi * sine * sine_of_quarters(1.0 - s);
      }
      rule.losses[i] = rule.gauss.integral_up_to(s, of_all);
      rule.from_few[i] = coarse.integral_up_to(s, of_few);
    }
    return rule;
  }
};

template <class Owner, std::size_t count, PhaseEnd end>
inline constexpr auto phase_rule = PhaseRule<Owner, count, end>::made();

}  // namespace recoil
