#pragma once

#include <optional>
#include <vector>

#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/intervals.hpp"

namespace recoil {

/// The fit under one of the variance functions that its points allow.
struct NoiseAlternative {
  double weight = 1.0;  ///< share of it in the averaged intervals; all add up to 1
  FitResult fitted;
};

/// The fit itself and, where its variance function was chosen among several, the fits with the
/// others, weighted by exp(-(c - c_min) / 2), c being the restricted criterion with its penalty
/// (see `reweighted_fit`). Functions that weigh less than a thousandth are left out; a fit with
/// stated or prescribed noise stands alone.
std::vector<NoiseAlternative> noise_alternatives(const FitResult& fitted);

/// One quantity under every alternative: slot j.
std::vector<WaldTerm> terms_of_slot(const std::vector<NoiseAlternative>& alternatives,
                                    std::size_t j);

/// By what factor the errors differ that the data cannot decide between: the largest over the
/// smallest of those that weigh at least a twentieth. 1 without a choice.
double undecided_factor(const std::vector<WaldTerm>& terms);

/// Beyond this factor an error depends on the variance function that is assumed, and the verdict
/// says so.
constexpr double undecided = 1.5;

/// Where the capture velocity scatters from impact to impact by more than this, the intervals are
/// not to be trusted: e^2 of the impacts at one velocity is taken as normal (see `reweighted_fit`),
/// while in truth it is about 1 - (V* exp(-omega z) / V)^3 and has a long tail below. With omega =
/// 0.1 intervals contain the truth as often as they promise; in simulations of 14 points with omega
/// = 0.27 to 0.5 those of C_H and of the capture velocity contained the truth in 8 to 67 % of the
/// data sets.
constexpr double widest_spread = 0.2;

/// The Wald interval of slot j, averaged over the alternatives (`averaged_wald_interval`), cut at
/// the slot's bounds; the plain one where there is a single alternative.
Interval wald_over_noise(const std::vector<NoiseAlternative>& alternatives, std::size_t j,
                         double level);

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
