#pragma once

#include <array>
#include <cstddef>
#include <experimental/simd>

namespace recoil {

template <class Pack>
[[gnu::always_inline]] inline Pack pack_larger(Pack a, const Pack& b) {
  where(a < b, a) = b;
  return a;
}
template <class Pack>
[[gnu::always_inline]] inline Pack pack_smaller(Pack a, const Pack& b) {
  where(b < a, a) = b;
  return a;
}

template <class Pack, std::size_t count>
[[gnu::always_inline]] inline Pack row_times(const std::array<double, count>& row,
                                             const std::array<Pack, count>& values) {
  Pack even = row[0] * values[0], odd = row[1] * values[1];
  for (std::size_t j = 2; j < count; j += 2) {
    even += row[j] * values[j];
    odd += row[j + 1] * values[j + 1];
  }
  return even + odd;
}

/// How many nodes are put in together.
inline constexpr std::size_t phase_block = 4;

/// The integrals of the values up to the nodes `first`, ..., `first` + phase_block - 1. The nodes
/// before them come last, as these values have just been put in.
template <class Rule, class Pack, std::size_t count>
[[gnu::always_inline]] inline std::array<Pack, phase_block> integrals_up_to(
    const Rule& rule, const std::array<Pack, count>& values, std::size_t first) {
  static_assert(count % phase_block == 0);
  std::array<Pack, phase_block> sums;
  sums.fill(Pack(0.0));
  const auto add = [&](std::size_t from, std::size_t to) {
    for (std::size_t j = from; j < to; ++j) {
      for (std::size_t i = 0; i < phase_block; ++i) {
        sums[i] += rule.gauss.up_to[first + i][j] * values[j];
      }
    }
  };
  add(first, count);
  add(0, first);
  return sums;
}

/// Compression or restitution, from the inner turning point to its other end, at the nodes of a
/// PhaseRule. What is lost up to a node is the integral of the rate D u dq/ds, in which u^2 / 2 is
/// the energy at the turning point less the potential energy, more (compression) or less
/// (restitution) what is lost. Putting the losses in again and again converges like M^n / n!,
/// M = integral of D dsigma.
template <class Pack, std::size_t count>
struct Phase {
  using Mask = typename Pack::mask_type;
  using Nodes = std::array<Pack, count>;

  Pack length;          ///< of the way
  Nodes place;          ///< q
  Nodes height;         ///< energy at the inner turning point less the potential energy
  Nodes damping;        ///< of the loss, per u and s
  Nodes lost = {};      ///< from the inner turning point to the node
  Nodes speed;          ///< u without its sign
  Nodes rates;          ///< of the loss, per s
  Pack loss;            ///< of the whole phase
  Pack lowest = 1e300;  ///< u^2 / 2
  Pack defect;          ///< the two last coefficients of the rates
  Pack sweeps = 0.0;
  Mask settled{false};

  /// Where the nodes are, and what the law says there.
  template <class Rule, class Law>
  [[gnu::always_inline]] void look(const Rule& rule, const Law& law, const Pack& deepest,
                                   const Pack& end, const Pack& acts, const Pack& bottom) {
    length = deepest - end;
    for (std::size_t i = 0; i < count; ++i) {
      place[i] = deepest - length * rule.part[i];
      height[i] = bottom - law.potential(place[i]);
      damping[i] = (length * rule.rate[i]) * law.damping(place[i], acts);
    }
  }

  /// What the rates at the nodes of a coarse rule say about the losses at those of this one.
  template <class Rule, std::size_t few>
  [[gnu::always_inline]] void refine(const Rule& rule, const Phase<Pack, few>& coarse) {
    for (std::size_t i = 0; i < count; ++i) lost[i] = row_times(rule.from_few[i], coarse.rates);
    sweeps = coarse.sweeps;
  }

  /// Puts in the losses, block by block, each with what those before it have just become, until
  /// they change by less than `settle_below` [m V^2]. Lanes that have settled are left as they are.
  /// @param missing what the energy at the end misses with this loss
  /// @param move where the end goes for that
  template <bool compression, class Rule, class Look, class Missing, class Move>
  [[gnu::always_inline]] void settle(const Rule& rule, double settle_below, const Look& look_again,
                                     const Missing& missing, const Move& move) {
    constexpr int most_sweeps = 14;
    for (int sweep = 0; sweep < most_sweeps && !all_of(settled); ++sweep) {
      look_again();
      if (sweep == 0) {
        for (std::size_t i = 0; i < count; ++i) rates[i] = rate<compression>(i);
      }
      const Mask moving = !settled;
      Pack change = 0.0;
      for (std::size_t first = 0; first < count; first += phase_block) {
        const auto next = integrals_up_to(rule, rates, first);
        for (std::size_t i = 0; i < phase_block; ++i) {
          change = pack_larger(change, Pack(abs(next[i] - lost[first + i])));
          where(moving, lost[first + i]) = next[i];
          rates[first + i] = rate<compression>(first + i);
        }
      }
      const Pack next_loss = row_times(rule.gauss.weight, rates);
      const Pack left_over = missing(next_loss);
      where(moving, sweeps) += 1.0;
      move(moving, next_loss, left_over);
      settled = settled || pack_larger(change, Pack(abs(left_over))) < settle_below;
    }
    look_again();
    for (std::size_t i = 0; i < count; ++i) {
      lowest = pack_smaller(lowest, half_square<compression>(i));
      speed[i] = root<compression>(i);
      rates[i] = damping[i] * speed[i];
    }
    loss = row_times(rule.gauss.weight, rates);
    defect =
        abs(row_times(rule.gauss.last, rates)) + abs(row_times(rule.gauss.last_but_one, rates));
  }

 private:
  template <bool compression>
  [[gnu::always_inline]] Pack half_square(std::size_t i) const {
    return compression ? height[i] + lost[i] : height[i] - lost[i];
  }
  template <bool compression>
  [[gnu::always_inline]] Pack root(std::size_t i) const {
    const Pack half = pack_larger(half_square<compression>(i), Pack(0.0));
    return sqrt(half + half);
  }
  template <bool compression>
  [[gnu::always_inline]] Pack rate(std::size_t i) const {
    return damping[i] * root<compression>(i);
  }
};

}  // namespace recoil
