#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>
#include <span>

#include "impact/impact.hpp"
#include "impact/law_lanes.hpp"
#include "impact/phase.hpp"
#include "impact/phase_rule.hpp"

namespace recoil {

/// One impact per lane of `Pack`, each phase as an integral equation.
///
/// With the energy H = u^2 / 2 + P(q) in place of time, compression and restitution are
///   dH/dq = -D(q) u,   u = +-(2 (H - P))^(1/2),   D = -df/du,
/// two equations of first order (Phase) on ways whose ends are known but for the deepest point,
/// which H(start) decides: there is no event to look for, and all lanes land together. D and P are
/// smooth, so that the error falls exponentially with the number of nodes.
template <class Law, class Pack, bool with_gradient>
class Phases {
 public:
  static constexpr std::size_t lanes = Pack::size();

  Phases(AdhesionDampingPhase phase, double tolerance)
      : acts_at_first_(phase == AdhesionDampingPhase::both ? 1.0 : 0.0),
        settled_change_(20.0 * tolerance) {}

  /// What came of an attempt.
  enum class Verdict : std::uint8_t { good, captured, difficult };

  /// Tries the impacts queue[order[0]], queue[order[1]], ..., of which there are 1 to `lanes`, and
  /// fills the results of those that come out good.
  template <std::size_t count, PhaseEnd end>
  void fly(std::span<const ImpactGroups> queue, std::span<const std::uint32_t> order,
           std::span<ImpactResult> results, std::array<Verdict, lanes>& verdicts) {
    static constexpr auto& inwards = phase_rule<Pack, count, PhaseEnd::release>;
    static constexpr auto& outwards = phase_rule<Pack, count, end>;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      take(lane, queue[order[lane < order.size() ? lane : 0]]);
    }
    target_ = 0.5 + law_.potential(start_);
    Path<count> in, out;
    compress<count>(in);
    restore<count, end>(in.loss, out);
    const Pack energy = target_ - in.loss - out.loss;
    const Pack left = energy - law_.potential(end_);
    Mask good = in.settled && out.settled && deepest_ > resting_ && in.lowest > 0.0 &&
                out.lowest > 0.0 && in.defect + out.defect < most_defect;
    good = good && abs(energy) > nearest * (0.5 - law_.potential(resting_));
    if constexpr (end == PhaseEnd::release) good = good && left > 0.0;
    if constexpr (with_gradient) follow_both<count>(inwards, outwards, in, out, good);
    for (std::size_t lane = 0; lane < order.size(); ++lane) {
      const bool is_captured = end == PhaseEnd::release && !(double(left[lane]) > 0.0);
      verdicts[lane] = is_captured ? Verdict::captured : Verdict::difficult;
      if (!good[lane]) continue;
      ImpactResult& result = results[order[lane]];
      result.restitution_squared = 2.0 * double(energy[lane]);
      result.outcome = end == PhaseEnd::release ? ImpactOutcome::rebound : ImpactOutcome::captured;
      if constexpr (with_gradient) {
        if (!put_gradient(lane, queue[order[lane]], result)) continue;
      }
      result.steps = static_cast<long>(double(in.sweeps[lane] + out.sweeps[lane]));
      verdicts[lane] = Verdict::good;
    }
  }

 private:
  using Mask = typename Pack::mask_type;
  static constexpr unsigned parameters = Law::groups;
  static constexpr std::size_t place_of_range = 4;  // in ImpactResult::gradient
  static constexpr std::size_t block = phase_block;

  template <std::size_t count>
  using Path = Phase<Pack, count>;
  template <std::size_t count>
  using Nodes = std::array<Pack, count>;

