#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "impact/creep_limit.hpp"
#include "impact/dop853.hpp"
#include "impact/force_law.hpp"
#include "impact/impact.hpp"
#include "impact/law_lanes.hpp"

namespace recoil {

/// Integrates several impacts at once, one per lane of `Pack`, each with its own step size and end.
/// A lane that has finished takes the next impact of the queue.
///
/// Every lane integrates dq/dsigma = u, du/dsigma = f(q, u; p) by DOP853, f from `Law`, from first
/// contact to the release, where f = 0. The last step before an event uses u (turning point) or q
/// (release) as the independent variable and so ends exactly at the event (Henon 1982, Physica D 5,
/// 412-414): an event step.
///
/// The gradient uses the area D_p = F x (d state / d p), F = (u, f), because in a planar flow
/// neighbouring paths separate in only one direction. It obeys
///   D_p' = (df/du) D_p + u df/dp,   D_p = -f dq/dp at first contact,
/// for any parametrisation of the path (Melnikov 1963 uses the same area). So
///   D_p = (1/mu) [D_p(first contact) + integral mu u (df/dp) dsigma],
///   mu' = -(df/du) mu,  mu = 1 at first contact,
/// which needs one more component and one integral per parameter, instead of two components per
/// parameter. At both ends d(e^2)/dp = 2 D_p + 2 dP/dp at constant q, P = potential energy. D_p is
/// continuous at the inner turning point, because f is.
template <class Law, class Pack, bool with_gradient>
class StepSolver {
 public:
  /// @param order which impacts of `groups` to integrate
  StepSolver(std::span<const ImpactGroups> groups, std::span<const std::uint32_t> order,
             const ImpactOptions& options, std::span<ImpactResult> results)
      : queue_(groups),
        order_(order),
        results_(results),
        phase_(options.phase),
        never_pulls_(options.never_pulls),
        tolerance_(options.fast_tolerance) {}

  void solve() {
    for (std::size_t lane = 0; lane < lanes; ++lane) take_next(lane);
    while (any_of(busy_)) {
      take(make_step());
      finish_lanes();
    }
  }

 private:
  static constexpr std::size_t lanes = Pack::size();
  using Mask = typename Pack::mask_type;
  static constexpr unsigned parameters = Law::groups;
  /// A law of several hundred operations is called instead of inlined into each of the stages.
  static constexpr bool has_dashpot = Law::places.back() == place_of_kappa;
  static constexpr bool is_long = Law::constants > 0 && !has_dashpot;

  // Error of mu per step, relative to mu, in units of the tolerance of q and u: the gradient needs
  // fewer digits than e^2.
  static constexpr double mu_tolerance = 10.0;
  static constexpr double smallest_step = 1e-9;
  static constexpr double smallest_fraction = 1e-3;  // of the distance to an event
  // Of the elastic force: the size of elastic force and dashpot at which they cease to act, or act
  // again; the kappa below which the place does not matter; and the first step from there.
  static constexpr double balanced = 1e-8, no_dashpot = 1e-9, step_from_there = 0.1;
  static constexpr double most_steps = 3000.0;  // an impact takes 40

  struct Step {
    Pack q, u, mu;
    std::array<Pack, parameters> areas;
    Pack error;  // relative to the tolerance
  };

  static Pack select(const Mask& mask, const Pack& yes, Pack no) {
    where(mask, no) = yes;
    return no;
  }

  /// sum_j coefficient(j) k[j] over the coefficients that are not zero.
  template <class Row>
  static Pack combine(const std::array<Pack, dop853::stages>& k, Row row) {
    Pack sum = 0.0;
    [&]<std::size_t... j>(std::index_sequence<j...>) {
      const auto add = [&]<std::size_t column>() {
        constexpr double coefficient = Row{}(column);
        if constexpr (coefficient != 0.0) sum += coefficient * k[column];
      };
      (add.template operator()<j>(), ...);
    }
    (std::make_index_sequence<dop853::stages>{});
    static_cast<void>(row);
    return sum;
  }

