#pragma once

#include <cstddef>
#include <optional>

#include "uncertainty/interval.hpp"

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

}  // namespace recoil
