#include "uncertainty/capture_interval.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/capture_velocity.hpp"
#include "uncertainty/replicate_errors.hpp"

namespace recoil {
namespace {

/// The interval of V* by the delta method on its logarithm, averaged over the ways to see the
/// noise.
Interval delta_interval(const std::vector<NoiseAlternative>& alternatives,
                        const CaptureVelocity& capture, std::size_t dataset, double diameter,
                        double level) {
  Interval interval;
  const FitResult& fitted = alternatives.front().fitted;
  interval.note = wide_spread_words("the capture velocity", fitted.data.noise.event_spread);
  const double error = logarithmic_error(capture, fitted.covariance);
  if (!capture.found || !(capture.value > 0.0) || !(error > 0.0)) {
    interval.why = !capture.found           ? "spheres of this size never rebound under the fit"
                   : !(capture.value > 0.0) ? "nothing is captured under the fit"
                                            : "the fit has no standard errors";
    return interval;
  }
  std::vector<WaldTerm> terms;
  for (const NoiseAlternative& alternative : alternatives) {
    const FitResult& other = alternative.fitted;
    const bool own = &other == &fitted;
    const CaptureVelocity v =
        own ? capture
            : capture_velocity(other.model, other.theta, dataset, diameter, capture.value);
    if (!v.found || !(v.value > 0.0)) continue;
    terms.push_back({alternative.weight, std::log(v.value / capture.value),
                     own ? error : logarithmic_error(v, other.covariance),
                     other.data.sd_stated ? 0 : other.dof});
  }
  const Interval logarithm = averaged_wald_interval(terms, level, -INFINITY, INFINITY);
  if (!logarithm.available()) {
    interval.why = logarithm.why;
    return interval;
  }
  interval.lower = capture.value * std::exp(*logarithm.lower);
  interval.upper = capture.value * std::exp(*logarithm.upper);
  const double factor = undecided_factor(terms);
  if (interval.note.empty() && factor > undecided) {
    interval.note = undecided_words("the capture velocity", factor);
  }
  return interval;
}

}  // namespace

std::vector<CaptureEstimate> capture_estimates(const std::vector<NoiseAlternative>& alternatives,
                                               double level, const std::vector<Dataset>& datasets) {
  const FitResult& fitted = alternatives.front().fitted;
  std::vector<CaptureEstimate> estimates;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const double diameter : distinct_diameters(datasets[d])) {
      const CaptureVelocity v = capture_velocity(fitted.model, fitted.theta, d, diameter);
      CaptureEstimate estimate;
      estimate.dataset = d;
      estimate.diameter = diameter;
      estimate.value = v.value;
      estimate.found = v.found;
      estimate.delta = delta_interval(alternatives, v, d, diameter, level);
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
    capture.interval.note = capture.delta.note;
    return;
  }
  capture.recommended = "delta";
  capture.recommended_why =
      replicates ? "there are no percentiles: " + capture.percentile.why
      : sd_stated
          ? "its error knows that the spread of the impacts is estimated, too"
          : "it knows how few points estimate the noise, and is averaged over the ways to see it";
  capture.interval = capture.delta;
  if (!capture.delta.available() && !capture.percentile.why.empty()) {
    capture.interval = capture.percentile;
    capture.interval.note = capture.delta.note;
  }
}

}  // namespace recoil
