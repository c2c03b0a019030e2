#include "uncertainty/capture_interval.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/capture_velocity.hpp"
#include "uncertainty/capture_rows.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {
namespace {

/// ln V* / V*_1 under every variance function of the noise, with V*_1 the value under the first.
std::vector<WaldTerm> capture_terms(const std::vector<FitAlternative>& alternatives,
                                    const CaptureVelocity& capture, std::size_t dataset,
                                    double diameter) {
  const FitResult& fitted = alternatives.front().fitted();
  std::vector<WaldTerm> terms;
  for (const FitAlternative& alternative : alternatives) {
    const FitResult& other = alternative.fitted();
    const bool own = &other == &fitted;
    const CaptureVelocity v =
        own ? capture
            : capture_velocity(other.model, other.theta, dataset, diameter, capture.value);
    if (!v.found || !(v.value > 0.0)) continue;
    terms.push_back({alternative.weight, std::log(v.value / capture.value),
                     logarithmic_error(v, other.covariance),
                     degrees_of_freedom(other, v.gradient)});
  }
  return terms;
}

/// The interval of V* by the delta method on its logarithm, averaged over the variance
/// functions of the noise.
Interval delta_interval(const std::vector<FitAlternative>& alternatives,
                        const CaptureVelocity& capture, std::size_t dataset, double diameter,
                        double level) {
  Interval interval;
  const FitResult& fitted = alternatives.front().fitted();
  const double spread = fitted.weights.noise.event_spread;
  if (spread > widest_spread) interval.note = {Caution::wide_spread, spread};
  if (averages_over_sizes(fitted.model, dataset)) {
    interval.note = {Caution::mixed_sizes, mixed_capture_coverage};
  }
  if (fitted.noise_verdict == NoiseVerdict::exceeded && !without_adhesion(fitted.model, dataset)) {
    interval.note = {Caution::model_rejected, fitted.p_value};
  }
  const double error = logarithmic_error(capture, fitted.covariance);
  if (!capture.found || !(capture.value > 0.0) || !(error > 0.0)) {
    interval.missing = !fitted.weights.noise.known ? NoInterval::noise_unknown
                       : !capture.found            ? NoInterval::never_rebounds
                       : !(capture.value > 0.0)    ? NoInterval::never_captured
                                                   : NoInterval::no_covariance;
    return interval;
  }
  const std::vector<WaldTerm> terms = capture_terms(alternatives, capture, dataset, diameter);
  const Interval logarithm = averaged_wald_interval(terms, level, -INFINITY, INFINITY);
  if (!logarithm.available()) {
    interval.missing = logarithm.missing;
    return interval;
  }
  interval.lower = capture.value * std::exp(*logarithm.lower);
  interval.upper = capture.value * std::exp(*logarithm.upper);
  const double factor =
      undecided_factor(capture_terms(under_same_laws(alternatives), capture, dataset, diameter));
  if (!interval.note && factor > undecided) interval.note = {Caution::undecided_noise, factor};
  CaptureEstimate at;
  at.dataset = dataset;
  at.diameter = diameter;
  at.value = capture.value;
  return cut_by_rows(interval, fitted, at, level);
}

/// The studentized interval of V* of the k-th size, on its logarithm.
Interval studentized_capture(const BootstrapResult& boot, std::size_t k, double value,
                             double level) {
  std::vector<double> logarithms;
  std::vector<double> errors;
  for (std::size_t i = 0; i < boot.capture_velocity.size(); ++i) {
    const double v = boot.capture_velocity[i][k];
    if (!(v > 0.0)) continue;
    logarithms.push_back(std::log(v / value));
    errors.push_back(boot.capture_error[i][k]);
  }
  Interval interval = studentized_interval(logarithms, errors, 0.0, boot.capture_reference_error[k],
                                           level, -INFINITY, INFINITY);
  for (auto* end : {&interval.lower, &interval.upper}) {
    if (*end) *end = value * std::exp(**end);
  }
  for (auto* error : {&interval.lower_error, &interval.upper_error}) {
    if (*error) *error = value * **error;
  }
  return interval;
}

}  // namespace

std::vector<CaptureEstimate> capture_estimates(const std::vector<FitAlternative>& alternatives,
                                               double level, const std::vector<Dataset>& datasets) {
  const FitResult& fitted = alternatives.front().fitted();
  std::vector<CaptureEstimate> estimates;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const double diameter : distinct_diameters(datasets[d])) {
      const CaptureVelocity v = capture_velocity(fitted.model, fitted.theta, d, diameter);
      CaptureEstimate estimate;
      estimate.dataset = d;
      estimate.diameter = diameter;
      estimate.value = v.value;
      estimate.found = v.found;
      estimate[CaptureIntervalKind::delta] = delta_interval(alternatives, v, d, diameter, level);
      if (!v.found) estimate.interval.missing = NoInterval::never_rebounds;
      estimates.push_back(estimate);
    }
  }
  return estimates;
}

