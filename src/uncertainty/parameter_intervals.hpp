#pragma once

#include <optional>
#include <vector>

#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/fit_alternatives.hpp"
#include "uncertainty/interval.hpp"

namespace recoil {

/// The intervals of every slot that need no replicates [slots]: Wald, averaged over the variance
/// functions of the noise, and profile.
/// @param alternatives of `fit_alternatives`; the first is the fit
/// @param threads 0: all cores. Results do not depend on it.
std::vector<IntervalSet> likelihood_intervals(const std::vector<FitAlternative>& alternatives,
                                              double level, int threads);

/// Adds the profile likelihood of every free slot, for pictures.
/// @param sets of `likelihood_intervals`
void add_profile_curves(const FitResult& fitted, double level, int threads,
                        std::vector<IntervalSet>& sets);

/// Adds percentile, BCa and studentized intervals, notes which ends lie on bounds, selects the
/// interval to quote for each slot, and explains why intervals differ.
/// @param sets of `likelihood_intervals`
void add_resampled_intervals(const FitResult& fitted, const BootstrapResult& replicates,
                             double level, int threads, std::vector<IntervalSet>& sets);

/// The same fit with exact material constants.
struct ConditionalFit {
  FitResult fitted;
  std::vector<IntervalSet> intervals;  ///< [its slots]: Wald and profile only
};

/// Fits with exact constants. Nullopt if all constants are exact, or if that fit fails.
std::optional<ConditionalFit> conditional_fit(const FitResult& fitted, double level, int threads);

/// Selects the interval to quote, and states the reason. The rule follows the coverage study
/// (reports/coverage-grid-n{10,20,60}-{stated,estimated}.md).
///
/// It is the profile interval, which is valid for a likelihood that is not quadratic, ends at the
/// bounds and refits the spread of the impacts with the parameters. If the noise is estimated, it
/// uses the chosen variance function and Student's quantile. The studentized interval of the wild
/// bootstrap makes no assumption about unequal scatter, but its coverage was lower: a parameter
/// that two or three points near capture determine has only their residuals as its noise. Without a
/// profile interval it is the percentile interval, else Wald.
void recommend(IntervalSet& set, bool sd_stated);

/// The differences of the intervals of one free parameter from the recommended one, and those of
/// the following causes that are present:
/// - bound: the estimate, or more than 5 % of the replicates, rest on a bound, of this parameter or
///   of one with a correlation above 0.5;
/// - ridge: a correlation above 0.97 with another free parameter;
/// - skew: |acceleration| > 0.05, |z0| > 0.15, or arms of the profile that differ by 25 %;
/// - few points: Student's quantile exceeds the normal one by 10 %.
///
/// Nullopt if no end differs by more than 15 % of the recommended width beyond its Monte-Carlo
/// error.
/// @param sets intervals of all slots, complete except for `disagreement`
std::optional<Disagreement> explain_disagreement(const FitResult& fitted, std::size_t slot,
                                                 const std::vector<IntervalSet>& sets,
                                                 double level);

/// The share of the usable replicates in which `slot` rests on one of its bounds.
std::optional<double> bound_share(const BootstrapResult& boot, const ParameterSlot& slot,
                                  std::size_t index);

/// Adds a note if an end is the parameter's bound.
void note_bounds(Interval& interval, const ParameterSlot& slot);

}  // namespace recoil
