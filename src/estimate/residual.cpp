#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_erf.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/gsl_errors.hpp"
#include "estimate/fit.hpp"

namespace recoil {
namespace {

/// Where no standard deviation is stated, every point gets this one; only ratios matter, and the
/// noise is estimated from the residuals afterwards.
constexpr double nominal_sd = 0.02;

WeightedResidual tobit_residual(const Observation& point, double m) {
  // P(captured) = Phi(-z). The scale is the floor of var(e^2), sqrt(2) sigma^2.
  gsl_errors_are_values();
  const double scale = std::numbers::sqrt2 * point.sd * point.sd;
  const double z = m / scale;
  // ln Phi(-z), without cancellation on either side.
  const double log_q = z < 0.0 ? std::log1p(-gsl_cdf_ugaussian_P(z))
                               : gsl_sf_log_erfc(z / std::numbers::sqrt2) - std::numbers::ln2;
  const double deviance = -2.0 * log_q;
  if (deviance < 1e-280) return {0.0, 0.0};
  const double value = std::sqrt(deviance);
  const double hazard = gsl_sf_hazard(z);  // phi(z) / Phi(-z)
  return {value, hazard / (value * scale)};
}

}  // namespace

WeightedResidual weighted_residual(const Observation& point, double m) {
  if (point.censored) return tobit_residual(point, m);
  const double variance = point.sd * point.sd;
  const double y = point.restitution * point.restitution - variance;
  const double hypotenuse = std::hypot(m, variance);
  // For m far below zero (m + hypotenuse) cancels; the conjugate form does not.
  const double psi_squared =
      m >= 0.0 ? 0.5 * (m + hypotenuse) : 0.5 * variance * variance / (hypotenuse - m);
  const double psi = std::sqrt(psi_squared);
  const double psi_slope = psi / (2.0 * hypotenuse);  // d psi / d m
  const double sum = point.restitution + psi;
  const double width_squared = variance * (sum * sum + 2.0 * variance);
  const double width = std::sqrt(width_squared);
  const double width_slope = variance * sum * psi_slope / width;
  return {(y - m) / width, (-1.0 - (y - m) / width * width_slope) / width};
}

Observations gather(const std::vector<Dataset>& datasets) {
  Observations data;
  int partly_captured = 0;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const ImpactPoint& p : datasets[d].points) {
      const bool censored = p.all_captured();
      if (p.captured > 0 && !censored) ++partly_captured;
      if (!p.restitution_sd && !censored) data.sd_stated = false;
      data.points.push_back({d, p.series, p.diameter, p.incident_velocity, p.restitution,
                             p.restitution_sd.value_or(nominal_sd), censored});
    }
  }
  if (!data.sd_stated) {
    for (Observation& point : data.points) point.sd = nominal_sd;
    data.warnings.push_back(
        "not every point states a standard deviation (restitution_sd): all points weigh the same, "
        "the noise is estimated from the residuals, and the fit cannot be tested against it");
  }
  if (partly_captured > 0) {
    data.warnings.push_back(
        std::to_string(partly_captured) +
        " points average the survivors of impacts of which some were captured: the mean of the "
        "survivors is fitted as it stands, which is biased upwards close to the capture velocity");
  }
  return data;
}

}  // namespace recoil
