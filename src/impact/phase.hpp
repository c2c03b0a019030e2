#pragma once

#include <array>
#include <cstddef>
#include <experimental/simd>
#include <utility>

namespace recoil {

// b where it is larger (smaller), and a where either is not a number.
template <class Pack>
[[gnu::always_inline]] inline Pack pack_larger(const Pack& a, const Pack& b) {
  return std::experimental::max(b, a);
}
template <class Pack>
[[gnu::always_inline]] inline Pack pack_smaller(const Pack& a, const Pack& b) {
  return std::experimental::min(b, a);
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

/// The two last coefficients of the values.
template <class Gauss, class Pack, std::size_t count>
[[gnu::always_inline]] inline Pack defect_of(const Gauss& gauss,
                                             const std::array<Pack, count>& values) {
  return abs(row_times(gauss.last, values)) + abs(row_times(gauss.last_but_one, values));
}

/// How many nodes are put in together.
inline constexpr std::size_t phase_block = 4;

/// act(0), ..., act(phase_block - 1), without a loop.
template <class Act>
[[gnu::always_inline]] inline void for_block(const Act& act) {
  [&]<std::size_t... k>(std::index_sequence<k...>) { (act(k), ...); }
  (std::make_index_sequence<phase_block>{});
}

/// rows[i] times the values for i = `first`, ..., `first` + phase_block - 1. The values before
/// them come last, as they have just been put in.
template <class Pack, std::size_t count>
[[gnu::always_inline]] inline std::array<Pack, phase_block> block_times(
    const std::array<std::array<double, count>, count>& rows, const std::array<Pack, count>& values,
    std::size_t first) {
  static_assert(count % phase_block == 0);
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

/// Compression or restitution, from the inner turning point to its other end, at the nodes of a
/// PhaseRule. What is lost up to a node is the integral of the rate D u dq/ds, in which u^2 / 2 is
/// the energy at the turning point less the potential energy, more (compression) or less
/// (restitution) what is lost. Putting the losses in again and again converges like M^n / n!,
/// M = integral of D dsigma. What a block of nodes does to itself is put in at once: a sweep then
/// leaves 1e-4 to 1e-3 of a change of 1e-5, and left 2e-3 to 1e-2 without (medians to 9 in 10 of
/// the benchmark's rebounds). Meanwhile u follows by Newton's rule, which needs neither a root nor
/// a quotient.
template <class Pack, std::size_t count>
struct Phase {
  using Mask = typename Pack::mask_type;
  using Nodes = std::array<Pack, count>;

  Pack length;          ///< of the way
  Nodes place;          ///< q
  Nodes height;         ///< energy at the inner turning point less the potential energy
  Nodes damping;        ///< of the loss, per u and s
  Nodes lost;           ///< from the inner turning point to the node
  Nodes speed;          ///< u without its sign
  Nodes slowness;       ///< 1 / u
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
  [[gnu::always_inline]] void refine(const Rule& rule, const std::array<Pack, few>& sketched) {
    for (std::size_t i = 0; i < count; ++i) lost[i] = row_times(rule.from_few[i], sketched);
  }

  /// The integral of D dsigma.
  template <class Rule>
  [[gnu::always_inline]] Pack held(const Rule& rule) const {
    Nodes values;
    for (std::size_t i = 0; i < count; ++i) values[i] = damping[i] * slowness[i];
    return row_times(rule.gauss.weight, values);
  }

  /// Puts in the losses, block by block, each with what those before it have just become, until
  /// they change by less than `settle_below` [m V^2]. Lanes that have settled are left as they are.
  /// @param arrive_below what the energy at the end may miss [m V^2]
  /// @param missing what the energy at the end misses with this loss
  /// @param move where the end goes for that; true when it went
  template <bool compression, class Rule, class Look, class Missing, class Move>
  [[gnu::always_inline]] void settle(const Rule& rule, double settle_below, double arrive_below,
                                     const Look& look_again, const Missing& missing,
                                     const Move& move) {
    constexpr int most_sweeps = 14;
    look_again();
    for (std::size_t i = 0; i < count; ++i) start<compression>(i);
    Pack last_change = 0.0;
    for (int sweep = 0; sweep < most_sweeps && !all_of(settled); ++sweep) {
      const Mask moving = !settled;
      Pack change = 0.0;
      for (std::size_t first = 0; first < count; first += phase_block) {
        const auto next = next_losses<compression>(rule, first);
        for_block([&](std::size_t i) {
          change = pack_larger(change, Pack(abs(next[i] - lost[first + i])));
          where(moving, lost[first + i]) = next[i];
        });
        follow_block<compression>(first, moving);
      }
      const Pack next_loss = row_times(rule.gauss.weight, rates);
      const Pack left_over = abs(missing(next_loss));
      where(moving, sweeps) += 1.0;
      // Changes that shrink by equal factors add up to change^2 / (last_change - change).
      const Mask close =
          change < 0.1 * settle_below ||
          (change < 1e3 * settle_below && change * change < settle_below * (last_change - change));
      last_change = change;
      const Mask arrived = left_over < arrive_below;
      settled = settled || (close && arrived);
      const Mask goes = moving && !arrived;
      if (move(goes, next_loss)) {
        look_again();
        follow_all<compression>(goes);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      lowest = pack_smaller(lowest, half_square<compression>(i));
    }
    loss = row_times(rule.gauss.weight, rates);
    defect = defect_of(rule.gauss, rates);
  }

 private:
  static constexpr double least = 1e-30;  // of u^2, so that there is 1 / u

  template <bool compression>
  [[gnu::always_inline]] Pack half_square(std::size_t i) const {
    return compression ? height[i] + lost[i] : height[i] - lost[i];
  }
  template <bool compression>
  [[gnu::always_inline]] Pack square(std::size_t i) const {
    const Pack half = half_square<compression>(i);
    return pack_larger(half + half, Pack(least));
  }
  template <bool compression>
  [[gnu::always_inline]] void start(std::size_t i) {
    speed[i] = sqrt(square<compression>(i));
    slowness[i] = 1.0 / speed[i];
    rates[i] = damping[i] * speed[i];
  }
  template <bool compression>
  [[gnu::always_inline]] void follow_all(const Mask& moving) {
    for (std::size_t first = 0; first < count; first += phase_block) {
      follow_block<compression>(first, moving);
    }
  }
  /// The losses at a block of nodes from the rates, more by what these change of the rates of the
  /// block: d(rate) / d(loss) = +-D dq/ds / u. Left out where that is steep, for u that all but
  /// vanishes, as of a sphere that is captured: there it would keep the sweeps from settling.
  template <bool compression, class Rule>
  [[gnu::always_inline]] std::array<Pack, phase_block> next_losses(const Rule& rule,
                                                                   std::size_t first) const {
    constexpr double steepest = 10.0;
    std::array<Pack, phase_block> next = block_times(rule.losses, rates, first);
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
  /// u and 1 / u of the lanes that move, by one step of Newton's; anew where that is too long.
  template <bool compression>
  [[gnu::always_inline]] void follow_block(std::size_t first, const Mask& moving) {
    constexpr double longest = 0.02;  // of u; the step errs by half of its square
    std::array<Pack, phase_block> squares;
    Pack furthest = 0.0;
    for_block([&](std::size_t k) {
      const std::size_t i = first + k;
      squares[k] = square<compression>(i);
      const Pack half = 0.5 * slowness[i];
      const Pack step = (squares[k] - speed[i] * speed[i]) * half;
      furthest = pack_larger(furthest, Pack(abs(step * slowness[i])));
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
