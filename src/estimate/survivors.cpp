#include "estimate/survivors.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_erf.h>

#include <algorithm>
#include <array>
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

RootMoments by_quadrature(double u) {
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

/// `by_quadrature` on an even grid, for interpolation through six neighbours.
class Table {
 public:
  static constexpr double from = -12.0;
  static constexpr double to = 12.0;

  Table() {
    for (int i = 0; i < count; ++i) nodes_[static_cast<std::size_t>(i)] = by_quadrature(place(i));
  }

  /// @pre from <= u <= to. Error below 1e-11.
  RootMoments operator()(double u) const {
    const double at = (u - from) / step + margin;
    const int below = static_cast<int>(at);
    const double x = at - below;  // the neighbours lie at -2, -1, 0, 1, 2, 3
    const std::array<double, 6> d = {x + 2.0, x + 1.0, x, x - 1.0, x - 2.0, x - 3.0};
    constexpr std::array<double, 6> norm = {-120.0, 24.0, -12.0, 12.0, -24.0, 120.0};
    RootMoments sum;
    for (std::size_t k = 0; k < d.size(); ++k) {
      double weight = 1.0 / norm[k];
      for (std::size_t j = 0; j < d.size(); ++j) weight *= j == k ? 1.0 : d[j];
      const RootMoments& node = nodes_[static_cast<std::size_t>(below - 2) + k];
      sum.mean += weight * node.mean;
      sum.slope += weight * node.slope;
      sum.variance += weight * node.variance;
    }
    return sum;
  }

 private:
  static constexpr double step = 1.0 / 32.0;
  static constexpr int margin = 3;
  static constexpr int count = static_cast<int>((to - from) / step) + 2 * margin + 1;
  static double place(int i) { return from + (i - margin) * step; }

  std::array<RootMoments, count> nodes_;
};

}  // namespace

RootMoments root_of_positive_normal(double u) {
  if (u > Table::to) return far_above_capture(u);
  if (!(u > Table::from)) return by_quadrature(u);
  static const Table table;
  return table(u);
}

}  // namespace recoil