  /// From the touch to the deepest point, first with few nodes.
  template <std::size_t count>
  [[gnu::flatten]] void compress(Path<count>& phase) {
    for (int step = 0; step < first_steps; ++step) {
      deepest_ -= (law_.potential(deepest_) - target_) / law_.slope(deepest_);
    }
    Path<few_nodes> coarse;
    compress_by(phase_rule<Pack, few_nodes, PhaseEnd::release>, coarse, coarse_change);
    phase.refine(phase_rule<Pack, count, PhaseEnd::release>, coarse);
    compress_by(phase_rule<Pack, count, PhaseEnd::release>, phase, settled_change_);
  }
  template <class Rule, std::size_t count>
  [[gnu::always_inline]] void compress_by(const Rule& rule, Path<count>& phase,
                                          double settle_below) {
    Pack bottom;
    phase.template settle<true>(
        rule, settle_below,
        [&] {
          bottom = law_.potential(deepest_);
          phase.look(rule, law_, deepest_, start_, acts_at_first_, bottom);
        },
        [&](const Pack& loss) { return (bottom + loss) - target_; },
        [&](const Mask& moving, const Pack& loss, const Pack& missing) {
          // A deeper turning point takes more energy, and loses more of it.
          const Pack height = bottom - missing / (1.0 + steeper * loss);
          const Pack near = deepest_ - (bottom - height) / law_.slope(deepest_);
          where(moving, deepest_) = near - (law_.potential(near) - height) / law_.slope(near);
        });
  }

  /// From the deepest point to the end.
  template <std::size_t count, PhaseEnd end>
  [[gnu::flatten]] void restore(const Pack& lost_before, Path<count>& phase) {
    const Pack bottom = target_ - lost_before;
    if constexpr (end == PhaseEnd::release) {
      end_ = release_;
    } else {
      guess_outer_turning_point(bottom, lost_before);
    }
    Path<few_nodes> coarse;
    restore_by<end>(phase_rule<Pack, few_nodes, end>, bottom, coarse, coarse_change);
    phase.refine(phase_rule<Pack, count, end>, coarse);
    restore_by<end>(phase_rule<Pack, count, end>, bottom, phase, settled_change_);
  }
  template <PhaseEnd end, class Rule, std::size_t count>
  [[gnu::always_inline]] void restore_by(const Rule& rule, const Pack& bottom, Path<count>& phase,
                                         double settle_below) {
    const auto look_at_all = [&] { phase.look(rule, law_, deepest_, end_, Pack(1.0), bottom); };
    if constexpr (end == PhaseEnd::release) {
      look_at_all();
      phase.template settle<false>(
          rule, settle_below, [] {}, [](const Pack&) { return Pack(0.0); },
          [](const Mask&, const Pack&, const Pack&) {});
    } else {
      phase.template settle<false>(
          rule, settle_below, look_at_all,
          [&](const Pack& loss) { return law_.potential(end_) - (bottom - loss); },
          [&](const Mask& moving, const Pack&, const Pack& missing) {
            const Pack moved = end_ - missing / law_.slope(end_);
            where(moving, end_) =
                pack_smaller(pack_larger(moved, 0.5 * (release_ + end_)), 0.5 * (resting_ + end_));
          });
    }
  }

  /// As if the well were a parabola about its bottom.
  void guess_outer_turning_point(const Pack& bottom, const Pack& lost_before) {
    const Pack depth = law_.potential(resting_);
    Pack part = (bottom - lost_before) / depth;
    where(!(part > 0.1), part) = 0.1;
    end_ = resting_ - (resting_ - release_) * sqrt(pack_larger(Pack(0.0), 1.0 - part));
  }

  /// exp(-x) for x from 0 to 6, to 1e-10 of itself.
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

