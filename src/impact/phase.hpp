#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "impact/phase_rule.hpp"

namespace recoil {

/// One number per node of a PhaseRule.
template <class Pack>
using Nodes = std::array<Pack, PhaseRule::most>;

/// sum_j row[j] values[j] over an even number of nodes.
template <class Pack, std::size_t size>
[[gnu::always_inline]] inline Pack row_times(const double* row,
                                             const std::array<Pack, size>& values,
                                             std::size_t count) {
  Pack even = row[0] * values[0], odd = row[1] * values[1];
  for (std::size_t j = 2; j < count; j += 2) {
    even += row[j] * values[j];
    odd += row[j + 1] * values[j + 1];
  }
  return even + odd;
}

/// The magnitude of the last two Legendre coefficients of the values, a measure of the error.
template <class Pack>
[[gnu::always_inline]] inline Pack defect_of(const PhaseRule& rule, const Nodes<Pack>& values) {
  return abs(row_times(rule.last, values, rule.count)) +
         abs(row_times(rule.last_but_one, values, rule.count));
}

/// Nodes are updated in blocks of this size.
inline constexpr std::size_t phase_block = 4;

/// act(0), ..., act(phase_block - 1), without a loop.
template <class Act>
[[gnu::always_inline]] inline void for_block(const Act& act) {
  [&]<std::size_t... k>(std::index_sequence<k...>) { (act(k), ...); }
  (std::make_index_sequence<phase_block>{});
}

/// Rows `first` to `first` + phase_block - 1 of a matrix times the values. The values of earlier
/// blocks are added last, because they were just computed.
template <class Pack>
[[gnu::always_inline]] inline std::array<Pack, phase_block> block_times(
    const double (*rows)[PhaseRule::most], const Nodes<Pack>& values, std::size_t first,
    std::size_t count) {
  std::array<Pack, phase_block> sums;
  sums.fill(Pack(0.0));
  const auto add = [&](std::size_t from, std::size_t to) {
    for (std::size_t j = from; j < to; ++j) {
      for_block([&](std::size_t i) { sums[i] += rows[first + i][j] * values[j]; });
    }
  };
  add(first, count);
  add(0, first);
  return sums;
}

/// Compression or restitution, from the inner turning point to the other end, at the nodes of a
/// PhaseRule. The energy lost up to a node is the integral of the rate D u dq/ds. u^2 / 2 is the
/// energy at the turning point less the potential energy, plus (compression) or minus (restitution)
/// the energy lost. Successive substitution of the losses converges like M^n / n!, M = integral of
/// D dsigma. The coupling within a block of nodes is solved implicitly, so that a sweep reduces a
/// change of 1e-5 by a factor of 1e-4 to 1e-3, instead of 2e-3 to 1e-2 (median and ninth decile of
/// the benchmark's rebounds). u follows from Newton's method, without a square root or division.
template <class Pack>
struct Phase {
  using Mask = typename Pack::mask_type;

  const PhaseRule& rule;
  Pack length;           ///< of the phase in q
  Nodes<Pack> place;     ///< q
  Nodes<Pack> height;    ///< energy at the inner turning point less the potential energy
  Nodes<Pack> damping;   ///< rate of the loss, per u and s
  Nodes<Pack> lost;      ///< energy lost between the inner turning point and the node
  Nodes<Pack> speed;     ///< |u|
  Nodes<Pack> slowness;  ///< 1 / |u|
  Nodes<Pack> rates;     ///< of the loss, per s
  Pack loss;             ///< of the whole phase
  Pack lowest = 1e300;   ///< smallest u^2 / 2
  Pack defect;           ///< of the rates
  Pack sweeps = 0.0;
  Mask converged{false};

  explicit Phase(const PhaseRule& of) : rule(of) {}

  /// Places the nodes between `deepest` and `end` and evaluates the law there.
  template <class Law>
  [[gnu::always_inline]] void place_nodes(const Law& law, const Pack& deepest, const Pack& end,
                                          const Pack& acts, const Pack& bottom) {
    length = deepest - end;
    for (std::size_t i = 0; i < rule.count; ++i) {
      place[i] = deepest - length * rule.part[i];
      height[i] = bottom - law.potential(place[i]);
      damping[i] = (length * rule.rate[i]) * law.damping(place[i], acts);
    }
  }

  void start_without_losses() {
    for (std::size_t i = 0; i < rule.count; ++i) lost[i] = 0.0;
  }
  /// Starts from the losses that the rates at the nodes of the coarse rule give.
  template <std::size_t few>
  void start_from(const std::array<Pack, few>& coarse_rates) {
    for (std::size_t i = 0; i < rule.count; ++i) {
      lost[i] = row_times(rule.from_few[i], coarse_rates, few);
    }
  }

  /// The integral of D dsigma.
  [[gnu::always_inline]] Pack held() const {
    Nodes<Pack> values = {};
    for (std::size_t i = 0; i < rule.count; ++i) values[i] = damping[i] * slowness[i];
    return row_times(rule.weight, values, rule.count);
  }

