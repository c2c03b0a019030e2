#pragma once

#include "uncertainty/capture_estimate.hpp"

namespace recoil {

struct FitResult;

/// Cuts an interval of V* where single rows of this size exclude it. A row excludes a value if -2
/// ln of the ratio of its likelihood there and at the estimate exceeds the square of the quantile
/// that the level gives.
///
/// If V* were above the velocity of a rebound, the model would have no rebound, e^2 <= 0: the row
/// tells how unlikely that is, whatever the parameters. If V* were below the velocity of a capture,
/// e^2 would be that of the fitted curve, moved along ln V. All stated errors of the row count, the
/// shared ones too. A row that contradicts the estimate itself does not cut.
Interval cut_by_rows(Interval interval, const FitResult& fitted, const CaptureEstimate& capture,
                     double level);

}  // namespace recoil
