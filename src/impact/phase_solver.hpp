#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "impact/force_law.hpp"
#include "impact/impact.hpp"
#include "impact/law_lanes.hpp"
#include "impact/phase.hpp"

namespace recoil {

/// The nodes that an impact needs according to the coarse rule.
enum class PhaseNeed : std::uint8_t { smooth, fine, capture };

/// The result of the coarse rule for an impact. Start, release and so on are those of LawPath.
struct CoarseImpact {
  double start, start_slope, release, resting;
  double deepest;                                  ///< of the damped impact
  double in[PhaseRule::few], out[PhaseRule::few];  ///< rates of the losses of both phases
  double sweeps;
  PhaseNeed need;
};

/// Solves one impact per lane of `Pack`, each phase as an integral equation.
///
/// With the energy H = u^2 / 2 + P(q) in place of time, compression and restitution are
///   dH/dq = -D(q) u,   u = +-(2 (H - P))^(1/2),   D = -df/du,
/// two equations of first order (Phase) on intervals with known ends, except for the deepest point,
/// which follows from H(start). No events have to be found, and all lanes do the same work. D and P
/// are smooth, so that the error falls exponentially with the number of nodes.
template <class Law, class Pack>
class PhaseSolver {
 public:
  static constexpr std::size_t lanes = Pack::size();

  explicit PhaseSolver(const ImpactOptions& options)
      : rules_(phase_rules()),
        gradient_(options.gradient),
        acts_at_first_(options.phase == AdhesionDampingPhase::both ? 1.0 : 0.0),
        tolerance_(3.0 * options.fast_tolerance) {}

  /// Solves the impacts impacts[order[0]], impacts[order[1]], ... with the coarse rule.
  /// @pre 1 to `lanes` of them
  void solve_coarsely(std::span<const ImpactGroups> impacts, std::span<const std::uint32_t> order,
                      std::span<CoarseImpact> coarse) {
    for (const std::uint32_t entry : order) {
      const LawPath path = Law::path_of(impacts[entry]);
      coarse[entry].start = path.start;
      coarse[entry].start_slope = path.range_slope;
      coarse[entry].release = path.release;
      coarse[entry].resting = path.resting;
      coarse[entry].deepest = path.deepest;
    }
    take_all(impacts, order, coarse);
    for (int step = 0; step < first_steps; ++step) newton_step_to_deepest();
    Phase<Pack> in(rules_.coarse), out(rules_.coarse);
    in.start_without_losses();
    compress(in, coarse_change, 10.0 * coarse_change);
    go_deeper(Mask(true), in.held());
    end_ = release_;
    out.start_without_losses();
    restore(false, out, coarse_change);
    const auto left = lanes_of(Pack(law_.potential(deepest_) - out.loss - law_.potential(end_)));
    const auto defect = lanes_of(out.defect), sweeps = lanes_of(Pack(in.sweeps + out.sweeps));
    const auto deepest = lanes_of(deepest_);
    for (std::size_t lane = 0; lane < order.size(); ++lane) {
      CoarseImpact& impact = coarse[order[lane]];
      impact.deepest = deepest[lane];
      impact.sweeps = sweeps[lane];
      impact.need = !(left[lane] > 0.0)                 ? PhaseNeed::capture
                    : defect[lane] < most_coarse_defect ? PhaseNeed::smooth
                                                        : PhaseNeed::fine;
    }
    for (std::size_t i = 0; i < PhaseRule::few; ++i) {
      const auto rates_in = lanes_of(in.rates[i]), rates_out = lanes_of(out.rates[i]);
      for (std::size_t lane = 0; lane < order.size(); ++lane) {
        coarse[order[lane]].in[i] = rates_in[lane];
        coarse[order[lane]].out[i] = rates_out[lane];
      }
    }
  }

