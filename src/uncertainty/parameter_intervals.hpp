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

/// Names the interval to quote, and why: the one place where the rule stands. It follows the
/// coverage study (reports/coverage-grid-n{10,20,60}-{stated,estimated}.md).
///
/// The profile, which follows the likelihood where that is not a parabola, stops at the bounds and
/// refits the spread of the impacts with the parameters; where the noise is estimated, under the
/// variance function that the points choose and with Student's factor. The studentized interval of
/// the wild bootstrap assumes nothing about where the points scatter more, but a parameter that
/// hangs on two or three points near capture has only their own residuals for its noise, and it
/// contained the truth less often. Without a profile percentile, else Wald.
void recommend(IntervalSet& set, bool sd_stated);

/// Why the intervals of one free parameter differ: which of them differ by how much from the
/// recommended one, and which of these the numbers show:
///   - bound: the estimate, or more than a twentieth of the replicates, rest on a bound, of this
///     parameter or of one that it is correlated with beyond 0.5;
///   - ridge: a correlation beyond 0.97 with another free parameter;
///   - skew: |acceleration| > 0.05, |z0| > 0.15, or arms of the profile that differ by a quarter;
///   - few points: Student's quantile is a tenth larger than the normal one.
/// None when no end differs by more than 15 % of the recommended width beyond its Monte-Carlo
/// error.
/// @param sets of all slots, complete but for this
std::optional<Disagreement> explain_disagreement(const FitResult& fitted, std::size_t slot,
                                                 const std::vector<IntervalSet>& sets,
                                                 double level);

/// The share of the usable replicates in which `slot` rests on one of its bounds.
std::optional<double> bound_share(const BootstrapResult& boot, const ParameterSlot& slot,
                                  std::size_t index);

/// Notes it when an end is the parameter's bound.
void note_bounds(Interval& interval, const ParameterSlot& slot);

}  // namespace recoil
