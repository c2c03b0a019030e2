#include "uncertainty/identifiability.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "estimate/model_verdict.hpp"
#include "estimate/observation.hpp"

namespace recoil {
namespace {

/// Upper 95 % limit of a standard error over the standard error, if the noise is estimated with
/// `dof` degrees of freedom (chi-squared); 1 for known noise.
double largest_error_factor(int dof) {
  constexpr double level = 0.95;
  return dof > 0 ? std::sqrt(dof / gsl_cdf_chisq_Qinv(level, dof)) : 1.0;
}

/// @param error of the interval
/// @param most upper 95 % limit of the standard error
std::optional<Hindrance> hindrance_of(const FitResult& fitted, std::size_t j,
                                      const Interval& interval, double error, double most) {
  const ParameterSlot& slot = fitted.model.slots[j];
  if (!interval.available()) return Hindrance::no_interval;
  if (*interval.upper >= slot.upper) return Hindrance::reaches_upper_bound;
  if (*interval.lower <= slot.lower) {
    if (slot.lower != 0.0) return Hindrance::reaches_lower_bound;
    return fitted.at_bound[j] ? Hindrance::rests_on_bound : Hindrance::consistent_with_zero;
  }
  const double allowed = widest_error * std::abs(fitted.theta[j]);
  if (!(error <= allowed)) return Hindrance::large_error;
  if (!(most <= allowed)) return Hindrance::uncertain_error;
  return std::nullopt;
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
                                      const std::vector<CaptureEstimate>& capture, double level,
                                      const std::vector<FitAlternative>& alternatives) {
  Identifiability result;
  result.rejected = judge_model(fitted).verdict == ModelVerdict::does_not_fit;
  result.event_spread = fitted.weights.noise.event_spread;
  int free_count = 0;
  int good = 0;
  const double quantile = gsl_cdf_ugaussian_Qinv(0.5 * (1.0 - level));
  const double widened = largest_error_factor(fitted.quantile_dof);
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    ParameterIdentifiability& found = result.parameter.emplace_back();
    if (!slot.free) continue;
    ++free_count;
    const Interval& interval = recommended_interval(intervals[j]);
    const double error = interval.available() ? 0.5 * (*interval.upper - *interval.lower) / quantile
                                              : fitted.std_error[j];
    const double most = std::max(error, widened * fitted.std_error[j]);
    found.relative_error = error / std::abs(fitted.theta[j]);
    found.largest_relative_error = most / std::abs(fitted.theta[j]);
    if (!alternatives.empty()) {
      found.noise_factor = undecided_factor(terms_of_slot(under_same_laws(alternatives), j));
    }
    found.hindrance = hindrance_of(fitted, j, interval, error, most);
    if (!found.hindrance && result.rejected) {
      found.hindrance = Hindrance::model_rejected;
    } else if (!found.hindrance && result.event_spread > widest_spread) {
      found.hindrance = Hindrance::wide_spread;
    } else if (!found.hindrance && found.noise_factor > undecided) {
      found.hindrance = Hindrance::undecided_noise;
    }
    if (found.hindrance) continue;
    found.identifiable = true;
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
