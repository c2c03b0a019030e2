#pragma once

#include <optional>

#include "estimate/fit.hpp"

namespace recoil {

/// The fit averaged over how wrong the laws are.
///
/// No law of an impact is exact, and how wrong it is, is not known before the fit. So the size of
/// its error (`LawError`) has a prior: with equal probability the laws are exact, or wrong by s =
/// 0.3, 0.54, 0.97, 1.7, 3.1, 5.6 or 10 % of the loss. (Equal steps of ln s, as nothing prefers a
/// size; below 0.3 % no measured e of today shows the error, and an error above 10 % is another
/// cause, which a diagnosis names.) The error bends over 0.8 or 1.6 in ln V, which is a factor of
/// 2.2 or 5 in V, and sizes share it or have their own, with equal probability. A bend that is
/// shorter is noise of the points, and one that is longer is a change of the dampings.
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

  /// Is an error seen? The laws are then exact with a probability of at most 5 %.
  bool seen() const { return exact_weight <= 0.05; }
};
/// @return nullopt if the fit was not averaged
std::optional<LawErrorEstimate> law_error_of(const FitResult& fitted, double level);

/// The fit with exact laws, which `fitted` was compared with; itself if it was not averaged.
const FitResult& with_laws_exact(const FitResult& fitted);

}  // namespace recoil