  /// The derivatives of the loss of one phase, for a fixed deepest point: z . g, where g_j is that
  /// of the rate of the loss at node j for fixed losses, and z obeys z = weight +- up_to^T (k z), k
  /// = D dsigma / ds, as the loss itself obeys its equation. The beginning of z is weight times
  /// exp(integral of k).
  /// @param sign 1 for the compression, else -1
  template <class Rule, std::size_t count>
  [[gnu::always_inline]] void follow(const Rule& rule, double sign, const Pack& acts,
                                     const Path<count>& phase, const Nodes<count>& held,
                                     const Pack& all_held, Mask& good) {
    Nodes<count> z;
    for (std::size_t first = 0; first < count; first += block) {
      const std::array<Pack, block> passed = integrals_up_to(rule, held, first);
      for (std::size_t i = 0; i < block; ++i) {
        const Pack mu =
            sign > 0.0 ? 1.0 / decay(all_held - passed[i]) : decay(all_held - passed[i]);
        z[first + i] = rule.gauss.weight[first + i] * mu;
      }
    }
    Pack change = 0.0;
    for (int sweep = 0; sweep < follow_sweeps; ++sweep) {
      change = 0.0;
      for (std::size_t first = count; first > 0;) {
        first -= block;
        std::array<Pack, block> sums;
        sums.fill(Pack(0.0));
        for (std::size_t i = 0; i < count; ++i) {
          const Pack value = held[i] * z[i];
          for (std::size_t j = 0; j < block; ++j) sums[j] += rule.gauss.up_to[i][first + j] * value;
        }
        for (std::size_t j = 0; j < block; ++j) {
          const Pack next = rule.gauss.weight[first + j] + sign * sums[j];
          change = pack_larger(change, abs(next - z[first + j]));
          z[first + j] = next;
        }
      }
    }
    good = good && change < most_change;
    for (std::size_t i = 0; i < count; ++i) {
      add(rule, i, acts, phase, held[i], z[i]);
    }
  }

  template <class Rule, std::size_t count>
  [[gnu::always_inline]] void add(const Rule& rule, std::size_t i, const Pack& acts,
                                  const Path<count>& phase, const Pack& held, const Pack& z) {
    const auto moving = law_.field(phase.place[i], phase.speed[i], acts);
    const auto resting = law_.field(phase.place[i], Pack(0.0), acts);
    const auto potential = law_.potential_with_gradient(phase.place[i]);
    const Pack way = phase.length * rule.rate[i];
    const Pack tail = rule.gauss.last[i] / rule.gauss.weight[i] * z;
    [&]<unsigned... k>(std::integer_sequence<unsigned, k...>) {
      const auto add_one = [&]<unsigned p>() {
        const Pack rate =
            held * (at_bottom_[p - 1] - potential.template derivative<p>()) +
            way * (resting.template derivative<p>() - moving.template derivative<p>());
        slopes_[p - 1] += z * rate;
        tails_[p - 1] += tail * rate;
      };
      (add_one.template operator()<k + 1>(), ...);
    }
    (std::make_integer_sequence<unsigned, parameters>{});
  }

