#include "impact/fast_solver.hpp"

#include <ceres/jet.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include "impact/dop853.hpp"
#include "impact/force_law.hpp"

namespace recoil {
namespace {

constexpr double tolerance = 1e-11;  // error of q and u per step; both are of order one
constexpr double smallest_step = 1e-9;
constexpr int most_steps = 3000;  // an impact takes 50; a sphere creeping into the well 1500

std::atomic<long> handovers{0};

double value_of(double x) { return x; }
template <int N>
double value_of(const ceres::Jet<double, N>& x) {
  return x.a;
}

template <class T>
struct State {
  T q, u;
};

/// What plays the part of time in a step.
enum class Clock {
  arc,       ///< sigma: anywhere
  approach,  ///< u: lands on u = 0 exactly
  depth,     ///< q: lands on q = 0 exactly
};

/// The regularised impact and its Runge-Kutta step.
template <class T>
struct Impact {
  T alpha, beta, gamma;
  bool adhesion_damping_acts = false;

  State<T> rate(const State<T>& s, Clock clock) const {
    const T f = regularised_acceleration(s.q, s.u, alpha, beta, gamma, adhesion_damping_acts);
    switch (clock) {
      case Clock::approach:
        return {s.u / f, T(1.0)};
      case Clock::depth:
        return {T(1.0), f / s.u};
      case Clock::arc:
        break;
    }
    return {s.u, f};
  }

  /// Advances `from` by `h` on `clock`; returns the error estimate relative to `tolerance`.
  double step(const State<T>& from, const T& h, Clock clock, State<T>& to) const {
    State<T> k[dop853::stages];
    k[0] = rate(from, clock);
    for (int i = 1; i < dop853::stages; ++i) {
      State<T> sum = {T(0.0), T(0.0)};
      for (int j = 0; j < i; ++j) {
        const double a = dop853::stage[i][j];
        if (a == 0.0) continue;
        sum.q += a * k[j].q;
        sum.u += a * k[j].u;
      }
      k[i] = rate({from.q + h * sum.q, from.u + h * sum.u}, clock);
    }
    State<T> sum = {T(0.0), T(0.0)};
    double q5 = 0.0, u5 = 0.0, q3 = 0.0, u3 = 0.0;
    for (int i = 0; i < dop853::stages; ++i) {
      sum.q += dop853::weight[i] * k[i].q;
      sum.u += dop853::weight[i] * k[i].u;
      q5 += dop853::error5[i] * value_of(k[i].q);
      u5 += dop853::error5[i] * value_of(k[i].u);
      q3 += dop853::error3[i] * value_of(k[i].q);
      u3 += dop853::error3[i] * value_of(k[i].u);
    }
    to = {from.q + h * sum.q, from.u + h * sum.u};
    const double scale_q = tolerance * std::max(1.0, std::abs(value_of(from.q)));
    const double scale_u = tolerance * std::max(1.0, std::abs(value_of(from.u)));
    const double fifth = std::pow(q5 / scale_q, 2) + std::pow(u5 / scale_u, 2);
    const double third = std::pow(q3 / scale_q, 2) + std::pow(u3 / scale_u, 2);
    if (fifth == 0.0) return 0.0;
    return std::abs(value_of(h)) * fifth / std::sqrt(2.0 * (fifth + 0.01 * third));
  }
};

/// The factor for the next step after an error estimate (1 = just tolerable), order 8.
double step_factor(double error) {
  if (!(error > 0.0)) return error == 0.0 ? 6.0 : 0.2;
  return std::clamp(0.9 * std::pow(error, -1.0 / 8.0), 0.2, 6.0);
}

enum class Event { none, turning, release };

template <class T>
class Flight {
 public:
  Flight(const T& alpha, const T& beta, const T& gamma, AdhesionDampingPhase phase)
      : impact_{alpha, beta, gamma, phase == AdhesionDampingPhase::both}, state_{T(0.0), T(1.0)} {
    // A first guess; the error estimate corrects it at once.
    beta_ = value_of(beta);
    step_ = 0.3 / (1.0 + std::sqrt(value_of(beta)) + value_of(alpha));
  }

  /// Both halves of the impact; true when it arrived at an end.
  bool fly() {
    if (!advance(false)) return false;
    impact_.adhesion_damping_acts = true;
    return advance(true);
  }