  /// Solves impacts after `solve_coarsely` with the nodes for `need`, and writes the results that
  /// are accurate.
  /// @returns true for each lane with an accurate result
  std::array<bool, lanes> solve(PhaseNeed need, std::span<const ImpactGroups> impacts,
                                std::span<const std::uint32_t> order,
                                std::span<const CoarseImpact> coarse,
                                std::span<ImpactResult> results) {
    const bool capture = need == PhaseNeed::capture;
    take_all(impacts, order, coarse);
    CoarseNodes rates_in, rates_out;
    for (std::size_t i = 0; i < PhaseRule::few; ++i) {
      rates_in[i] = pack_of(order, [&](std::uint32_t entry) { return coarse[entry].in[i]; });
      rates_out[i] = pack_of(order, [&](std::uint32_t entry) { return coarse[entry].out[i]; });
    }
    Phase<Pack> in(need == PhaseNeed::smooth ? rules_.smooth : rules_.fine);
    Phase<Pack> out(capture ? rules_.fine_capture : in.rule);
    in.start_from(rates_in);
    compress(in, tolerance_, tolerance_);
    if (capture) {
      restore_captured(out);
    } else {
      end_ = release_;
      out.start_from(rates_out);
      restore(false, out, tolerance_);
    }
    follow_both(in, out);
    const Pack energy = law_.potential(deepest_) - out.loss - all_ * missing_;
    const Pack defect = in.defect + out.defect;
    Mask good = in.converged && out.converged && deepest_ > resting_ && in.lowest > 0.0 &&
                out.lowest > 0.0 && held_ < most_held;
    good = good && defect < most_defect && defect * held_defect_ < most_e2_error;
    good = good && abs(energy) > nearest * (0.5 - law_.potential(resting_));
    if (!capture) good = good && energy > law_.potential(end_);
    if (gradient_) {
      const double share = capture ? 0.1 : 1.0;  // u vanishes twice
      put_gradients(share * most_gradient_error, impacts, order, results, good);
    }
    const auto energies = lanes_of(energy);
    const auto sweeps = lanes_of(Pack(in.sweeps + out.sweeps));
    std::array<bool, lanes> done = {};
    for (std::size_t lane = 0; lane < order.size(); ++lane) {
      done[lane] = good[lane];
      if (!done[lane]) continue;
      ImpactResult& result = results[order[lane]];
      result.restitution_squared = 2.0 * energies[lane];
      result.outcome = capture ? ImpactOutcome::captured : ImpactOutcome::rebound;
      result.steps = static_cast<long>(coarse[order[lane]].sweeps + sweeps[lane]);
    }
    return done;
  }

 private:
  using Mask = typename Pack::mask_type;
  using CoarseNodes = std::array<Pack, PhaseRule::few>;
  static constexpr unsigned parameters = Law::groups;

  [[gnu::flatten]] void newton_step_to_deepest() {
    deepest_ -= (law_.potential(deepest_) - target_) / law_.slope(deepest_);
  }

  /// From first contact to the deepest point.
  [[gnu::flatten]] void compress(Phase<Pack>& phase, double tolerance, double end_tolerance) {
    // The result is corrected for the missing energy.
    phase.template converge<true>(
        tolerance, end_tolerance,
        [&] {
          bottom_ = law_.potential(deepest_);
          phase.place_nodes(law_, deepest_, start_, acts_at_first_, bottom_);
        },
        [&](const Pack& loss) { return missing_ = (bottom_ + loss) - target_; },
        [&](const Mask& moving, const Pack&) {
          if (none_of(moving)) return false;
          go_deeper(moving, phase.held());
          return true;
        });
    missing_ = (bottom_ + phase.loss) - target_;
  }
  /// Moves the turning point to supply the missing energy, divided by exp(held) because a deeper
  /// turning point also increases the loss.
  [[gnu::always_inline]] void go_deeper(const Mask& moving, const Pack& held) {
    const Pack grows = 1.0 + held * (1.0 + held * (0.5 + held * (1.0 / 6.0 + held * (1.0 / 24.0))));
    const Pack height = bottom_ - missing_ / grows;
    const Pack near = deepest_ - (bottom_ - height) / law_.slope(deepest_);
    where(moving, deepest_) = near - (law_.potential(near) - height) / law_.slope(near);
  }

  /// From the deepest point to the outer turning point.
  void restore_captured(Phase<Pack>& phase) {
    guess_outer_turning_point();
    Phase<Pack> coarse(rules_.coarse_capture);
    coarse.start_without_losses();
    restore(true, coarse, coarse_change);
    CoarseNodes rates;
    for (std::size_t i = 0; i < PhaseRule::few; ++i) rates[i] = coarse.rates[i];
    phase.start_from(rates);
    phase.sweeps = coarse.sweeps;
    // If u vanishes at both ends, convergence becomes slower. With the tolerance of a rebound, 17
    // of 1053 captures had errors of 3e-8 and more in a derivative; with this tolerance none had
    // 2e-9.
    restore(true, phase, 0.03 * tolerance_);
  }
  /// From the deepest point to `end_`, which is moved if it `turns`: if it is a turning point.
  [[gnu::flatten]] void restore(bool turns, Phase<Pack>& phase, double tolerance) {
    const Pack bottom = law_.potential(deepest_);
    phase.template converge<false>(
        tolerance, turns ? 0.1 * tolerance : tolerance,
        [&] { phase.place_nodes(law_, deepest_, end_, Pack(1.0), bottom); },
        [&](const Pack& loss) {
          return turns ? Pack(law_.potential(end_) - (bottom - loss)) : Pack(0.0);
        },
        [&](const Mask& moving, const Pack& loss) {
          if (none_of(moving)) return false;
          const Pack missing = law_.potential(end_) - (bottom - loss);
          const Pack moved = end_ - missing / law_.slope(end_);
          where(moving, end_) = min(0.5 * (resting_ + end_), max(0.5 * (release_ + end_), moved));
          return true;
        });
  }

