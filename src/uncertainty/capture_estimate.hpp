#pragma once

#include <cstddef>
#include <optional>

#include "uncertainty/interval.hpp"

namespace recoil {

/// Kinds of interval of a capture velocity V*.
enum class CaptureIntervalKind {
  delta,  ///< V* exp(+- q sd(ln V*)), sd from the covariance and d V* / d theta; if the noise is
          ///< estimated, q is Student's quantile and the interval is averaged over the variance
          ///< functions
  percentile,   ///< bootstrap percentiles
  studentized,  ///< bootstrap-t of ln V*, with errors from its gradient in every replicate
};
constexpr auto names_of_values(CaptureIntervalKind) {
  return name_list("delta", "percentile", "studentized");
}

/// The rule of `recommend_capture` that selected the interval to quote.
enum class CaptureBecause {
  no_delta,          ///< percentile, as there is no delta interval
  at_bound,          ///< percentile: a parameter rests on its bound
  bend,              ///< percentile: it includes the nonlinearity of V* in the parameters
  no_percentiles,    ///< delta, as there is no percentile interval
  spread_estimated,  ///< delta: its error includes that the spread of the impacts is estimated
  laws_averaged,     ///< delta: it is averaged over the error of the laws
  noise_estimated,   ///< delta: it accounts for the few points that estimate the noise
};
constexpr auto names_of_values(CaptureBecause) {
  return name_list("no_delta", "at_bound", "bend", "no_percentiles", "spread_estimated",
                   "laws_averaged", "noise_estimated");
}

/// The capture velocity of one (dataset, diameter).
struct CaptureEstimate {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double value = 0.0;     ///< [m/s]
  bool found = false;
  std::optional<double> above;  ///< all impacts were captured, up to this velocity [m/s]
  std::optional<double> below;  ///< no impact was captured, from this velocity on [m/s]
  PerValue<CaptureIntervalKind, Interval> of_kind;
  Interval interval;                                             ///< the interval to quote
  CaptureIntervalKind recommended = CaptureIntervalKind::delta;  ///< kind of `interval`
  std::optional<CaptureBecause> because;                         ///< nullopt without a velocity

  Interval& operator[](CaptureIntervalKind kind) { return of_kind[kind]; }
  const Interval& operator[](CaptureIntervalKind kind) const { return of_kind[kind]; }
};

}  // namespace recoil
