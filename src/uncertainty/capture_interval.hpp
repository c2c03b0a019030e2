#pragma once

#include <vector>

#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/fit_alternatives.hpp"

namespace recoil {

/// The capture velocity of every (dataset, diameter) of a fit with its delta interval.
/// @param alternatives of `fit_alternatives`; the first is the fit
std::vector<CaptureEstimate> capture_estimates(const std::vector<FitAlternative>& alternatives,
                                               double level, const std::vector<Dataset>& datasets);

/// The delta interval of V* [m/s] at another level.
Interval capture_interval(const std::vector<FitAlternative>& alternatives,
                          const CaptureEstimate& at, double level);

/// Selects the interval of V* to quote (reports/coverage-grid-n{10,20,60}-{stated,estimated}.md).
/// If a parameter rests on its bound: the percentile interval, as the covariance does not include
/// that parameter. If the noise is stated and no spread of the impacts is estimated: the percentile
/// interval, which includes the nonlinearity of V* in the parameters. If the spread is estimated:
/// the delta interval, whose error includes it; the replicates mix data sets with and without
/// points that determine the spread. If the noise is estimated: the delta interval, which accounts
/// for the few points that estimate the noise and is averaged over the variance functions.
void recommend_capture(const FitResult& fitted, bool sd_stated, CaptureEstimate& capture);

/// Adds percentile and studentized intervals of the capture velocities, and selects the one to
/// quote.
/// @param captures from `capture_estimates`; `replicates` contain their velocities
void add_resampled_captures(const FitResult& fitted, const BootstrapResult& replicates,
                            double level, std::vector<CaptureEstimate>& captures);

/// If every point states only that all or none of its spheres were captured, the points do not
/// determine V* but limit it: `above` the fastest captures, `below` the slowest rebounds.
void limit_by_captures(const Observations& data, std::vector<CaptureEstimate>& captures);

}  // namespace recoil