  /// Approximates the well by a parabola about its bottom.
  void guess_outer_turning_point() {
    const Pack bottom = law_.potential(deepest_);
    const Pack depth = law_.potential(resting_);
    Pack part = (bottom - (target_ - bottom)) / depth;
    where(!(part > 0.1), part) = 0.1;
    end_ = resting_ - (resting_ - release_) * sqrt(max(1.0 - part, Pack(0.0)));
  }

  /// exp(-x) for x from 0 to 6 with a relative error of 1e-10.
  static Pack decay(const Pack& x) {
    const Pack y = x * (-1.0 / 32.0);
    Pack e = 1.0 / 40320.0;
    for (const double c :
         {1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0}) {
      e = e * y + c;
    }
    for (int square = 0; square < 5; ++square) e = e * e;
    return e;
  }

  /// Adds the slopes of one phase. A change of the kinetic energy at a node is multiplied by
  /// exp(-x) at the end of the impact, x the integral of D dsigma from there to the end. `held` is
  /// D dsigma / ds. The derivative of the energy at the end is therefore the integral of the change
  /// of the force with a parameter, with this weight: the areas of StepSolver.
  /// @param sign 1 for the compression, else -1
  [[gnu::always_inline]] void add_slopes(double sign, const Pack& acts, const Phase<Pack>& phase,
                                         const Nodes<Pack>& held) {
    const PhaseRule& rule = phase.rule;
    for (std::size_t first = 0; first < rule.count; first += phase_block) {
      const auto passed = block_times(rule.up_to, held, first, rule.count);
      for (std::size_t k = 0; k < phase_block; ++k) {
        const std::size_t i = first + k;
        const Pack stays = decay(held_out_ + sign * passed[k]);
        const Pack way = sign * (phase.length * rule.rate[i]) * stays;
        const auto force = law_.field_with_slopes(phase.place[i], sign * phase.speed[i], acts);
        for_each_group([&]<unsigned p>() {
          const Pack rate = way * force.template derivative<p + 1>();
          slopes_[p] += rule.weight[i] * rate;
          tails_[p] += rule.last[i] * rate;
          next_tails_[p] += rule.last_but_one[i] * rate;
        });
      }
    }
  }

  /// Calls act.operator()<k>() for each group k.
  template <class Act>
  [[gnu::always_inline]] static void for_each_group(const Act& act) {
    [&]<unsigned... k>(std::integer_sequence<unsigned, k...>) {
      (act.template operator()<k>(), ...);
    }
    (std::make_integer_sequence<unsigned, parameters>{});
  }

  /// Computes the decay of changes of the energy, and the gradient of half of e^2.
  [[gnu::flatten]] void follow_both(const Phase<Pack>& in, const Phase<Pack>& out) {
    const std::size_t count = in.rule.count;
    Nodes<Pack> held_in = {}, held_out = {};
    for (std::size_t i = 0; i < count; ++i) held_in[i] = in.damping[i] * in.slowness[i];
    for (std::size_t i = 0; i < count; ++i) held_out[i] = out.damping[i] * out.slowness[i];
    held_out_ = row_times(out.rule.weight, held_out, count);
    held_ = row_times(in.rule.weight, held_in, count) + held_out_;
    all_ = decay(min(Pack(most_held), held_));
    held_defect_ = defect_of(in.rule, held_in) + defect_of(out.rule, held_out);
    if (!gradient_) return;
    slopes_.fill(Pack(0.0));
    tails_.fill(Pack(0.0));
    next_tails_.fill(Pack(0.0));
    add_slopes(1.0, acts_at_first_, in, held_in);
    add_slopes(-1.0, Pack(1.0), out, held_out);
    if constexpr (Law::constants > 0) {
      constexpr unsigned moving = group_of_range<Law>;
      slopes_[moving] -= all_ * (law_.field(start_, Pack(1.0), acts_at_first_) * start_slope_);
    }
    const auto potential = law_.potential_with_slopes(end_);
    for_each_group([&]<unsigned p>() { slopes_[p] += potential.template derivative<p + 1>(); });
  }

