#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>
#include <span>

#include "impact/force_law.hpp"
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
        settled_change_(3.0 * tolerance) {}

  static constexpr std::size_t few_nodes = 8;
  /// How many nodes an impact needs, as far as a few can tell.
  enum class Outlook : std::uint8_t { smooth, difficult, captured };
  /// What few nodes say of an impact. Nothing is put into it before it is sketched.
  struct Sketch {
    double start, start_slope, release, resting;  ///< as in LawPath
    double deepest;                               ///< of the damped impact
    std::array<double, few_nodes> in, out;        ///< rates of the losses of both phases
    double sweeps;
    Outlook outlook;
  };

  /// Sketches the impacts queue[order[0]], queue[order[1]], ..., of which there are 1 to `lanes`.
  void sketch(std::span<const ImpactGroups> queue, std::span<const std::uint32_t> order,
              std::span<Sketch> sketches) {
    static constexpr auto& rule = phase_rule<Pack, few_nodes, PhaseEnd::release>;
    for (const std::uint32_t entry : order) {
      const LawPath path = Law::path_of(queue[entry]);
      sketches[entry].start = path.start;
      sketches[entry].start_slope = path.range_slope;
      sketches[entry].release = path.release;
      sketches[entry].resting = path.resting;
      sketches[entry].deepest = path.deepest;
    }
    take_all(queue, order, sketches);
    Path<few_nodes> in, out;
    sketch_both(rule, in, out);
    const auto left = lanes_of(Pack(law_.potential(deepest_) - out.loss - law_.potential(end_)));
    const auto defect = lanes_of(out.defect), sweeps = lanes_of(Pack(in.sweeps + out.sweeps));
    const auto deepest = lanes_of(deepest_);
    for (std::size_t lane = 0; lane < order.size(); ++lane) {
      Sketch& sketch = sketches[order[lane]];
      sketch.deepest = deepest[lane];
      sketch.sweeps = sweeps[lane];
      sketch.outlook = !(left[lane] > 0.0)                   ? Outlook::captured
                       : defect[lane] < most_sketched_defect ? Outlook::smooth
                                                             : Outlook::difficult;
    }
    for (std::size_t i = 0; i < few_nodes; ++i) {
      const auto rates_in = lanes_of(in.rates[i]), rates_out = lanes_of(out.rates[i]);
      for (std::size_t lane = 0; lane < order.size(); ++lane) {
        sketches[order[lane]].in[i] = rates_in[lane];
        sketches[order[lane]].out[i] = rates_out[lane];
      }
    }
  }

  /// Tries impacts that have been sketched, and fills the results of those that come out good.
  /// @returns which do, by lane
  template <std::size_t count, PhaseEnd end>
  std::array<bool, lanes> fly(std::span<const ImpactGroups> queue,
                              std::span<const std::uint32_t> order,
                              std::span<const Sketch> sketches, std::span<ImpactResult> results) {
    static constexpr auto& inwards = phase_rule<Pack, count, PhaseEnd::release>;
    static constexpr auto& outwards = phase_rule<Pack, count, end>;
    take_all(queue, order, sketches);
    Nodes<few_nodes> rates_in, rates_out;
    for (std::size_t i = 0; i < few_nodes; ++i) {
      rates_in[i] = pack_of(order, [&](std::uint32_t entry) { return sketches[entry].in[i]; });
      rates_out[i] = pack_of(order, [&](std::uint32_t entry) { return sketches[entry].out[i]; });
    }
    Path<count> in, out;
    compress<count>(rates_in, in);
    restore<count, end>(rates_out, out);
    follow_both<count>(inwards, outwards, in, out);
    const Pack energy = law_.potential(deepest_) - out.loss - all_ * missing_;
    const Pack defect = in.defect + out.defect;
    Mask good = in.settled && out.settled && deepest_ > resting_ && in.lowest > 0.0 &&
                out.lowest > 0.0 && held_ < most_held;
    good = good && defect < most_defect && defect * held_defect_ < most_e2_error;
    good = good && abs(energy) > nearest * (0.5 - law_.potential(resting_));
    if constexpr (end == PhaseEnd::release) good = good && energy > law_.potential(end_);
    if constexpr (with_gradient) {
      constexpr double share = end == PhaseEnd::release ? 1.0 : 0.1;  // u vanishes twice
      put_gradients(share * most_gradient_error, queue, order, results, good);
    }
    const auto energies = lanes_of(energy);
    const auto sweeps = lanes_of(Pack(in.sweeps + out.sweeps));
    std::array<bool, lanes> done = {};
    for (std::size_t lane = 0; lane < order.size(); ++lane) {
      done[lane] = good[lane];
      if (!done[lane]) continue;
      ImpactResult& result = results[order[lane]];
      result.restitution_squared = 2.0 * energies[lane];
      result.outcome = end == PhaseEnd::release ? ImpactOutcome::rebound : ImpactOutcome::captured;
      result.steps = static_cast<long>(sketches[order[lane]].sweeps + sweeps[lane]);
    }
    return done;
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

  /// Both phases with few nodes, the second until the release.
  template <class Rule>
  [[gnu::flatten]] void sketch_both(const Rule& rule, Path<few_nodes>& in, Path<few_nodes>& out) {
    for (int step = 0; step < first_steps; ++step) {
      deepest_ -= (law_.potential(deepest_) - target_) / law_.slope(deepest_);
    }
    in.lost.fill(Pack(0.0));
    compress_by(rule, in, coarse_change, 10.0 * coarse_change);
    go_deeper(Mask(true), in.held(rule));
    end_ = release_;
    out.lost.fill(Pack(0.0));
    restore_by<PhaseEnd::release>(rule, law_.potential(deepest_), out, coarse_change);
  }

  /// From the touch to the deepest point.
  template <std::size_t count>
  [[gnu::flatten]] void compress(const Nodes<few_nodes>& sketched, Path<count>& phase) {
    static constexpr auto& rule = phase_rule<Pack, count, PhaseEnd::release>;
    phase.refine(rule, sketched);
    compress_by(rule, phase, settled_change_, settled_change_);
  }
  template <class Rule, std::size_t count>
  [[gnu::always_inline]] void compress_by(const Rule& rule, Path<count>& phase, double settle_below,
                                          double arrive_below) {
    // What is missing is made up for in the end.
    phase.template settle<true>(
        rule, settle_below, arrive_below,
        [&] {
          bottom_ = law_.potential(deepest_);
          phase.look(rule, law_, deepest_, start_, acts_at_first_, bottom_);
        },
        [&](const Pack& loss) { return missing_ = (bottom_ + loss) - target_; },
        [&](const Mask& moving, const Pack&) {
          if (none_of(moving)) return false;
          go_deeper(moving, phase.held(rule));
          return true;
        });
    missing_ = (bottom_ + phase.loss) - target_;
  }
  /// A deeper turning point takes more energy, and loses more of it: exp(held) in all.
  [[gnu::always_inline]] void go_deeper(const Mask& moving, const Pack& held) {
    const Pack grows = 1.0 + held * (1.0 + held * (0.5 + held * (1.0 / 6.0 + held * (1.0 / 24.0))));
    const Pack height = bottom_ - missing_ / grows;
    const Pack near = deepest_ - (bottom_ - height) / law_.slope(deepest_);
    where(moving, deepest_) = near - (law_.potential(near) - height) / law_.slope(near);
  }

  /// From the deepest point to the end.
  template <std::size_t count, PhaseEnd end>
  [[gnu::flatten]] void restore(const Nodes<few_nodes>& sketched, Path<count>& phase) {
    static constexpr auto& rule = phase_rule<Pack, count, end>;
    const Pack bottom = law_.potential(deepest_);
    if constexpr (end == PhaseEnd::release) {
      end_ = release_;
      phase.refine(rule, sketched);
    } else {
      static constexpr auto& few = phase_rule<Pack, few_nodes, end>;
      guess_outer_turning_point(bottom, target_ - bottom);
      Path<few_nodes> coarse;
      coarse.lost.fill(Pack(0.0));
      restore_by<end>(few, bottom, coarse, coarse_change);
      phase.refine(rule, coarse.rates);
      phase.sweeps = coarse.sweeps;
    }
    // Where u vanishes at both ends, changes shrink by less and less: settled as elsewhere, 17 of
    // 1053 captures had errors of 3e-8 and more in a derivative, and none 2e-9 so.
    constexpr double tighter = end == PhaseEnd::release ? 1.0 : 0.03;
    restore_by<end>(rule, bottom, phase, tighter * settled_change_);
  }
  template <PhaseEnd end, class Rule, std::size_t count>
  [[gnu::always_inline]] void restore_by(const Rule& rule, const Pack& bottom, Path<count>& phase,
                                         double settle_below) {
    const auto look_at_all = [&] { phase.look(rule, law_, deepest_, end_, Pack(1.0), bottom); };
    if constexpr (end == PhaseEnd::release) {
      phase.template settle<false>(
          rule, settle_below, settle_below, look_at_all, [](const Pack&) { return Pack(0.0); },
          [](const Mask&, const Pack&) { return false; });
    } else {
      phase.template settle<false>(
          rule, settle_below, 0.1 * settle_below, look_at_all,
          [&](const Pack& loss) { return law_.potential(end_) - (bottom - loss); },
          [&](const Mask& moving, const Pack& loss) {
            if (none_of(moving)) return false;
            const Pack missing = law_.potential(end_) - (bottom - loss);
            const Pack moved = end_ - missing / law_.slope(end_);
            where(moving, end_) =
                pack_smaller(pack_larger(moved, 0.5 * (release_ + end_)), 0.5 * (resting_ + end_));
            return true;
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

  /// What a change of the kinetic energy at the nodes becomes by the end of the impact is exp(-x),
  /// x the integral of D dsigma from there to the end. `held` is D dsigma / ds.
  /// The derivative of that energy at the end is then the sum of what a parameter changes in the
  /// force, weighted so: the areas of Flights.
  /// @param sign 1 for the compression, else -1
  template <class Rule, std::size_t count>
  [[gnu::always_inline]] void follow(const Rule& rule, double sign, const Pack& acts,
                                     const Path<count>& phase, const Nodes<count>& held) {
    for (std::size_t first = 0; first < count; first += block) {
      const std::array<Pack, block> passed = block_times(rule.gauss.up_to, held, first);
      for (std::size_t k = 0; k < block; ++k) {
        const std::size_t i = first + k;
        const Pack stays = decay(held_out_ + sign * passed[k]);
        const Pack way = sign * (phase.length * rule.rate[i]) * stays;
        const auto force = law_.field(phase.place[i], sign * phase.speed[i], acts);
        for_each_group([&]<unsigned p>() {
          const Pack rate = way * force.template derivative<p + 1>();
          slopes_[p] += rule.gauss.weight[i] * rate;
          tails_[p] += rule.gauss.last[i] * rate;
          next_tails_[p] += rule.gauss.last_but_one[i] * rate;
        });
      }
    }
  }

  /// act.operator()<k>() for each group k.
  template <class Act>
  [[gnu::always_inline]] static void for_each_group(const Act& act) {
    [&]<unsigned... k>(std::integer_sequence<unsigned, k...>) {
      (act.template operator()<k>(), ...);
    }
    (std::make_integer_sequence<unsigned, parameters>{});
  }

  /// What changes of the energy become, and the gradient of half of e^2.
  template <std::size_t count, class Inwards, class Outwards>
  [[gnu::flatten]] void follow_both(const Inwards& inwards, const Outwards& outwards,
                                    const Path<count>& in, const Path<count>& out) {
    Nodes<count> held_in, held_out;
    for (std::size_t i = 0; i < count; ++i) held_in[i] = in.damping[i] * in.slowness[i];
    for (std::size_t i = 0; i < count; ++i) held_out[i] = out.damping[i] * out.slowness[i];
    held_out_ = row_times(outwards.gauss.weight, held_out);
    held_ = row_times(inwards.gauss.weight, held_in) + held_out_;
    all_ = decay(pack_smaller(held_, Pack(most_held)));
    held_defect_ = defect_of(inwards.gauss, held_in) + defect_of(outwards.gauss, held_out);
    if constexpr (with_gradient) {
      slopes_.fill(Pack(0.0));
      tails_.fill(Pack(0.0));
      next_tails_.fill(Pack(0.0));
      follow(inwards, 1.0, acts_at_first_, in, held_in);
      follow(outwards, -1.0, Pack(1.0), out, held_out);
      if constexpr (Law::constants > 0) {
        constexpr auto moving = [] {
          unsigned k = 0;
          while (Law::places[k] != place_of_range) ++k;
          return k;
        }();
        slopes_[moving] -=
            all_ * (law_.field(start_, Pack(1.0), acts_at_first_).value * start_slope_);
      }
      const auto potential = law_.potential_with_gradient(end_);
      for_each_group([&]<unsigned p>() { slopes_[p] += potential.template derivative<p + 1>(); });
    }
  }

  /// Takes impacts out of `good` whose last coefficients are not small beside the gradient.
  void put_gradients(double most_error, std::span<const ImpactGroups> queue,
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
      const ImpactGroups& impact = queue[order[lane]];
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

  /// value(entry) of each impact in `order`, and in lanes that are left over of the first.
  template <class Value>
  static Pack pack_of(std::span<const std::uint32_t> order, const Value& value) {
    std::array<double, lanes> values;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      values[lane] = value(order[lane < order.size() ? lane : 0]);
    }
    return Pack(values.data(), std::experimental::element_aligned);
  }
  static std::array<double, lanes> lanes_of(const Pack& pack) {
    std::array<double, lanes> values;
    pack.copy_to(values.data(), std::experimental::element_aligned);
    return values;
  }

  void take_all(std::span<const ImpactGroups> queue, std::span<const std::uint32_t> order,
                std::span<const Sketch> sketches) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      law_.set(lane, queue[order[lane < order.size() ? lane : 0]]);
    }
    const auto sketched = [&](double Sketch::*member) {
      return pack_of(order, [&](std::uint32_t entry) { return sketches[entry].*member; });
    };
    start_ = sketched(&Sketch::start);
    start_slope_ = sketched(&Sketch::start_slope);
    release_ = sketched(&Sketch::release);
    resting_ = sketched(&Sketch::resting);
    deepest_ = sketched(&Sketch::deepest);
    target_ = 0.5 + law_.potential(start_);
  }

  static constexpr int first_steps = 3;          // from LawPath::deepest, by Newton's rule
  static constexpr double coarse_change = 1e-4;  // of the losses, with few nodes
  static constexpr double most_held = 6.0;       // of the integral of D dsigma
  // An impact is difficult, and for more nodes or for Flights, where the last two coefficients of
  // the rates have not become small: the error of e^2 goes with their product with those of D
  // dsigma / ds, that of the gradient with the product of its own with these and with themselves.
  static constexpr double most_defect = 1e-4;
  // With few nodes such an impact has more than this: so 11 of 154 were missed and 17 of 831 others
  // taken for difficult (the impacts of the benchmark).
  static constexpr double most_sketched_defect = 0.016;
  static constexpr double most_e2_error = 1e-10;
  static constexpr double most_gradient_error = 1e-8;
  // So it is where the energy at the end is this part of what there is: near capture a zero of u
  // comes close to the way.
  static constexpr double nearest = 0.02;

  Pack acts_at_first_;
  double settled_change_;
  LawLanes<Law, Pack, with_gradient> law_;
  Pack start_ = 0.0, start_slope_ = 0.0, release_ = 0.0, resting_ = 0.0;
  Pack deepest_ = 0.0, end_ = 0.0;  // q of the turning point and of the end
  Pack target_ = 0.0;               // the energy at the start
  Pack bottom_ = 0.0;               // potential energy at the turning point
  Pack missing_ = 0.0;              // the energy at the start of the path that was found, less that
  Pack held_ = 0.0, held_out_ = 0.0;  // integral of D dsigma, of the impact and of its second phase
  Pack held_defect_ = 0.0;            // the last two coefficients of what is integrated there
  Pack all_ = 0.0;                    // exp(-held_)
  std::array<Pack, parameters> slopes_ = {}, tails_ = {}, next_tails_ = {};
};

}  // namespace recoil
