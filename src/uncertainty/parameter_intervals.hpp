#pragma once

#include <optional>
#include <vector>

#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/noise_alternatives.hpp"

namespace recoil {

/// The intervals of every slot that need no replicates: Wald, averaged over the variance functions
/// of the noise, and profile.
/// @param alternatives of `noise_alternatives`; the first is the fit
/// @param threads 0: all cores. No digit depends on it.
std::vector<IntervalSet> likelihood_intervals(const std::vector<NoiseAlternative>& alternatives,
                                              double level, int threads);

/// Adds the profile likelihood of every free slot, for pictures.
/// @param sets of `likelihood_intervals`
void add_profile_curves(const FitResult& fitted, double level, int threads,
                        std::vector<IntervalSet>& sets);

/// Adds percentile, BCa and studentized intervals, notes which ends lie on bounds, recommends an
/// interval for each slot and says why intervals differ.
/// @param sets of `likelihood_intervals`
void add_resampled_intervals(const FitResult& fitted, const BootstrapResult& replicates,
                             double level, int threads, std::vector<IntervalSet>& sets);

/// The same fit with the constants of the materials taken as exact.
struct ConditionalFit {
  FitResult fitted;
  std::vector<IntervalSet> intervals;  ///< [its slots]: Wald and profile only
};

/// Nullopt where all constants are exact already, or the fit has no answer.
std::optional<ConditionalFit> conditional_fit(const FitResult& fitted, double level, int threads);

}  // namespace recoil
