#pragma once

#include <vector>

#include "validation/synthetic/design.hpp"

namespace hidden {

/// The base model fitted to noiseless points, C_H and C_A free and f0 as stated.
struct Refit {
  double C_H = 0.0;
  double C_A = 0.0;
  double signal_to_noise = 0.0;  ///< sqrt(sum ((e - e_base) / sd)^2) at the best fit
};

/// Levenberg and Marquardt's method with difference quotients, from the true parameters. Residuals
/// are those of e^2, continued below capture, over sd (e + e_base).
Refit refit_base(const Design& design, const std::vector<Point>& points);

/// How strong an effect must be to leave a misfit of `target`.
struct Strength {
  bool reached = false;
  double value = 0.0;            ///< or the largest that was tried
  double signal_to_noise = 0.0;  ///< there
  std::vector<Point> points;     ///< there, without noise
  Refit refit;
};

/// @param effects_at Effects for a strength in [0, largest]
template <class EffectsAt>
Strength find_strength(const Design& design, const EffectsAt& effects_at, double largest,
                       double target);

}  // namespace hidden

#include "validation/synthetic/find_strength.hpp"
