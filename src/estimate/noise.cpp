#include "estimate/noise.hpp"

#include <algorithm>
#include <cmath>

namespace recoil {
namespace {

// e below which the sd of proportional noise is nearly constant.
constexpr double proportional_floor = 0.1;
constexpr double steepness = 2.0;  // d ln sd / d (V* / V)^2

}  // namespace

double Noise::estimated_sd(double restitution_squared, double proximity, int impacts) const {
  const double s = scale / std::sqrt(static_cast<double>(std::max(1, impacts)));
  const double square = std::max(restitution_squared, 0.0);
  switch (variance) {
    case VarianceFunction::stated:
    case VarianceFunction::constant:
      break;
    case VarianceFunction::proportional:
      return s * std::sqrt(square + proportional_floor * proportional_floor);
    case VarianceFunction::capture:
      // 4 e^2 sd^2 + 2 sd^4 = s^2, the variance of e^2 for a normal e.
      return s * std::sqrt(0.5 / (square + std::sqrt(square * square + 0.5 * s * s)));
    case VarianceFunction::steep:
      return s * std::exp(steepness * proximity);
  }
  return s;
}

Noise first_noise(const StatedNoise& stated) {
  Noise noise;
  if (stated.sd_stated) return noise;
  noise.variance = stated.spec.variance.value_or(VarianceFunction::constant);
  noise.scale = nominal_sd;
  return noise;
}

}  // namespace recoil
