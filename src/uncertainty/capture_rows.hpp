#pragma once

#include "uncertainty/capture_estimate.hpp"

namespace recoil {

struct FitResult;

/// Cuts an interval of V* where single rows of this size exclude it. A row excludes a value if -2
/// ln of the ratio of its likelihood there and at the estimate exceeds the square of the quantile
/// of 1 - (1 - level) / (10 n), with n rows of this size (Bonferroni's inequality). So all rows
/// together exclude the true V* in a tenth of 1 - level at most: at the level of the interval
/// itself, a row in twenty would.
///
/// If V* were above the velocity of a rebound, the model would have no rebound, e^2 <= 0: the row
/// tells how unlikely that is, whatever the parameters. If V* were below the velocity of a capture,
/// e^2 would be that of the fitted curve, moved along ln V. All stated errors of the row count, the
/// shared ones too. A row that contradicts the estimate itself does not cut.
Interval cut_by_rows(Interval interval, const FitResult& fitted, const CaptureEstimate& capture,
                     double level);

}  // namespace recoil