Interval capture_interval(const std::vector<FitAlternative>& alternatives,
                          const CaptureEstimate& at, double level) {
  const FitResult& fitted = alternatives.front().fitted();
  return delta_interval(alternatives,
                        capture_velocity(fitted.model, fitted.theta, at.dataset, at.diameter),
                        at.dataset, at.diameter, level);
}

void recommend_capture(const FitResult& fitted, bool sd_stated, CaptureEstimate& capture) {
  const bool at_bound =
      std::find(fitted.at_bound.begin(), fitted.at_bound.end(), true) != fitted.at_bound.end();
  const bool spread = fitted.weights.noise.event_spread > 0.0;
  const Interval& delta = capture[CaptureIntervalKind::delta];
  const Interval& percentile = capture[CaptureIntervalKind::percentile];
  // Replicates are drawn under one error of the laws, and only the delta interval averages over it.
  const bool averaged = fitted.laws.size() > 1;
  const bool replicates = !averaged && ((sd_stated && !spread && fitted.quantile_dof == 0) ||
                                        at_bound || !delta.available());
  const auto quote = [&](const Interval& interval) {
    capture.interval = interval;
    capture.interval.note = delta.note;
  };
  if (percentile.available() && (replicates || !delta.available())) {
    capture.recommended = CaptureIntervalKind::percentile;
    capture.because = !delta.available() ? CaptureBecause::no_delta
                      : at_bound         ? CaptureBecause::at_bound
                                         : CaptureBecause::bend;
    quote(percentile);
    return;
  }
  capture.recommended = CaptureIntervalKind::delta;
  capture.because = replicates  ? CaptureBecause::no_percentiles
                    : averaged  ? CaptureBecause::laws_averaged
                    : sd_stated ? CaptureBecause::spread_estimated
                                : CaptureBecause::noise_estimated;
  // If there is neither, state the reason for the missing percentile interval.
  quote(!delta.available() && percentile.missing ? percentile : delta);
}

void add_resampled_captures(const FitResult& fitted, const BootstrapResult& replicates,
                            double level, std::vector<CaptureEstimate>& captures) {
  const auto& slots = fitted.model.slots;
  const bool nothing_free =
      std::none_of(slots.begin(), slots.end(), [](const ParameterSlot& slot) { return slot.free; });
  for (std::size_t k = 0; k < captures.size(); ++k) {
    CaptureEstimate& capture = captures[k];
    if (!capture.found) continue;
    Interval& percentile = capture[CaptureIntervalKind::percentile];
    Interval& studentized = capture[CaptureIntervalKind::studentized];
    if (nothing_free) {
      percentile = no_interval(NoInterval::nothing_free);
    } else if (!fitted.weights.noise.known) {
      percentile = no_interval(NoInterval::noise_unknown);
    } else if (replicates.withheld()) {
      percentile = no_interval(NoInterval::refits_failed);
    } else {
      const auto cut = [&](const Interval& interval) {
        return cut_by_rows(with_both_arms(interval, capture.value, 0.0, INFINITY), fitted, capture,
                           level);
      };
      percentile = cut(percentile_interval(finite_column(replicates.capture_velocity, k), level));
      studentized = cut(studentized_capture(replicates, k, capture.value, level));
    }
    if (!studentized.available() && !studentized.missing) {
      studentized.missing = percentile.missing;
    }
    recommend_capture(fitted, fitted.data.noise.sd_stated, capture);
  }
}

void limit_by_captures(const Observations& data, std::vector<CaptureEstimate>& captures) {
  for (CaptureEstimate& capture : captures) {
    std::optional<double> fastest;  // captured
    std::optional<double> slowest;  // rebounded
    for (const Observation& point : data.points) {
      if (point.dataset != capture.dataset || point.diameter != capture.diameter) continue;
      if (point.captured > 0) {
        fastest = std::max(fastest.value_or(0.0), point.velocity);
      } else {
        slowest = std::min(slowest.value_or(INFINITY), point.velocity);
      }
    }
    CaptureEstimate limit;
    limit.dataset = capture.dataset;
    limit.diameter = capture.diameter;
    limit.above = fastest;
    limit.below = slowest;
    limit.interval = no_interval(NoInterval::all_captured);
    for (const CaptureIntervalKind kind : values_of<CaptureIntervalKind>()) {
      limit[kind] = limit.interval;
    }
    capture = limit;
  }
}

}  // namespace recoil
