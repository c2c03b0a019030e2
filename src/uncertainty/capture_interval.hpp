#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/parameter_intervals.hpp"

namespace recoil {

/// Ways to an interval of a capture velocity V*.
enum class CaptureIntervalKind {
  delta,        ///< V* exp(+- q sd(ln V*)), sd by the covariance and d V* / d theta; q of Student,
                ///< averaged over the variance functions, where the noise is estimated
  percentile,   ///< of the bootstrap
  studentized,  ///< of ln V*, errors by its gradient in every replicate
};
template <>
struct NamesOf<CaptureIntervalKind> {
  static constexpr std::array<std::string_view, 3> names = {"delta", "percentile", "studentized"};
};

/// By which rule of `recommend_capture` an interval is the one to quote.
enum class CaptureBecause {
  no_delta,          ///< percentiles, for want of the other
  at_bound,          ///< percentiles: a parameter rests on its bound
  bend,              ///< percentiles: they follow the bend of V* in the parameters
  no_percentiles,    ///< delta, for want of the other
  spread_estimated,  ///< delta: its error knows that the spread of the impacts is estimated
  noise_estimated,   ///< delta: it knows how few points estimate the noise
};
template <>
struct NamesOf<CaptureBecause> {
  static constexpr std::array<std::string_view, 6> names = {
      "no_delta", "at_bound", "bend", "no_percentiles", "spread_estimated", "noise_estimated"};
};

/// The capture velocity of one (dataset, diameter).
struct CaptureEstimate {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double value = 0.0;     ///< [m/s]
  bool found = false;
  std::optional<double> above;  ///< all impacts were captured, up to this velocity [m/s]
  std::optional<double> below;  ///< no impact was captured, from this velocity on [m/s]
  PerValue<CaptureIntervalKind, Interval> of_kind;
  Interval interval;                                             ///< the one to quote
  CaptureIntervalKind recommended = CaptureIntervalKind::delta;  ///< its kind
  std::optional<CaptureBecause> because;                         ///< none without a velocity

  Interval& operator[](CaptureIntervalKind kind) { return of_kind[kind]; }
  const Interval& operator[](CaptureIntervalKind kind) const { return of_kind[kind]; }
};

/// The capture velocity of every (dataset, diameter) of a fit with its delta interval.
/// @param alternatives of `noise_alternatives`; the first is the fit
std::vector<CaptureEstimate> capture_estimates(const std::vector<NoiseAlternative>& alternatives,
                                               double level, const std::vector<Dataset>& datasets);

/// The level at which the delta interval of a fit at `at` just contains the capture velocity that
/// `truth` has there; NaN where either has none.
double capture_level(const std::vector<NoiseAlternative>& alternatives, const CaptureEstimate& at,
                     const FitResult& truth);

/// The delta interval of V* at another level.
Interval capture_interval(const std::vector<NoiseAlternative>& alternatives,
                          const CaptureEstimate& at, double level);

/// Names the interval of V* to quote (reports/coverage-grid-n{10,20,60}-{stated,estimated}.md).
/// Where the noise is stated and no spread of the impacts is estimated, the percentiles: they
/// follow the bend of V* in the parameters. Where the spread is estimated, the delta interval,
/// whose error knows of it, while the replicates mix data sets with and without points that show
/// it. Where the noise is estimated the delta interval, too, which knows how few points did that
/// and is averaged over the variance functions. Where a parameter rests on its bound, of which the
/// covariance says nothing, the percentiles.
void recommend_capture(const FitResult& fitted, bool sd_stated, CaptureEstimate& capture);

/// Adds percentile and studentized intervals of the capture velocities, and names the one to quote.
/// @param captures of `capture_estimates`, for which `replicates` have velocities
void add_resampled_captures(const FitResult& fitted, const BootstrapResult& replicates,
                            double level, std::vector<CaptureEstimate>& captures);

/// Where every point says only that all or none of its spheres were captured, the points give no
/// V*, but limits: the fastest captures from below, the slowest rebounds from above.
void limit_by_captures(const Observations& data, std::vector<CaptureEstimate>& captures);

}  // namespace recoil
