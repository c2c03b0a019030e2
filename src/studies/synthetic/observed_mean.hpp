#pragma once

#include <cmath>

#include "studies/synthetic/effects.hpp"

namespace hidden {

template <class Random>
double observed_mean(const Base& base, const Effects& effects, const Scatter& scatter,
                     double velocity, double diameter, std::size_t series, int events,
                     Random& random) {
  const bool differ = effects.size_spread > 0.0 || effects.adhesion_spread > 0.0;
  const double odd = oddity_factor(effects, velocity);
  double typical = -1.0;
  if (!differ) typical = square_of_restitution(base, effects, velocity, diameter);
  double sum = 0.0;
  int seen = 0;
  for (int tries = 0; seen < events && tries < 1000 * events; ++tries) {
    double square = typical;
    if (differ) {
      const double size = size_of(effects.size_spread, random.normal());
      const double adhesion = std::exp(effects.adhesion_spread * random.normal());
      square = square_of_restitution(base, effects, velocity, diameter, size, adhesion);
    }
    const double noise = random.normal();
    const double fate = random.uniform();
    const double chance = random.uniform();
    if (!(square > 0.0)) continue;
    const double e = std::sqrt(square) * odd;
    double reading = e + scatter.of(e) * noise;
    if (reading * velocity < effects.slowest_rebound) continue;
    if (fate < effects.outlier_share) reading = chance;
    sum += reading;
    ++seen;
  }
  if (seen == 0) return 0.0;
  const double offset = effects.series_offset.empty() ? 0.0 : effects.series_offset[series];
  return sum / seen + offset;
}

}  // namespace hidden
