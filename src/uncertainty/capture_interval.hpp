#pragma once

#include <vector>

#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/noise_alternatives.hpp"

namespace recoil {

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
