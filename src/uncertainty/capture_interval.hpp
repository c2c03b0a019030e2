#pragma once

#include <vector>

#include "uncertainty/uncertainty.hpp"

namespace recoil {

/// The capture velocity of every (dataset, diameter) of a fit with its delta interval.
std::vector<CaptureEstimate> capture_estimates(const FitResult& fitted, const Observations& data,
                                               double level, const std::vector<Dataset>& datasets);

/// Names the interval of V* to quote: the delta interval, which knows how few points estimated the
/// noise; where a parameter rests on its bound the covariance says nothing about it, and the
/// replicates are better.
void recommend_capture(const FitResult& fitted, CaptureEstimate& capture);

}  // namespace recoil
