#include "estimate/odd_point.hpp"

#include <gsl/gsl_cdf.h>

#include <cmath>
#include <numeric>

#include "core/numerics.hpp"

namespace recoil {
namespace {

constexpr double stated_level = 0.05;
constexpr double estimated_level = 0.01;
constexpr double rejected = 0.05;  // p-value below which a fit is rejected
constexpr double fixed = 1e-9;     // 1 - h of a point that alone determines a parameter

}  // namespace

std::optional<OddPoint> odd_point(const FitResult& fitted) {
  gsl_errors_are_values();
  const bool stated = fitted.data.noise.sd_stated;
  const std::size_t n = fitted.data.points.size();
  if (!fitted.usable || !fitted.weights.noise.known || fitted.data.noise.student) return {};
  if (fitted.dof < 3 || (stated && fitted.p_value >= rejected)) return {};
  const double square = std::inner_product(fitted.residuals.begin(), fitted.residuals.end(),
                                           fitted.residuals.begin(), 0.0);
  OddPoint odd;
  double most = 0.0;  // r^2 / (1 - h)
  for (std::size_t i = 0; i < n; ++i) {
    const double rest = 1.0 - fitted.leverage[i];
    if (fitted.data.points[i].censored || !(rest > fixed)) continue;
    const double gain = fitted.residuals[i] * fitted.residuals[i] / rest;
    if (!(gain > most)) continue;
    most = gain;
    odd.index = i;
  }
  const double left = fitted.dof - 1.0;
  const double scale = stated ? 1.0 : std::sqrt(std::max(0.0, square - most) / left);
  if (!(most > 0.0 && scale > 0.0)) return {};
  odd.residual = std::copysign(std::sqrt(most) / scale, fitted.residuals[odd.index]);
  const double tail = stated ? gsl_cdf_ugaussian_Q(std::abs(odd.residual))
                             : gsl_cdf_tdist_Q(std::abs(odd.residual), left);
  if (2.0 * tail * static_cast<double>(n) > (stated ? stated_level : estimated_level)) return {};
  std::vector<std::size_t> others(n);
  std::iota(others.begin(), others.end(), std::size_t{0});
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(odd.index));
  FitOptions options;
  options.several_starts = false;
  options.start = fitted.theta;
  options.noise = fitted.weights.noise;
  odd.without = fit(fitted.model, fitted.data.subset(others), options);
  if (!odd.without.usable || (stated && odd.without.p_value < rejected)) return {};
  return odd;
}

}  // namespace recoil
