#pragma once

#include <vector>

#include "estimate/fit.hpp"
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

}  // namespace recoil
