#pragma once

#include <optional>
#include <vector>

#include "estimate/fit.hpp"

namespace recoil {

/// A size of the error of the laws, with its prior probability.
struct LawErrorSize {
  double size = 0.0;   ///< standard deviation of the error relative to the loss [1]; 0: exact laws
  double prior = 1.0;  ///< probability [1]
};
/// All sizes, ascending; see `fit_over_laws`.
std::vector<LawErrorSize> sizes_of_law_error();

/// The fit averaged over how wrong the laws are.
///
/// No law of an impact is exact, and how wrong it is, is not known before the fit. So the size of
/// its error (`LawError`) has a prior, which is written here before any data are seen:
/// - the laws are exact with a probability of 10 %; else they are wrong by 1.5, 3, 6, 12 or 24 % of
///   the loss, with a constant density in s: every size up to the largest is equally likely.
///   Published laws differ by 6 to 12 %. A bend of this size that the dampings absorb moves them by
///   two of its standard deviations, so the largest size is twice as large;
/// - the error bends over 0.8 or 1.6 in ln V, a factor of 2.2 or 5 in V. A shorter bend is noise of
///   the points, and a longer one is a change of the dampings;
/// - sizes share it or have their own, or it belongs to slow impacts and falls as 1 / V^2. These
///   five forms are equally likely.
///
/// The points give every such assumption the weight of its restricted likelihood. The result is the
/// fit under the likeliest; the others are in `FitResult::laws`, and intervals are averaged over
/// them. Material constants move within their stated errors under every assumption.
///
/// If the noise is not known, or the fit is not usable, the laws are taken as exact.
FitResult fit_over_laws(const ImpactModel& model, Observations data,
                        const FitOptions& options = {});

/// The fit with the constants and the laws that `spec.uncertainty.materials` asks for.
FitResult fit_as_stated(const FitSpec& spec, const ImpactModel& model, Observations data,
                        const FitOptions& options = {});

/// How wrong the laws are: the posterior of the size of their error.
struct LawErrorEstimate {
  double exact_weight = 1.0;        ///< posterior probability that they are exact [1]
  double median = 0.0;              ///< of their error, if they are not exact [1]
  double lower = 0.0, upper = 0.0;  ///< interval of the error, 0 included [1]

  /// Is an error seen? The points must be 20 times as probable with wrong laws as with exact ones
  /// (Bayes factor). Points made by exact laws are so in at most 1 of 20 sets (Markov's inequality;
  /// Ville 1939, Etude critique de la notion de collectif).
  bool seen() const;
};
/// @return nullopt if the fit was not averaged
std::optional<LawErrorEstimate> law_error_of(const FitResult& fitted, double level);

/// The fit with exact laws, which `fitted` was compared with; itself if it was not averaged.
const FitResult& with_laws_exact(const FitResult& fitted);

}  // namespace recoil
