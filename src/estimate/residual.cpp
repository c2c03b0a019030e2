#include "estimate/residual.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_erf.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numerics.hpp"
#include "estimate/survivors.hpp"

namespace recoil {
namespace {

/// ln Phi(-z), without cancellation on either side.
double log_captured(double z) {
  gsl_errors_are_values();
  return z < 0.0 ? std::log1p(-gsl_cdf_ugaussian_P(z))
                 : gsl_sf_log_erfc(z / std::numbers::sqrt2) - std::numbers::ln2;
}

/// How the captures among the impacts of a point are spread: independent from impact to impact, and
/// by the errors of V and d, which all impacts of the point share. Where the scatter of the impacts
/// is not known, all of them share what the mean has: they count as one.
struct CaptureSpread {
  double scale;   ///< sd of e^2, both together
  double weight;  ///< share of the impacts that count as independent
};
CaptureSpread capture_spread(const Observation& point) {
  const double n = point.events;
  const double shared = point.weights.input_sd * point.weights.input_sd;
  if (!(point.weights.scatter > 0.0))
    return {std::sqrt(2.0 * std::pow(point.weights.sd, 4) + shared), 1.0 / n};
  const double own = point.weights.scatter;
  const double square = own * own + shared;
  return {std::sqrt(square), (1.0 + (n - 1.0) * own * own / square) / n};
}

/// All impacts were captured, or none.
WeightedResidual tobit_residual(const Observation& point, double m) {
  gsl_errors_are_values();
  CaptureSpread spread = capture_spread(point);
  if (point.captured == 0) spread.scale = -spread.scale;
  const double n = spread.weight * point.events;
  const double z = (m + point.weights.shift) / spread.scale;
  const double deviance = -2.0 * n * log_captured(z);
  if (deviance < 1e-280) return {0.0, 0.0};
  const double value = std::sqrt(deviance);
  const double hazard = gsl_sf_hazard(z);  // phi(z) / Phi(-z)
  return {value, n * hazard / (value * spread.scale)};
}

struct Deviance {
  double value;
  double slope;
};

/// D of a point whose impacts differ, and dD/dm.
Deviance event_deviance_and_slope(const Observation& point, double m) {
  gsl_errors_are_values();
  const double x = m + point.weights.shift;
  Deviance d{0.0, 0.0};
  if (!point.censored) {
    const RootMoments root = root_of_positive_normal(x / point.weights.scatter);
    const double unit = std::sqrt(point.weights.scatter);
    const double r = (point.restitution - unit * root.mean) / point.weights.mean_sd;
    d = {r * r, -2.0 * r * root.slope / (unit * point.weights.mean_sd)};
  }
  if (!point.counted) return d;
  const CaptureSpread spread = capture_spread(point);
  const double z = x / spread.scale;
  d.value += -2.0 * spread.weight *
             (point.captured * log_captured(z) + point.rebounds() * log_captured(-z));
  d.slope += 2.0 * spread.weight / spread.scale *
             (point.captured * gsl_sf_hazard(z) - point.rebounds() * gsl_sf_hazard(-z));
  return d;
}

WeightedResidual event_residual(const Observation& point, double m) {
  const DeviancePeak& peak = point.weights.peak;
  const double away = m - peak.at;
  const double unit = std::sqrt(0.5 * peak.curvature);
  constexpr double close = 1e-3;
  if (std::abs(away) * unit < close) {
    // D - D(at) cancels here: two terms of the series, with an error of about close^4.
    const double skew = peak.third / (3.0 * peak.curvature);
    return {-unit * away * (1.0 + 0.5 * skew * away), -unit * (1.0 + skew * away)};
  }
  const Deviance d = event_deviance_and_slope(point, m);
  const double value = std::copysign(std::sqrt(std::max(0.0, d.value - peak.deviance)), -away);
  return {value, d.slope / (2.0 * value)};
}

WeightedResidual mean_residual(const Observation& point, double m) {
  const double variance = point.weights.sd * point.weights.sd;
  const double y = point.restitution * point.restitution - variance;
  const double hypotenuse = std::hypot(m, variance);
  // For m far below zero (m + hypotenuse) cancels; the conjugate form does not.
  const double psi_squared =
      m >= 0.0 ? 0.5 * (m + hypotenuse) : 0.5 * variance * variance / (hypotenuse - m);
  const double psi = std::sqrt(psi_squared);
  const double psi_slope = psi / (2.0 * hypotenuse);  // d psi / d m
  const double sum = point.restitution + psi;
  const double width = std::sqrt(variance * (sum * sum + 2.0 * variance) +
                                 point.weights.input_sd * point.weights.input_sd);
  const double width_slope = variance * sum * psi_slope / width;
  return {(y - m) / width, (-1.0 - (y - m) / width * width_slope) / width};
}

WeightedResidual normal_residual(const Observation& point, double m) {
  if (point.peaks()) return event_residual(point, m);
  return point.censored ? tobit_residual(point, m) : mean_residual(point, m);
}

}  // namespace

WeightedResidual weighted_residual(const Observation& point, double m,
                                   const std::optional<StudentNoise>& student) {
  const WeightedResidual r = normal_residual(point, m);
  return student ? student->transformed(r) : r;
}

double event_deviance(const Observation& point, double m) {
  return event_deviance_and_slope(point, m).value;
}

void locate_peak(Observation& point) {
  // D falls where everything would be captured and rises far above the measured mean.
  const double reach =
      10.0 * (point.weights.scatter + point.weights.input_sd + point.weights.mean_sd);
  double low = -point.weights.shift - reach;
  double high = point.restitution * point.restitution - point.weights.shift + reach;
  const auto slope = [&](double m) { return event_deviance_and_slope(point, m).slope; };
  // Regula falsi with the Illinois rule, and halving where that is slow; by hand, since it runs for
  // every point in every round of every replicate.
  double slope_low = slope(low);
  double slope_high = slope(high);
  constexpr int most_steps = 200;
  const double close_enough = 1e-13 * reach;
  double middle = 0.5 * (low + high);
  for (int i = 0; i < most_steps && high - low > close_enough; ++i) {
    const double guess = high - slope_high * (high - low) / (slope_high - slope_low);
    const bool halve = i % 8 == 7 || !(guess > low && guess < high);
    middle = halve ? 0.5 * (low + high) : guess;
    const double at = slope(middle);
    if (at == 0.0) break;
    if (at < 0.0) {
      if (middle - low < close_enough) break;
      low = middle;
      slope_low = at;
      slope_high *= 0.5;
    } else {
      if (high - middle < close_enough) break;
      high = middle;
      slope_high = at;
      slope_low *= 0.5;
    }
  }
  DeviancePeak& peak = point.weights.peak;
  peak.at = middle;
  peak.deviance = event_deviance(point, peak.at);
  const double h = 1e-3 * std::min(point.weights.scatter,
                                   std::max(point.weights.mean_sd, 1e-3 * point.weights.scatter));
  const double more = slope(peak.at + h);
  const double less = slope(peak.at - h);
  peak.curvature = (more - less) / (2.0 * h);
  peak.third = (more - 2.0 * slope(peak.at) + less) / (h * h);
}

double survivors_sd(const Observation& point, double m) {
  if (point.censored) return point.weights.sd;
  const double variance =
      root_of_positive_normal((m + point.weights.shift) / point.weights.scatter).variance;
  const double of_scatter = std::sqrt(point.weights.scatter * variance / point.rebounds());
  return point.rebounds() == 1 ? std::hypot(point.weights.sd, of_scatter)
                               : std::max(point.weights.sd, of_scatter);
}

double expected_restitution(const Observation& point, double m) {
  if (point.censored || !(point.weights.scatter > 0.0)) return std::sqrt(std::max(m, 0.0));
  return std::sqrt(point.weights.scatter) *
         root_of_positive_normal((m + point.weights.shift) / point.weights.scatter).mean;
}

}  // namespace recoil
