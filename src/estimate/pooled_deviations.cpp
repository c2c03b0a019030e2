#include "estimate/pooled_deviations.hpp"

#include <gsl/gsl_cdf.h>

#include <cmath>

namespace recoil {

bool pools_deviation(const Observation& point) {
  return !point.censored && point.captured == 0 && point.events > 1;
}

std::optional<PooledNoise> pool_deviations(const Observations& data, const Weights& weights,
                                           std::span<const double> predicted) {
  constexpr double level = 0.01;  // of Bartlett's test
  constexpr int rounds = 5;       // `capture` is not exactly proportional to its scale
  int points = 0;
  double dof = 0.0, inverse = 0.0, square = 0.0;
  double own = 0.0;  // sum of nu ln s^2
  for (const Observation& point : data.points) {
    if (!pools_deviation(point)) continue;
    const double nu = point.events - 1;
    ++points;
    dof += nu;
    inverse += 1.0 / nu;
    square += nu * std::pow(point.event_sd(point.sd), 2);
    own += 2.0 * nu * std::log(point.sd);
  }
  if (points == 0) return std::nullopt;
  PooledNoise best;
  double least = INFINITY;
  for (const VarianceFunction function : values_of<VarianceFunction>()) {
    if (function == VarianceFunction::stated) continue;
    Noise law;
    law.variance = function;
    law.scale = std::sqrt(square / dof);
    double deviance = 0.0;
    for (int round = 0; round < rounds; ++round) {
      double sum = 0.0;
      deviance = -own;
      for (std::size_t i = 0; i < data.points.size(); ++i) {
        const Observation& point = data.points[i];
        if (!pools_deviation(point)) continue;
        const double sd = law.estimated_sd(predicted[i], weights.points[i].proximity, point.events);
        sum += (point.events - 1) * std::pow(point.sd / sd, 2);
        deviance += 2.0 * (point.events - 1) * std::log(sd);
      }
      // Without the term sum - dof, which vanishes at the best scale.
      law.scale *= std::sqrt(sum / dof);
      deviance += dof * std::log(sum / dof);
    }
    if (!(deviance < least)) continue;
    least = deviance;
    best = {function, law.scale, static_cast<int>(dof)};
  }
  if (points == 1) return best;
  const double correction = 1.0 + (inverse - 1.0 / dof) / (3.0 * (points - 1));
  if (gsl_cdf_chisq_Q(least / correction, points - 1) < level) return std::nullopt;
  return best;
}

}  // namespace recoil
