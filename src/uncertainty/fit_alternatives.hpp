#pragma once

#include <memory>
#include <vector>

#include "estimate/fit.hpp"
#include "uncertainty/intervals.hpp"

namespace recoil {

/// The fit under one of the assumptions that agree with its points: about the error of the laws, or
/// about the variance function of the noise.
struct FitAlternative {
  double weight = 1.0;  ///< its weight in averaged intervals; the weights add up to 1
  std::shared_ptr<const FitResult> held;

  const FitResult& fitted() const { return *held; }
};

/// The fit itself, which must outlive the result, with its alternatives: those of `fit_over_laws`
/// and `noise_alternatives`.
std::vector<FitAlternative> fit_alternatives(const FitResult& fitted);

/// The fit itself and, if its variance function was chosen among several, the fits with the others.
/// The weights are proportional to exp(-(c - c_min) / 2), where c is the restricted criterion with
/// its penalty (see `reweighted_fit`). Functions with a relative weight below 0.001 are omitted. A
/// fit with stated noise, or with a variance function from the fit file, has no alternatives.
std::vector<FitAlternative> noise_alternatives(const FitResult& fitted);

/// The estimate of slot j under every alternative.
std::vector<WaldTerm> terms_of_slot(const std::vector<FitAlternative>& alternatives, std::size_t j);

/// Those that differ from the first only in the variance function of the noise.
std::vector<FitAlternative> under_same_laws(std::vector<FitAlternative> alternatives);

/// The ratio of the largest to the smallest error among the terms with a weight of at least 0.05,
/// between which the data cannot decide. 1 without a choice.
double undecided_factor(const std::vector<WaldTerm>& terms);

/// Above this ratio an error depends on the assumed variance function, and the verdict states it.
constexpr double undecided = 1.5;

/// If the capture velocity scatters from impact to impact by more than this (relative, omega),
/// intervals are not reliable: e^2 of the impacts at one velocity is assumed normal (see
/// `reweighted_fit`), although it is about 1 - (V* exp(-omega z) / V)^3, with a long lower tail.
/// With omega = 0.1 the coverage equals the level; in simulations of 14 points with omega = 0.27 to
/// 0.5 the coverage of C_H and of the capture velocity was 8 to 67 %.
constexpr double widest_spread = 0.2;

/// The Wald interval of slot j, averaged over the alternatives (`averaged_wald_interval`), clipped
/// at the slot's bounds; the ordinary one for a single alternative.
Interval averaged_wald(const std::vector<FitAlternative>& alternatives, std::size_t j,
                       double level);

}  // namespace recoil
