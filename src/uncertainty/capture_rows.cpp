#include "uncertainty/capture_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics.hpp"
#include "estimate/fit.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "uncertainty/intervals.hpp"

namespace recoil {
namespace {

/// The weights of point i with all errors of its inputs in `input_sd`.
PointWeights with_all_errors(const FitResult& fitted, std::size_t i) {
  PointWeights weights = fitted.weights.points[i];
  double variance = 0.0;
  for (std::size_t k = 0; k < fitted.data.sources.size(); ++k) {
    if (fitted.data.sources[k]->is_scatter()) continue;
    variance += std::pow(fitted.weights.effects[k][i], 2);
  }
  weights.input_sd = std::sqrt(variance);
  return weights;
}

/// -2 ln of the likelihood ratio of a row.
class RowDeviance {
 public:
  RowDeviance(const FitResult& fitted, std::size_t i, double estimate)
      : fitted_(fitted),
        point_(fitted.data.points[i]),
        weights_(with_all_errors(fitted, i)),
        estimate_(estimate) {
    if (point_.mixed()) point_.censored = true;  // their mean e depends on the shape of the curve
    locate_peak(point_, weights_);
  }

  /// If V* is `capture` [m/s].
  double operator()(double capture) const {
    const double velocity = point_.velocity * estimate_ / capture;
    if (!point_.censored && velocity >= estimate_) return 0.0;  // some rebound is possible
    const Prediction there =
        predict(fitted_.model, fitted_.theta, point_.dataset, point_.diameter, velocity, false);
    if (!there.usable()) return 0.0;
    const double r =
        weighted_residual(point_, weights_, there.restitution_squared, fitted_.data.noise.student)
            .value;
    return std::pow(r / fitted_.noise_scale, 2);
  }

 private:
  const FitResult& fitted_;
  Observation point_;
  PointWeights weights_;
  double estimate_;
};

}  // namespace

Interval cut_by_rows(Interval interval, const FitResult& fitted, const CaptureEstimate& capture,
                     double level) {
  if (!interval.available() || !(capture.value > 0.0)) return interval;
  const double most = std::pow(student_quantile(0.5 + level / 2.0, fitted.quantile_dof), 2);
  for (std::size_t i = 0; i < fitted.data.points.size(); ++i) {
    const Observation& point = fitted.data.points[i];
    if (point.dataset != capture.dataset || point.diameter != capture.diameter) continue;
    const bool rebounds = point.captured < point.events && point.velocity < *interval.upper;
    const bool captures = point.captured > 0 && point.velocity > *interval.lower;
    if (!rebounds && !captures) continue;
    const RowDeviance deviance(fitted, i, capture.value);
    const double middle = std::log(capture.value);
    const double at_estimate = deviance(capture.value);
    if (at_estimate > most) continue;
    const auto excess = [&](double ln) { return deviance(std::exp(ln)) - at_estimate - most; };
    const auto cut = [&](double& end) {
      const double ln = std::log(end);
      if (!(excess(ln) > 0.0)) return;
      const double root = find_root(excess, std::min(ln, middle), std::max(ln, middle), 1e-9);
      if (!std::isnan(root)) end = std::exp(root);
    };
    if (rebounds) cut(*interval.upper);
    if (captures) cut(*interval.lower);
  }
  return interval;
}

}  // namespace recoil