  /// Sweeps over the blocks, each with the new losses of earlier blocks, until the losses change by
  /// less than `tolerance` [m V^2]. Converged lanes keep their values.
  /// @param end_tolerance tolerance of the energy at the end [m V^2]
  /// @param place_again places the nodes for the present ends
  /// @param missing the error of the energy at the end for a loss
  /// @param move moves the ends of the lanes of a mask to reduce this error; returns true if any
  ///   moved
  template <bool compression, class PlaceAgain, class Missing, class Move>
  [[gnu::always_inline]] void converge(double tolerance, double end_tolerance,
                                       const PlaceAgain& place_again, const Missing& missing,
                                       const Move& move) {
    constexpr int most_sweeps = 14;
    place_again();
    for (std::size_t i = 0; i < rule.count; ++i) start<compression>(i);
    Pack last_change = 0.0;
    for (int sweep = 0; sweep < most_sweeps && !all_of(converged); ++sweep) {
      const Mask moving = !converged;
      Pack change = 0.0;
      for (std::size_t first = 0; first < rule.count; first += phase_block) {
        const auto next = next_losses<compression>(first);
        for_block([&](std::size_t i) {
          change = max(abs(next[i] - lost[first + i]), change);
          where(moving, lost[first + i]) = next[i];
        });
        follow_block<compression>(first, moving);
      }
      const Pack next_loss = row_times(rule.weight, rates, rule.count);
      const Pack left_over = abs(missing(next_loss));
      where(moving, sweeps) += 1.0;
      // The sum of further changes in a geometric series is change^2 / (last_change - change).
      const Mask close =
          change < 0.1 * tolerance ||
          (change < 1e3 * tolerance && change * change < tolerance * (last_change - change));
      last_change = change;
      const Mask arrived = left_over < end_tolerance;
      converged = converged || (close && arrived);
      const Mask goes = moving && !arrived;
      if (move(goes, next_loss)) {
        place_again();
        for (std::size_t first = 0; first < rule.count; first += phase_block) {
          follow_block<compression>(first, goes);
        }
      }
    }
    for (std::size_t i = 0; i < rule.count; ++i) {
      lowest = min(half_square<compression>(i), lowest);
    }
    loss = row_times(rule.weight, rates, rule.count);
    defect = defect_of(rule, rates);
  }

 private:
  static constexpr double least = 1e-30;  // of u^2, for a finite 1 / u

  template <bool compression>
  [[gnu::always_inline]] Pack half_square(std::size_t i) const {
    return compression ? height[i] + lost[i] : height[i] - lost[i];
  }
  template <bool compression>
  [[gnu::always_inline]] Pack square(std::size_t i) const {
    const Pack half = half_square<compression>(i);
    return max(Pack(least), half + half);
  }
  template <bool compression>
  [[gnu::always_inline]] void start(std::size_t i) {
    speed[i] = sqrt(square<compression>(i));
    slowness[i] = 1.0 / speed[i];
    rates[i] = damping[i] * speed[i];
  }
  /// The losses at the nodes of a block, with the coupling within the block to first order: d(rate)
  /// / d(loss) = +-D dq/ds / u. The coupling is omitted if it is large, for small u near a capture,
  /// where the sweeps would not converge.
  template <bool compression>
  [[gnu::always_inline]] std::array<Pack, phase_block> next_losses(std::size_t first) const {
    constexpr double steepest = 10.0;
    std::array<Pack, phase_block> next = block_times(rule.losses, rates, first, rule.count);
    std::array<Pack, phase_block> more;
    for_block([&](std::size_t k) {
      const std::size_t i = first + k;
      Pack slope = damping[i] * slowness[i];
      where(slope > steepest, slope) = 0.0;
      more[k] = slope * (compression ? next[k] - lost[i] : lost[i] - next[k]);
    });
    for_block([&](std::size_t j) {
      for_block([&](std::size_t k) { next[k] += rule.losses[first + k][first + j] * more[j]; });
    });
    return next;
  }
  /// Updates u and 1 / u of the moving lanes by a Newton step, or by a square root for a long step.
  template <bool compression>
  [[gnu::always_inline]] void follow_block(std::size_t first, const Mask& moving) {
    constexpr double longest = 0.02;  // relative to u; the error is half of the square of the step
    std::array<Pack, phase_block> squares;
    Pack furthest = 0.0;
    for_block([&](std::size_t k) {
      const std::size_t i = first + k;
      squares[k] = square<compression>(i);
      const Pack half = 0.5 * slowness[i];
      const Pack step = (squares[k] - speed[i] * speed[i]) * half;
      furthest = max(abs(step * slowness[i]), furthest);
      where(moving, speed[i]) = speed[i] + step;
      where(moving, slowness[i]) = slowness[i] * (2.0 - speed[i] * slowness[i]);
    });
    const Mask too_long = moving && !(furthest < longest);
    if (any_of(too_long)) {
      for (std::size_t k = 0; k < phase_block; ++k) {
        const Pack root = sqrt(squares[k]);
        where(too_long, speed[first + k]) = root;
        where(too_long, slowness[first + k]) = 1.0 / root;
      }
    }
    for_block([&](std::size_t k) { rates[first + k] = damping[first + k] * speed[first + k]; });
  }
};

}  // namespace recoil