  /// One Runge-Kutta step of every lane. The independent variable is the arc length, or u or q in
  /// an event step.
  [[gnu::flatten]] Step make_step() const {
    const bool some_events = any_of(event_step_);
    const Pack length =
        some_events
            ? select(event_step_, fraction_ * select(to_turning_, -u_, event_place() - q_), length_)
            : length_;
    std::array<Pack, dop853::stages> rate_q, rate_u, rate_mu;
    Step to;
    to.areas.fill(Pack(0.0));
    Pack q5 = 0.0, u5 = 0.0, mu5 = 0.0, q3 = 0.0, u3 = 0.0, mu3 = 0.0;
    const auto stage = [&]<std::size_t i>() {
      Pack q = q_, u = u_, mu = mu_;
      if constexpr (i > 0) {
        constexpr auto row = [](std::size_t j) { return j < i ? dop853::stage[i][j] : 0.0; };
        q += length * combine(rate_q, row);
        u += length * combine(rate_u, row);
        if constexpr (with_gradient) mu += length * combine(rate_mu, row);
      }
      const auto f = field(q, u);
      Pack per_clock = 1.0;
      if (some_events) {
        per_clock = 1.0 / select(event_step_, select(to_turning_, f.value, u), Pack(1.0));
      }
      const auto on_clock = [&](const Pack& rate) { return some_events ? rate * per_clock : rate; };
      rate_q[i] = on_clock(u);
      rate_u[i] = on_clock(f.value);
      if constexpr (with_gradient) rate_mu[i] = on_clock(-(f.template derivative<0>() * mu));
      if constexpr (dop853::weight[i] != 0.0) {
        q5 += dop853::error5[i] * rate_q[i];
        u5 += dop853::error5[i] * rate_u[i];
        q3 += dop853::error3[i] * rate_q[i];
        u3 += dop853::error3[i] * rate_u[i];
        if constexpr (with_gradient) {
          mu5 += dop853::error5[i] * rate_mu[i];
          mu3 += dop853::error3[i] * rate_mu[i];
          const Pack weight = dop853::weight[i] * on_clock(mu * u);
          [&]<unsigned... p>(std::integer_sequence<unsigned, p...>) {
            ((to.areas[p] += weight * f.template derivative<p + 1>()), ...);
          }
          (std::make_integer_sequence<unsigned, parameters>{});
        }
      }
    };
    [&]<std::size_t... i>(std::index_sequence<i...>) { (stage.template operator()<i>(), ...); }
    (std::make_index_sequence<dop853::stages>{});

    constexpr auto weights = [](std::size_t j) { return dop853::weight[j]; };
    to.q = q_ + length * combine(rate_q, weights);
    to.u = u_ + length * combine(rate_u, weights);
    to.mu = with_gradient ? mu_ + length * combine(rate_mu, weights) : mu_;
    for (Pack& area : to.areas) area *= length;
    const Pack per_q = 1.0 / (tolerance_ * max(Pack(1.0), abs(q_)));
    const Pack per_u = 1.0 / (tolerance_ * max(Pack(1.0), abs(u_)));
    Pack fifth = q5 * per_q * (q5 * per_q) + u5 * per_u * (u5 * per_u);
    Pack third = q3 * per_q * (q3 * per_q) + u3 * per_u * (u3 * per_u);
    if constexpr (with_gradient) {
      const Pack per_mu = 1.0 / (mu_tolerance * tolerance_ * mu_);
      fifth += mu5 * per_mu * (mu5 * per_mu);
      third += mu3 * per_mu * (mu3 * per_mu);
    }
    constexpr double never_zero = 1e-300;
    to.error = abs(length) * fifth / sqrt(2.0 * (fifth + 0.01 * third) + never_zero);
    return to;
  }

  /// f with its derivatives: variable 0 is u, variable k + 1 is group k.
  auto field(const Pack& q, const Pack& u) const {
    if constexpr (is_long) {
      return field_apart(q, u);
    } else {
      return field_here(q, u);
    }
  }
  [[gnu::noinline, gnu::flatten]] auto field_apart(const Pack& q, const Pack& u) const {
    return field_here(q, u);
  }
  [[gnu::always_inline]] auto field_here(const Pack& q, const Pack& u) const {
    if constexpr (with_gradient) {
      return law_.field_with_slopes(q, u, acts_);
    } else {
      return Partial<Pack, 0U>{law_.field(q, u, acts_), {}};
    }
  }

