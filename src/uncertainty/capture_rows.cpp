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

/// The part of 1 - level in which the rows of a size may exclude the true V*, all together.
constexpr double share_of_misses = 0.1;

bool is_of(const Observation& point, const CaptureEstimate& capture) {
  return point.dataset == capture.dataset && point.diameter == capture.diameter;
}

}  // namespace

Interval cut_by_rows(Interval interval, const FitResult& fitted, const CaptureEstimate& capture,
                     double level) {
  if (!interval.available() || !(capture.value > 0.0)) return interval;
  const auto& points = fitted.data.points;
  const auto rows = static_cast<double>(std::count_if(
      points.begin(), points.end(), [&](const auto& point) { return is_of(point, capture); }));
  const double tail = share_of_misses * (1.0 - level) / rows;  // of one row (Bonferroni)
  const double most = std::pow(student_quantile(1.0 - tail / 2.0, fitted.quantile_dof), 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Observation& point = points[i];
    if (!is_of(point, capture)) continue;
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
