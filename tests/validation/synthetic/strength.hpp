#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "validation/synthetic/design.hpp"

namespace recoil::hidden {

/// The base model fitted to noiseless points, C_H and C_A free and f0 as stated.
struct Refit {
  double C_H = 0.0;
  double C_A = 0.0;
  double signal_to_noise = 0.0;  ///< sqrt(sum ((e - e_base) / sd)^2) at the best fit
};

/// (e^2 - e_base^2) / (sd (e + e_base)) of every point, the base with C_H and C_A [s/m]; e_base^2
/// is continued below capture.
Eigen::VectorXd base_residuals(const Design& design, const std::vector<Point>& points, double C_H,
                               double C_A);

/// Levenberg and Marquardt's method with difference quotients, from the true parameters, on
/// `base_residuals`.
Refit refit_base(const Design& design, const std::vector<Point>& points);

/// How strong an effect must be to leave a misfit of `target`.
struct Strength {
  bool reached = false;
  double value = 0.0;            ///< or the largest that was tried
  double signal_to_noise = 0.0;  ///< there
};

/// @param effects_at Effects for a strength in [0, largest]
template <class EffectsAt>
Strength find_strength(const Design& design, const EffectsAt& effects_at, double largest,
                       double target) {
  // What cannot be measured (all captured) counts as too strong.
  const auto measure = [&](double value) {
    Strength s;
    s.value = value;
    const std::vector<Point> points = expected_points(design, effects_at(value));
    s.signal_to_noise = points.empty() ? -1.0 : refit_base(design, points).signal_to_noise;
    return s;
  };
  // From above: halve until it can be measured at all, then bisect in the logarithm, guided by the
  // logarithm of the misfit where both ends have one.
  double high = largest;
  Strength top = measure(high);
  double empty = 0.0;  // lowest strength known to be too strong to measure
  for (int i = 0; i < 40 && top.signal_to_noise < 0.0; ++i) {
    empty = high;
    high *= 0.7;
    top = measure(high);
  }
  for (int i = 0; i < 8 && empty > 0.0 && top.signal_to_noise < target; ++i) {
    const double middle = std::sqrt(high * empty);
    const Strength s = measure(middle);
    if (s.signal_to_noise < 0.0) {
      empty = middle;
    } else {
      high = middle;
      top = s;
    }
  }
  const double tolerance = 0.01;
  if (std::abs(top.signal_to_noise / target - 1.0) < tolerance) {
    top.reached = true;
    return top;
  }
  if (top.signal_to_noise < target) return top;
  double low = 0.0;
  double at_low = 0.0;
  double at_high = top.signal_to_noise;
  double guess = high * target / at_high;
  Strength best = top;
  for (int i = 0; i < 40; ++i) {
    best = measure(guess);
    if (std::abs(best.signal_to_noise / target - 1.0) < tolerance) break;
    (best.signal_to_noise < target ? low : high) = guess;
    (best.signal_to_noise < target ? at_low : at_high) = best.signal_to_noise;
    if (low == 0.0) {
      guess = high * std::max(0.1, std::min(0.9, target / at_high));
      if (guess < 1e-9 * largest) break;
    } else {
      const double part = std::log(target / at_low) / std::log(at_high / at_low);
      const double safe = at_low > 0.0 && part > 0.1 && part < 0.9 ? part : 0.5;
      guess = low * std::pow(high / low, safe);
      if (high / low < 1.0 + 1e-7) break;
    }
  }
  best.reached = std::abs(best.signal_to_noise / target - 1.0) < 0.03;
  return best;
}

}  // namespace recoil::hidden
