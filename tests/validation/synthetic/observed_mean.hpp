#pragma once

#include <cmath>
#include <optional>

#include "validation/synthetic/effects.hpp"

namespace hidden {

/// What one impact leaves behind.
struct Reading {
  bool captured = false;
  bool seen = false;         ///< it came back, and fast enough
  double restitution = 0.0;  ///< as read, where it is seen
};

/// One impact by itself. `typical` is the square of the restitution that all impacts of the point
/// share; nothing where the spheres differ. Draws the same numbers whatever becomes of it.
template <class Random>
Reading read_impact(const Base& base, const Effects& effects, const Scatter& scatter,
                    double velocity, double diameter, std::optional<double> typical,
                    Random& random) {
  double square = typical.value_or(0.0);
  if (!typical) {
    const double size = size_of(effects.size_spread, random.normal());
    const double adhesion = std::exp(effects.adhesion_spread * random.normal());
    square = square_of_restitution(base, effects, velocity, diameter, size, adhesion);
  }
  const double noise = random.normal();
  const double fate = random.uniform();
  const double chance = random.uniform();
  if (!(square > 0.0)) return {.captured = true};
  const double e = std::sqrt(square) * oddity_factor(effects, velocity);
  const double reading = e + scatter.of(e) * noise;
  if (reading * velocity < effects.slowest_rebound) return {};
  return {.seen = true, .restitution = fate < effects.outlier_share ? chance : reading};
}

/// The square of the restitution that all impacts share; nothing where the spheres differ.
inline std::optional<double> shared_square(const Base& base, const Effects& effects,
                                           double velocity, double diameter) {
  if (effects.size_spread > 0.0 || effects.adhesion_spread > 0.0) return std::nullopt;
  return square_of_restitution(base, effects, velocity, diameter);
}

template <class Random>
double observed_mean(const Base& base, const Effects& effects, const Scatter& scatter,
                     double velocity, double diameter, std::size_t series, int events,
                     Random& random) {
  const auto typical = shared_square(base, effects, velocity, diameter);
  double sum = 0.0;
  int seen = 0;
  for (int tries = 0; seen < events && tries < 1000 * events; ++tries) {
    const Reading one = read_impact(base, effects, scatter, velocity, diameter, typical, random);
    if (!one.seen) continue;
    sum += one.restitution;
    ++seen;
  }
  if (seen == 0) return 0.0;
  const double offset = effects.series_offset.empty() ? 0.0 : effects.series_offset[series];
  return sum / seen + offset;
}

}  // namespace hidden
