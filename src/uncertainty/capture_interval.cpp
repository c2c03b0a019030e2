#include "uncertainty/capture_interval.hpp"

#include <algorithm>
#include <cmath>

#include "uncertainty/replicate_errors.hpp"

namespace recoil {
namespace {

/// The covariance that the delta method works on: the fit's, where the noise is stated; else one
/// that needs no noise model (HC3).
std::vector<double> trusted_covariance(const FitResult& fitted, const Observations& data) {
  if (data.sd_stated || fitted.covariance.empty()) return fitted.covariance;
  ResamplingPlan plan;
  plan.fitted = &fitted;
  plan.data = &data;
  plan.scheme = Scheme::wild;
  return reference_covariance(fitted, plan);
}

/// The interval of V* by the delta method on its logarithm.
/// @param dof of an estimated noise; 0: the noise is known
Interval delta_interval(const std::vector<double>& covariance, const CaptureVelocity& capture,
                        int dof, double level) {
  Interval interval;
  const double error = logarithmic_error(capture, covariance);
  if (!capture.found || !(capture.value > 0.0) || !(error > 0.0)) {
    interval.why = !capture.found           ? "spheres of this size never rebound under the fit"
                   : !(capture.value > 0.0) ? "nothing is captured under the fit"
                                            : "the fit has no standard errors";
    return interval;
  }
  const Interval logarithm = wald_interval(0.0, error, level, dof, -INFINITY, INFINITY);
  if (!logarithm.available()) return logarithm;
  interval.lower = capture.value * std::exp(*logarithm.lower);
  interval.upper = capture.value * std::exp(*logarithm.upper);
  return interval;
}

}  // namespace

std::vector<CaptureEstimate> capture_estimates(const FitResult& fitted, const Observations& data,
                                               double level, const std::vector<Dataset>& datasets) {
  const std::vector<double> covariance = trusted_covariance(fitted, data);
  std::vector<CaptureEstimate> estimates;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const double diameter : distinct_diameters(datasets[d])) {
      const CaptureVelocity v = capture_velocity(fitted.model, fitted.theta, d, diameter);
      CaptureEstimate estimate;
      estimate.dataset = d;
      estimate.diameter = diameter;
      estimate.value = v.value;
      estimate.found = v.found;
      estimate.delta = delta_interval(covariance, v, data.sd_stated ? 0 : fitted.dof, level);
      if (!v.found) estimate.interval.why = "spheres of this size never rebound under the fit";
      estimates.push_back(std::move(estimate));
    }
  }
  return estimates;
}

void recommend_capture(const FitResult& fitted, bool sd_stated, CaptureEstimate& capture) {
  const bool at_bound =
      std::find(fitted.at_bound.begin(), fitted.at_bound.end(), true) != fitted.at_bound.end();
  const bool spread = fitted.data.noise.event_spread > 0.0;
  const bool replicates = (sd_stated && !spread) || at_bound || !capture.delta.available();
  if (capture.percentile.available() && replicates) {
    capture.recommended = "percentile";
    capture.recommended_why =
        !capture.delta.available() ? capture.delta.why
        : at_bound ? "a parameter rests on its bound, which the delta method does not know"
                   : "the noise is stated, and the replicates follow the bend of V* in the "
                     "parameters, which the delta method takes as straight";
    capture.interval = capture.percentile;
    return;
  }
  capture.recommended = "delta";
  capture.recommended_why =
      replicates  ? "there are no percentiles: " + capture.percentile.why
      : sd_stated ? "its error knows that the spread of the impacts is estimated, too"
                  : "it knows how few points estimate the noise, which percentiles do not";
  capture.interval = capture.delta;
  if (!capture.delta.available() && !capture.percentile.why.empty()) {
    capture.interval = capture.percentile;
  }
}

}  // namespace recoil