  const State<T>& state() const { return state_; }
  bool out_of_steps() const { return steps_ >= most_steps; }
  int steps() const { return steps_; }

 private:
  /// Steps in arc length until the next step would cross an event, then lands on it.
  bool advance(bool restitution) {
    while (steps_ < most_steps) {
      ++steps_;
      State<T> next;
      const double error = impact_.step(state_, T(step_), Clock::arc, next);
      if (!(error <= 1.0)) {
        step_ *= std::min(0.8, step_factor(error));
        if (step_ < smallest_step) return false;
        continue;
      }
      const Event event = crossed(next, restitution);
      if (event != Event::none) return land(event);
      state_ = next;
      step_ *= step_factor(error);
      if (restitution && has_settled(value_of(state_.q), value_of(state_.u), beta_)) return true;
    }
    return false;
  }

  static Event crossed(const State<T>& next, bool restitution) {
    if (!restitution) return value_of(next.u) <= 0.0 ? Event::turning : Event::none;
    if (value_of(next.q) <= 0.0) return Event::release;
    return value_of(next.u) >= 0.0 ? Event::turning : Event::none;
  }

  /// Goes the rest of the way with u (or q) as the clock: the last step ends on zero exactly.
  bool land(Event event) {
    const Clock clock = event == Event::turning ? Clock::approach : Clock::depth;
    const auto left = [&] { return event == Event::turning ? -state_.u : -state_.q; };
    double fraction = 1.0;
    while (steps_ < most_steps) {
      ++steps_;
      State<T> next;
      const T h = T(fraction) * left();
      const double error = impact_.step(state_, h, clock, next);
      const bool sound =
          std::isfinite(value_of(next.q)) && std::isfinite(value_of(next.u)) && error <= 1.0;
      if (sound) {
        state_ = next;
        if (fraction == 1.0) {
          (event == Event::turning ? state_.u : state_.q) = T(0.0);
          return true;
        }
        const double grown = fraction / (1.0 - fraction) * step_factor(error);
        fraction = std::min(1.0, grown);
      } else {
        fraction *= std::isfinite(error) ? std::min(0.8, step_factor(error)) : 0.5;
        if (fraction < 1e-3) return false;
      }
    }
    return false;
  }

  Impact<T> impact_;
  State<T> state_;
  double beta_;
  double step_;
  int steps_ = 0;
};

template <class T>
bool run(const T& alpha, const T& beta, const T& gamma, AdhesionDampingPhase phase, T& twice_energy,
         ImpactResult& result) {
  Flight<T> flight(alpha, beta, gamma, phase);
  const bool arrived = flight.fly();
  result.steps = flight.steps();
  if (!arrived) {
    result.outcome =
        flight.out_of_steps() ? ImpactOutcome::step_limit : ImpactOutcome::integration_failure;
    return false;
  }
  const State<T>& end = flight.state();
  twice_energy = end.u * end.u + T(2.0) * potential_energy(end.q, beta);
  return std::isfinite(value_of(twice_energy));
}

}  // namespace

ImpactResult simulate_impact_fast(const ImpactGroups& groups, const ImpactOptions& options) {
  assert(!options.budget);
  ImpactResult result;
  if (creeps_into_the_well(groups)) {
    result.outcome = ImpactOutcome::captured;
    result.restitution_squared = 2.0 * well_depth(groups.beta);
    result.gradient[1] = 2.5 * result.restitution_squared / groups.beta;
    return result;
  }
  bool arrived = false;
  if (options.gradient) {
    using Dual = ceres::Jet<double, 3>;
    Dual twice_energy;
    arrived = run(Dual(groups.alpha, 0), Dual(groups.beta, 1), Dual(groups.gamma, 2), options.phase,
                  twice_energy, result);
    result.restitution_squared = twice_energy.a;
    std::copy_n(twice_energy.v.data(), 3, result.gradient.begin());
  } else {
    arrived = run(groups.alpha, groups.beta, groups.gamma, options.phase,
                  result.restitution_squared, result);
  }
  if (!arrived) {
    ++handovers;
    return simulate_impact(groups, options);
  }
  result.outcome =
      result.restitution_squared > 0.0 ? ImpactOutcome::rebound : ImpactOutcome::captured;
  return result;
}

long reference_handovers() { return handovers; }

}  // namespace recoil