  /// Accepts the step of every lane, repeats it, or changes it to an event step.
  [[gnu::flatten]] void take(const Step& to) {
    steps_ += 1.0;
    const Mask good = to.error <= 1.0;  // false for NaN
    const Mask event = turned_ && (to.q <= release_ || to.u >= 0.0);
    const Mask seam = crosses_seam(to.q);
    const Mask switches = good && passes_balance(to);
    const Mask crosses =
        good && !event_step_ && !switches && (seam || event || (!turned_ && to.u <= 0.0));
    const Mask accepted = good && !crosses && !switches;
    if constexpr (has_dashpot) approach_balance(to, switches);
    where(crosses, to_turning_) = !(seam || (turned_ && to.q <= release_));
    if constexpr (is_long) where(crosses, to_seam_) = seam;
    where(accepted, q_) = to.q;
    where(accepted, u_) = to.u;
    if constexpr (with_gradient) {
      where(accepted, mu_) = to.mu;
      for (unsigned p = 0; p < parameters; ++p) where(accepted, areas_[p]) += to.areas[p];
    }
    const Mask arrived = event_step_ && good && fraction_ == 1.0;
    where(arrived && to_turning_, u_) = 0.0;
    where(arrived && !to_turning_, q_) = event_place();
    adapt(to.error, good, crosses || switches);
    if constexpr (has_dashpot) switch_at_balance(accepted && !event_step_);
    event_step_ = (event_step_ || crosses) && !arrived;
    Mask at_end = arrived;
    if constexpr (is_long) {
      Pack& side = law_.constants.back();
      where(arrived && to_seam_, side) = 1.0 - side;
      at_end = arrived && !to_seam_;
      where(arrived, to_seam_) = false;
    }
    ended_ = at_end && turned_;
    const Mask turns = at_end && !turned_;
    turned_ = turned_ || turns;
    where(turns, acts_) = 1.0;
    const Mask outward = turned_ && !event_step_ && !ended_;
    settled_ = outward && energy(q_, u_) < settle_below_;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (outward[lane] && creep_[lane].is_certain(q_[lane], -u_[lane])) settled_[lane] = true;
    }
    lost_ = steps_ >= most_steps || length_ < smallest_step || fraction_ < smallest_fraction;
  }

  /// True for lanes whose elastic force and dashpot change the sign of their sum, or that would
  /// come to the release before, in a step by arc length on the way out.
  Mask passes_balance([[maybe_unused]] const Step& to) const {
    if constexpr (has_dashpot) {
      const Mask acting = law_.constants.back() > 0.5;
      const Pack push = law_.push(to.q, to.u), least = balanced * abs(law_.push(to.q, Pack(0.0)));
      return limited_ && turned_ && !event_step_ &&
             ((acting && (push > least || to.q <= release_)) || (!acting && push < -least));
    } else {
      return Mask(false);
    }
  }
  /// Shortens the step of these lanes to where a straight line through both sums is 0.
  void approach_balance(const Step& to, const Mask& switches) {
    if (!any_of(switches)) return;
    const Pack before = law_.push(q_, u_), after = law_.push(to.q, to.u);
    Pack part = before / (before - after);
    where(!(part > 1e-3 && part < 0.9), part) = 0.5;
    where(switches, length_) *= part;
  }
  void switch_at_balance(const Mask& accepted) {
    const Mask now = accepted && limited_ && turned_ && q_ > release_ && !ended_ &&
                     abs(law_.push(q_, u_)) <= balanced * abs(law_.push(q_, Pack(0.0)));
    Pack& acting = law_.constants.back();
    where(now, acting) = 1.0 - acting;
    where(now, length_) = step_from_there;
  }

  /// The q of an event that is no turning point.
  Pack event_place() const {
    if constexpr (is_long) {
      return select(to_seam_, Pack(0.0), release_);
    } else {
      return release_;
    }
  }

  /// True for lanes that cross the seam of the law at q = 0 between q_ and `q`, moving towards it.
  /// This precedes any other event of the step. A lane that moves away has to turn first.
  Mask crosses_seam([[maybe_unused]] const Pack& q) const {
    if constexpr (is_long) {
      return seam_ && q_ * q < 0.0 && q_ * u_ < 0.0;
    } else {
      return Mask(false);
    }
  }

  /// The next step of every lane, for a method of order 8.
  void adapt(const Pack& error, const Mask& good, const Mask& crosses) {
    constexpr double safety = 0.9, most_shrinking = 0.2, most_growing = 6.0, after_failure = 0.8;
    Pack factor = safety / sqrt(sqrt(sqrt(max(error, Pack(1e-16)))));
    factor = min(Pack(most_growing), max(Pack(most_shrinking), factor));
    where(!good, factor) = min(Pack(after_failure), factor);
    where(!(error == error), factor) = most_shrinking;
    where(!event_step_ && !crosses, length_) *= factor;
    // After an accepted part, 1 - fraction_ of the distance to the event remains.
    constexpr double never_zero = 1e-300;
    const Pack covered = min(Pack(1.0), fraction_ / (1.0 - fraction_ + never_zero) * factor);
    where(event_step_, fraction_) = select(good, covered, fraction_ * factor);
    where(crosses, fraction_) = 1.0;
  }

  Pack energy(const Pack& q, const Pack& u) const {
    if constexpr (is_long) {
      return energy_apart(q, u);
    } else {
      return energy_here(q, u);
    }
  }
  [[gnu::noinline, gnu::flatten]] Pack energy_apart(const Pack& q, const Pack& u) const {
    return energy_here(q, u);
  }
  [[gnu::always_inline]] Pack energy_here(const Pack& q, const Pack& u) const {
    return 0.5 * u * u + law_.potential(q);
  }

