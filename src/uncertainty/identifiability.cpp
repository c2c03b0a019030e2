#include "uncertainty/identifiability.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "estimate/observation.hpp"
#include "estimate/predictor.hpp"
namespace recoil {
namespace {

constexpr double least_loss = 0.01;  // lower limit of the loss 1 - e^2 in a scale

/// For every slot, the change that would alone account for the loss 1 - e^2 at the most sensitive
/// point: 1 / max_i |d ln(1 - e_i^2) / d theta_j| [slots]; 0 without effect.
std::vector<double> loss_scales(const FitResult& fitted) {
  std::vector<PointConditions> places;
  for (const Observation& point : fitted.data.points) {
    if (!point.censored) places.push_back(point.conditions());
  }
  std::vector<double> largest(fitted.theta.size(), 0.0);
  for (const Prediction& at : predict(fitted.model, fitted.theta, std::move(places), true)) {
    if (!at.usable()) continue;
    const double loss = std::max(1.0 - at.restitution_squared, least_loss);
    for (std::size_t j = 0; j < largest.size(); ++j) {
      largest[j] = std::max(largest[j], std::abs(at.gradient[j]) / loss);
    }
  }
  for (double& entry : largest) entry = entry > 0.0 ? 1.0 / entry : 0.0;
  return largest;
}

/// Upper 95 % limit of a standard error over the standard error, if the noise is estimated with
/// `dof` degrees of freedom (chi-squared); 1 for known noise.
double largest_error_factor(int dof) {
  constexpr double level = 0.95;
  return dof > 0 ? std::sqrt(dof / gsl_cdf_chisq_Qinv(level, dof)) : 1.0;
}

/// The standard error of slot j; if it rests on a bound, the one that corresponds to its interval.
double error_of(const FitResult& fitted, std::size_t j, const Interval& interval) {
  // Width in standard errors of a 95 % interval that begins at the bound.
  constexpr double one_sided = 1.96;
  if (fitted.std_error[j] > 0.0 || !interval.available()) return fitted.std_error[j];
  return (*interval.upper - *interval.lower) / one_sided;
}

/// @param error standard error of the parameter
/// @param most its upper 95 % limit
/// @param scale the scale with which both are compared
std::optional<Hindrance> hindrance_of(const FitResult& fitted, std::size_t j,
                                      const Interval& interval, double error, double most,
                                      double scale) {
  const ParameterSlot& slot = fitted.model.slots[j];
  if (!interval.available()) return Hindrance::no_interval;
  const bool low = *interval.lower <= slot.lower;
  if (*interval.upper >= slot.upper) return Hindrance::reaches_upper_bound;
  if (low && slot.lower != 0.0) return Hindrance::reaches_lower_bound;
  const double allowed = widest_error * scale;
  if (!(most > allowed)) return std::nullopt;
  if (!(error > allowed)) return Hindrance::uncertain_error;
  if (fitted.at_bound[j]) return Hindrance::rests_on_bound;
  return low ? Hindrance::consistent_with_zero : Hindrance::large_error;
}

std::vector<CorrelatedParameters> correlated_parameters(const FitResult& fitted) {
  const std::size_t p = fitted.theta.size();
  std::vector<CorrelatedParameters> found;
  if (fitted.covariance.empty()) return found;
  for (std::size_t a = 0; a < p; ++a) {
    for (std::size_t b = a + 1; b < p; ++b) {
      const double scale = fitted.std_error[a] * fitted.std_error[b];
      if (!(scale > 0.0)) continue;
      const double r = fitted.covariance[a * p + b] / scale;
      if (!(std::abs(r) < strong_correlation)) found.push_back({a, b, r});
    }
  }
  return found;
}

/// The smallest ratio of impact velocity to capture velocity, if it is too large to determine the
/// adhesion; else nullopt.
std::optional<double> too_far_above_capture(const FitResult& fitted,
                                            const std::vector<CaptureEstimate>& capture) {
  double nearest = INFINITY;
  for (const CaptureEstimate& at : capture) {
    if (!at.found || !(at.value > 0.0)) continue;
    if (without_adhesion(fitted.model, at.dataset)) continue;
    for (const Observation& point : fitted.data.points) {
      if (point.dataset == at.dataset && point.diameter == at.diameter) {
        nearest = std::min(nearest, point.velocity / at.value);
      }
    }
  }
  // Below this ratio the rise of e distinguishes adhesion from the plateau.
  constexpr double close_enough = 1.5;
  if (!std::isfinite(nearest) || nearest <= close_enough) return std::nullopt;
  return nearest;
}

std::vector<CapturePlace> places_of(const ImpactModel& model,
                                    const std::vector<CaptureEstimate>& capture) {
  std::vector<CapturePlace> places;
  for (const CaptureEstimate& at : capture) {
    const bool held = at.found && !without_adhesion(model, at.dataset);
    places.push_back({at.dataset, at.diameter, held ? at.value : 0.0});
  }
  return places;
}

}  // namespace

Identifiability judge_identifiability(const FitResult& fitted,
                                      const std::vector<IntervalSet>& intervals,
                                      const std::vector<CaptureEstimate>& capture,
                                      const std::vector<FitAlternative>& alternatives) {
  Identifiability result;
  result.event_spread = fitted.weights.noise.event_spread;
  int free_count = 0;
  int good = 0;
  const std::vector<double> scales = loss_scales(fitted);
  const double widened = largest_error_factor(fitted.quantile_dof);
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    ParameterIdentifiability& found = result.parameter.emplace_back();
    if (!slot.free) continue;
    ++free_count;
    const Interval& interval = recommended_interval(intervals[j]);
    const double error = error_of(fitted, j, interval);
    found.relative_error = error / std::abs(fitted.theta[j]);
    found.largest_relative_error = widened * found.relative_error;
    found.loss_scale = scales[j];
    if (!alternatives.empty()) {
      found.noise_factor = undecided_factor(terms_of_slot(under_same_laws(alternatives), j));
    }
    found.hindrance = hindrance_of(fitted, j, interval, error, widened * error,
                                   std::max(std::abs(fitted.theta[j]), scales[j]));
    if (!found.hindrance && result.event_spread > widest_spread) {
      found.hindrance = Hindrance::wide_spread;
    } else if (!found.hindrance && found.noise_factor > undecided) {
      found.hindrance = Hindrance::undecided_noise;
    }
    if (found.hindrance) continue;
    found.identifiable = true;
    found.upper_limit = *interval.lower <= slot.lower;
    ++good;
  }
  result.verdict = good == free_count ? IdentifiabilityVerdict::identifiable
                   : good > 0         ? IdentifiabilityVerdict::partly
                                      : IdentifiabilityVerdict::not_identifiable;
  result.information = information_at(fitted, places_of(fitted.model, capture));
  result.correlated = correlated_parameters(fitted);
  result.slowest = too_far_above_capture(fitted, capture);
  result.more_points = result.slowest || good < free_count;
  return result;
}

}  // namespace recoil
