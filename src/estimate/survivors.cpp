#include "estimate/survivors.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_erf.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace recoil {
namespace {

/// E sqrt(u + z) expanded in 1 / u^2; what falls below zero weighs less than 1e-30.
RootMoments far_above_capture(double u) {
  const double q = 1.0 / (u * u);
  const double root = std::sqrt(u);
  constexpr double a = 1.0 / 8.0;
  constexpr double b = 15.0 / 128.0;
  constexpr double c = 315.0 / 1024.0;
  constexpr double d = 45045.0 / 32768.0;
  const double mean = root * (1.0 - q * (a + q * (b + q * (c + q * d))));
  const double slope = (0.5 + q * (1.5 * a + q * (3.5 * b + q * (5.5 * c + q * 7.5 * d)))) / root;
  // u - mean^2 without cancellation: u (1 - (1 - s)^2) with s the sum in mean.
  const double s = q * (a + q * (b + q * (c + q * d)));
  return {mean, slope, u * s * (2.0 - s)};
}

}  // namespace

RootMoments root_of_positive_normal(double u) {
  constexpr double series_from = 12.0;
  if (u > series_from) return far_above_capture(u);
  const double lambda = gsl_sf_hazard(-u);
  // Density of y = u + z given y > 0, in a form that does not overflow on either side.
  const double inverse_norm =
      u > 0.0 ? 1.0 / (std::sqrt(2.0 * std::numbers::pi) * gsl_cdf_ugaussian_P(u)) : lambda;
  const auto density = [&](double y) {
    const double exponent = u > 0.0 ? -0.5 * (y - u) * (y - u) : y * (u - 0.5 * y);
    return std::exp(exponent) * inverse_norm;
  };
  constexpr int nodes = 64;
  const double reach = std::sqrt(u < 0.0 ? std::min(9.0, 40.0 / -u) : u + 9.0);
  const double step = reach / nodes;
  double half = 0.0;   // E y^(1/2)
  double three = 0.0;  // E y^(3/2)
  for (int i = 1; i <= nodes; ++i) {
    const double t = i * step;
    const double weight = 2.0 * t * density(t * t) * step;
    half += t * weight;
    three += t * t * t * weight;
  }
  return {half, three - (u + lambda) * half, u + lambda - half * half};
}

}  // namespace recoil