  void finish_lanes() {
    const Mask done = busy_ && (ended_ || settled_ || lost_);
    if (!any_of(done)) return;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (!done[lane]) continue;
      write(lane, results_[impact_[lane]]);
      take_next(lane);
    }
  }

  void write(std::size_t lane, ImpactResult& result) const {
    result.steps = static_cast<long>(double(steps_[lane]));
    if (!ended_[lane] && !settled_[lane]) {
      result.outcome = steps_[lane] >= most_steps ? ImpactOutcome::step_limit
                                                  : ImpactOutcome::integration_failure;
      return;
    }
    // At rest in the well the result depends on the depth only, not on the path.
    const double q = settled_[lane] ? resting_q_[lane] : q_[lane];
    const double u = settled_[lane] ? 0.0 : double(u_[lane]);
    const auto area = [&](unsigned k) {
      return settled_[lane] ? 0.0 : areas_[k][lane] / mu_[lane];
    };
    law_.write(lane, queue_[impact_[lane]], q, u, with_gradient, area, result);
  }

  /// Puts the next impact of the queue into `lane`. An idle lane integrates an impact whose result
  /// is discarded.
  void take_next(std::size_t lane) {
    const bool work = next_ < order_.size();
    impact_[lane] = work ? order_[next_] : 0;
    const ImpactGroups groups = work ? queue_[impact_[lane]] : ImpactGroups{};
    next_ += work ? 1 : 0;
    busy_[lane] = work;
    law_.set(lane, groups);
    for (Pack& area : areas_) area[lane] = 0.0;
    const LawPath path = Law::path_of(groups);
    release_[lane] = path.release;
    acts_[lane] = phase_ == AdhesionDampingPhase::both ? 1.0 : 0.0;
    q_[lane] = path.start;
    u_[lane] = 1.0;
    mu_[lane] = 1.0;
    // A first guess; the error estimate corrects it at once.
    length_[lane] = 0.3 / (1.0 + __builtin_sqrt(groups.beta) + groups.alpha);
    fraction_[lane] = 1.0;
    steps_[lane] = 0.0;
    resting_q_[lane] = path.resting;
    creep_[lane] = CreepLimit<Law>(groups, path);
    if constexpr (is_long) {
      settle_below_[lane] = (1.0 - settled_part) * Law::depth(groups);
      seam_[lane] = path.seam;
      to_seam_[lane] = false;
    } else {
      settle_below_[lane] = (1.0 - settled_part) * energy(resting_q_, Pack(0.0))[lane];
    }
    if constexpr (has_dashpot) limited_[lane] = never_pulls_ && groups.kappa > no_dashpot;
    if constexpr (with_gradient && is_long) {
      areas_[group_of_range<Law>][lane] = -field(q_, u_).value[lane] * path.range_slope;
    }
    turned_[lane] = event_step_[lane] = to_turning_[lane] = false;
    ended_[lane] = settled_[lane] = lost_[lane] = false;
  }

  std::span<const ImpactGroups> queue_;
  std::span<const std::uint32_t> order_;
  std::span<ImpactResult> results_;
  AdhesionDampingPhase phase_;
  bool never_pulls_;
  double tolerance_;  // error of q and u per step; both are of order one
  std::size_t next_ = 0;
  std::array<std::size_t, lanes> impact_ = {};  // the impact of each lane

  LawLanes<Law, Pack> law_;
  Pack release_ = 0.0;  // q of the release
  Pack acts_ = 0.0;     // 1 if the adhesion damping acts, else 0
  Pack q_ = 0.0, u_ = 0.0, mu_ = 0.0;
  std::array<Pack, parameters> areas_ = {};  // integral of mu u df/dp
  Pack length_ = 0.0;                        // of the next step, in arc length
  Pack fraction_ = 0.0;                      // of the distance to the event, of the next event step
  Pack steps_ = 0.0;
  Pack resting_q_ = 0.0, settle_below_ = 0.0;
  std::array<CreepLimit<Law>, lanes> creep_ = {};
  Mask busy_{false};
  Mask turned_{false};      // past the inner turning point
  Mask event_step_{false};  // the next step is an event step
  Mask seam_{false};        // the law differs for q < 0
  Mask limited_{false};     // elastic force and dashpot never pull
  Mask to_seam_{false};     // the event is the seam at q = 0
  Mask to_turning_{false};  // the event is a turning point, otherwise a release or seam
  Mask ended_{false}, settled_{false}, lost_{false};
};

}  // namespace recoil