  /// The gradient of half of e^2. With the losses at a fixed deepest point it is
  ///   dP/dp - d(loss out)/dp + exp(-integral of D dsigma) (dH/dp at touch - dP/dp - d(loss
  ///   in)/dp),
  /// P at the deepest point.
  template <std::size_t count, class Inwards, class Outwards>
  [[gnu::flatten]] void follow_both(const Inwards& inwards, const Outwards& outwards,
                                    const Path<count>& in, const Path<count>& out, Mask& good) {
    Nodes<count> held_in, held_out;
    for (std::size_t i = 0; i < count; ++i) held_in[i] = in.damping[i] / in.speed[i];
    for (std::size_t i = 0; i < count; ++i) held_out[i] = out.damping[i] / out.speed[i];
    const Pack all_in = row_times(inwards.gauss.weight, held_in);
    const Pack all_out = row_times(outwards.gauss.weight, held_out);
    good = good && all_in + all_out < most_held;  // false for NaN
    const auto each = [&]<class Act>(const Act& act) {
      [&]<unsigned... k>(std::integer_sequence<unsigned, k...>) {
        (act.template operator()<k>(), ...);
      }
      (std::make_integer_sequence<unsigned, parameters>{});
    };
    const auto bottom = law_.potential_with_gradient(deepest_);
    const auto touch = law_.potential_with_gradient(start_);
    each([&]<unsigned k>() { at_bottom_[k] = bottom.template derivative<k + 1>(); });
    slopes_.fill(Pack(0.0));
    tails_.fill(Pack(0.0));
    follow(inwards, 1.0, acts_at_first_, in, held_in, all_in, good);
    const Pack mu = decay(all_in + all_out);
    each([&]<unsigned k>() {
      const Pack at_touch = touch.template derivative<k + 1>() - at_bottom_[k];
      slopes_[k] = mu * (slopes_[k] - at_touch);
      tails_[k] *= mu;
    });
    if constexpr (Law::constants > 0) {
      constexpr auto moving = [] {
        unsigned k = 0;
        while (Law::places[k] != place_of_range) ++k;
        return k;
      }();
      slopes_[moving] += mu * (law_.field(start_, Pack(1.0), acts_at_first_).value * start_slope_);
    }
    follow(outwards, -1.0, Pack(1.0), out, held_out, all_out, good);
    each([&]<unsigned k>() { slopes_[k] = at_bottom_[k] - slopes_[k]; });
  }

  /// False when its last coefficients are not small beside the gradient.
  bool put_gradient(std::size_t lane, const ImpactGroups& impact, ImpactResult& result) {
    std::array<double, parameters> slopes, tails;
    for (unsigned k = 0; k < parameters; ++k) {
      slopes[k] = 2.0 * double(slopes_[k][lane]);
      tails[k] = 2.0 * double(tails_[k][lane]);
    }
    result.gradient = impact_gradient<Law>(impact, slopes);
    const std::array<double, 5> errors = impact_gradient<Law>(impact, tails);
    for (std::size_t k = 0; k < errors.size(); ++k) {
      const double size = __builtin_fabs(result.gradient[k]);
      if (!(__builtin_fabs(errors[k]) < most_tail * (size > 1.0 ? size : 1.0))) return false;
    }
    return true;
  }

  void take(std::size_t lane, const ImpactGroups& impact) {
    law_.set(lane, impact);
    const LawPath path = Law::path_of(impact);
    start_[lane] = path.start;
    start_slope_[lane] = path.range_slope;
    release_[lane] = path.release;
    resting_[lane] = path.resting;
    deepest_[lane] = path.deepest;
  }

  static constexpr int first_steps = 3;  // from LawPath::deepest, by Newton's rule
  static constexpr std::size_t few_nodes = 8;
  static constexpr double coarse_change = 1e-6;  // of the losses, with few nodes
  static constexpr double steeper = 3.0;  // Hertz's contact: d(loss) / d(energy) = 3 loss + ...
  static constexpr int follow_sweeps = 2;
  static constexpr double most_change = 1e-7;  // of what the gradient is summed with
  static constexpr double most_held = 6.0;     // of the integral of D dsigma
  // An impact is difficult, and for Flights, where these coefficients have not become small: the
  // error of the integrals goes with their square. Both limits were found by comparison with the
  // reference on some thousand impacts of each law.
  static constexpr double most_defect = 1e-5;
  static constexpr double most_tail = 2e-5;
  // So it is where the energy at the end is this part of what there is: near capture a zero of u
  // comes close to the way.
  static constexpr double nearest = 0.02;

  Pack acts_at_first_;
  double settled_change_;
  LawLanes<Law, Pack, with_gradient> law_;
  Pack start_ = 0.0, start_slope_ = 0.0, release_ = 0.0, resting_ = 0.0;
  Pack deepest_ = 0.0, end_ = 0.0;  // q of the turning point and of the end
  Pack target_ = 0.0;               // the energy at the start
  std::array<Pack, parameters> at_bottom_ = {}, slopes_ = {};
  std::array<Pack, parameters> tails_ = {};
};

}  // namespace recoil
