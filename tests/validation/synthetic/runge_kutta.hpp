#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

/// Data with a hidden effect, made by physics of their own: nothing here knows the fitter.
namespace recoil::hidden {

template <std::size_t N>
using State = std::array<double, N>;

/// One step of Dormand & Prince (1980), J. Comput. Appl. Math. 6, 19-26: order 5, with the
/// difference to order 4 as the error.
template <std::size_t N, class Field>
void runge_kutta_step(const Field& field, const State<N>& y, double h, State<N>& next,
                      State<N>& error) {
  static constexpr double a[7][6] = {
      {},
      {1.0 / 5.0},
      {3.0 / 40.0, 9.0 / 40.0},
      {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
      {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
      {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
      {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0}};
  static constexpr double fourth[7] = {
      5179.0 / 57600.0, 0.0,       7571.0 / 16695.0, 393.0 / 640.0, -92097.0 / 339200.0,
      187.0 / 2100.0,   1.0 / 40.0};
  State<N> k[7];
  State<N> at = y;
  for (std::size_t stage = 0; stage < 7; ++stage) {
    for (std::size_t i = 0; i < N; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < stage; ++j) sum += a[stage][j] * k[j][i];
      at[i] = y[i] + h * sum;
    }
    k[stage] = field(at);
  }
  next = at;  // the last stage is the solution of order 5
  for (std::size_t i = 0; i < N; ++i) {
    double lower = 0.0;
    for (std::size_t j = 0; j < 7; ++j) lower += fourth[j] * k[j][i];
    error[i] = next[i] - (y[i] + h * lower);
  }
}

/// Integrates dy/dt = field(y) from `y` until event(y), positive at first, falls to zero, and sets
/// `y` there. Components are good to `tolerance` times `size` per step.
/// @return false when that does not happen within `most_steps`
template <std::size_t N, class Field, class Event>
bool integrate_until(const Field& field, const Event& event, State<N>& y, double first_step,
                     const State<N>& size, double tolerance = 1e-9, int most_steps = 20000) {
  double h = first_step;
  State<N> next;
  State<N> error;
  for (int step = 0; step < most_steps; ++step) {
    runge_kutta_step<N>(field, y, h, next, error);
    double worst = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
      worst = std::max(worst, std::abs(error[i]) / (tolerance * size[i]));
    }
    if (!std::isfinite(worst)) worst = 1e10;
    const double factor = std::clamp(0.9 * std::pow(std::max(worst, 1e-10), -0.2), 0.1, 5.0);
    if (worst > 1.0) {
      h *= factor;
      continue;
    }
    const double after = event(next);
    if (after > 0.0) {
      y = next;
      h *= factor;
      continue;
    }
    // The event lies within this step: its part of the step, by the Illinois variant of the secant.
    const State<N> start = y;
    double low = 0.0;
    double high = 1.0;
    double at_low = event(start);
    double at_high = after;
    for (int round = 0; round < 60 && high - low > 1e-13; ++round) {
      const double part = (low * at_high - high * at_low) / (at_high - at_low);
      const double middle = part > low && part < high ? part : 0.5 * (low + high);
      runge_kutta_step<N>(field, start, middle * h, next, error);
      const double value = event(next);
      y = next;
      if (value == 0.0) break;
      if (value > 0.0) {
        low = middle;
        at_low = value;
        at_high *= 0.5;
      } else {
        high = middle;
        at_high = value;
        at_low *= 0.5;
      }
      if (std::abs(value) < 1e-13 * std::abs(event(start))) break;
    }
    return true;
  }
  return false;
}

}  // namespace recoil::hidden