  /// Writes the gradients, and clears `good` for impacts whose last coefficients are not small
  /// compared with the gradient.
  void put_gradients(double most_error, std::span<const ImpactGroups> impacts,
                     std::span<const std::uint32_t> order, std::span<ImpactResult> results,
                     Mask& good) {
    std::array<std::array<double, lanes>, parameters> slopes, tails;
    for (unsigned k = 0; k < parameters; ++k) {
      slopes[k] = lanes_of(Pack(2.0 * slopes_[k]));
      tails[k] = lanes_of(Pack(2.0 * (abs(tails_[k]) + abs(next_tails_[k]))));
    }
    const auto held_defect = lanes_of(held_defect_);
    for (std::size_t lane = 0; lane < order.size(); ++lane) {
      if (!good[lane]) continue;
      const ImpactGroups& impact = impacts[order[lane]];
      std::array<double, parameters> slope, tail;
      for (unsigned k = 0; k < parameters; ++k) {
        slope[k] = slopes[k][lane];
        tail[k] = tails[k][lane];
      }
      const std::array<double, 5> gradient = impact_gradient<Law>(impact, slope);
      const std::array<double, 5> errors = impact_gradient<Law>(impact, tail);
      bool small = true;
      for (std::size_t k = 0; k < errors.size(); ++k) {
        const double size = __builtin_fabs(gradient[k]);
        const double error = __builtin_fabs(errors[k]) / (size > 1.0 ? size : 1.0);
        small = small && error * (error + held_defect[lane]) < most_error;
      }
      if (small) {
        results[order[lane]].gradient = gradient;
      } else {
        good[lane] = false;
      }
    }
  }

  /// value(entry) of each impact in `order`. Unused lanes get the value of the first one.
  template <class Value>
  static Pack pack_of(std::span<const std::uint32_t> order, const Value& value) {
    std::array<double, lanes> values;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      values[lane] = value(order[lane < order.size() ? lane : 0]);
    }
    return Pack(values.data());
  }
  static std::array<double, lanes> lanes_of(const Pack& pack) {
    std::array<double, lanes> values;
    pack.copy_to(values.data());
    return values;
  }

  void take_all(std::span<const ImpactGroups> impacts, std::span<const std::uint32_t> order,
                std::span<const CoarseImpact> coarse) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      law_.set(lane, impacts[order[lane < order.size() ? lane : 0]]);
    }
    const auto value_of = [&](double CoarseImpact::*member) {
      return pack_of(order, [&](std::uint32_t entry) { return coarse[entry].*member; });
    };
    start_ = value_of(&CoarseImpact::start);
    start_slope_ = value_of(&CoarseImpact::start_slope);
    release_ = value_of(&CoarseImpact::release);
    resting_ = value_of(&CoarseImpact::resting);
    deepest_ = value_of(&CoarseImpact::deepest);
    target_ = 0.5 + law_.potential(start_);
  }

  static constexpr int first_steps = 3;          // of Newton's method, from LawPath::deepest
  static constexpr double coarse_change = 1e-4;  // of the losses, with the coarse rule
  static constexpr double most_held = 6.0;       // of the integral of D dsigma
  // An impact needs more nodes, or StepSolver, if the last two coefficients of the rates are not
  // small. The error of e^2 is proportional to their product with the coefficients of D dsigma /
  // ds, that of the gradient to the product of its coefficients with these and with themselves.
  static constexpr double most_defect = 1e-4;
  // Above this defect of the coarse rule an impact needs fine nodes. Of the benchmark's impacts, it
  // misses 11 of 154 that do, and selects 17 of 831 that do not.
  static constexpr double most_coarse_defect = 0.016;
  static constexpr double most_e2_error = 1e-10;
  static constexpr double most_gradient_error = 1e-8;
  // It also needs StepSolver if the energy at the end is less than this part of the whole, because
  // near capture a zero of u is close to the path.
  static constexpr double nearest = 0.02;

  const PhaseRules& rules_;
  bool gradient_;
  Pack acts_at_first_;
  double tolerance_;
  LawLanes<Law, Pack> law_;
  Pack start_ = 0.0, start_slope_ = 0.0, release_ = 0.0, resting_ = 0.0;
  Pack deepest_ = 0.0, end_ = 0.0;    // q of the turning point and of the end
  Pack target_ = 0.0;                 // the energy at the start
  Pack bottom_ = 0.0;                 // potential energy at the turning point
  Pack missing_ = 0.0;                // energy at the start of the computed path, less target_
  Pack held_ = 0.0, held_out_ = 0.0;  // integral of D dsigma, of the impact and of its second phase
  Pack held_defect_ = 0.0;            // the last two coefficients of what is integrated there
  Pack all_ = 0.0;                    // exp(-held_)
  std::array<Pack, parameters> slopes_ = {}, tails_ = {}, next_tails_ = {};
};

}  // namespace recoil
