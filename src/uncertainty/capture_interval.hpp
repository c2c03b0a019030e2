#pragma once

#include <vector>

#include "uncertainty/uncertainty.hpp"

namespace recoil {

/// The capture velocity of every (dataset, diameter) of a fit with its delta interval.
std::vector<CaptureEstimate> capture_estimates(const FitResult& fitted, const Observations& data,
                                               double level, const std::vector<Dataset>& datasets);

/// Names the interval of V* to quote. Where the noise is stated the percentiles: the replicates
/// settle what the delta method holds fixed (reports/coverage-grid-n20-stated.md). Where it is
/// estimated the delta interval, which knows how few points did that, unless a parameter rests on
/// its bound, of which the covariance says nothing.
void recommend_capture(const FitResult& fitted, bool sd_stated, CaptureEstimate& capture);

}  // namespace recoil
