#pragma once

#include <optional>
#include <span>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// Renews only the scatter from impact to impact: event_spread by maximum likelihood at `theta`,
/// and what follows from it for the points; standard deviations and effective variances stay.
/// Nothing happens where no point has both rebounds and captures.
/// @returns false when the model has no answer somewhere
bool renew_event_spread(const ImpactModel& model, std::span<const double> theta,
                        Observations& data);

/// What not knowing event_spread adds to the covariance (J'J)^-1 of an estimate: with T = -2 ln
/// likelihood, g = d^2 T / (d theta d ln omega) / 2, h = d^2 T / (d ln omega)^2 / 2 and C =
/// (J'J)^-1,
///   v b b',  b = -C g = d theta / d ln omega,  v = 1 / (h - g'C g) the variance of ln omega,
/// the joint information of both inverted by blocks [p x p]. Empty where event_spread is not in
/// use, or C is empty. Derivatives are differences over a tenth of ln omega; v is at most 1 (a
/// factor e).
std::vector<double> event_spread_covariance(const ImpactModel& model, std::span<const double> theta,
                                            const Observations& data, std::span<const double> C);

/// What the sum of squared residuals lacks of -2 ln likelihood while event_spread changes (and
/// nothing else): sum over the points with scatter and rebounds of D(peak) + 2 ln mean_sd.
double event_spread_offset(const Observations& data);

/// Parameters and the weights that belong to them (iteratively reweighted least squares).
struct ReweightedFit {
  LeastSquaresResult run;  ///< the last descent; not ended() when a round failed
  Observations data;       ///< with the weights that `run` worked on
  bool at_rest = true;     ///< false: still moving when the rounds ran out
};

/// Residuals of e below this are rounding: no measurement is better [1].
inline constexpr double least_noise = 1e-6;

struct ReweightingOptions {
  LeastSquaresOptions minimiser;
  double parameters = 1e-3;  ///< rounds end when no parameter moves by more, in standard errors,
  double scale = 1e-4;       ///< and the estimated scale by no more, relative
  /// The data are a replicate of a fit with these `candidates`: every variance function begins with
  /// its scale and parameters there, moved as those of the function before it have moved.
  bool replicate = false;
};

/// Fits the parameters from `start` (near the answer: a fit with rough weights, or the estimate of
/// the data that a replicate was drawn from) and everything that depends on them, in turns
/// until neither moves:
/// - the variance function at the predicted e, its scale s from square / dof = 1 (restricted
///   maximum likelihood; Carroll & Ruppert 1988, section 2.2 and 3.2) and, unless the fit file
///   names one, the function itself (see below);
/// - effective variances: the errors of V and d reach e^2 by its slope,
///     var(e^2) += (d e^2 / d ln V)^2 (sd_V / V)^2 + (d e^2 / d ln d)^2 (sd_d / d)^2,
///   with slopes taken as differences over one such deviation, and 2 e^2 added to the slope in V
///   where e was computed from V. First order: curvature is left out, which moves e^2 by about
///   input_bias = (sd_V / V)^2 / 2 d^2 e^2 / d ln V^2 and the like; the fit warns where that
///   exceeds a tenth of the standard deviation of a point. Errors are taken as independent from
///   point to point;
/// - event_spread, the relative scatter omega of the capture velocity from impact to impact, by
///   maximum likelihood of the counts and the survivors' means, wherever a point has both:
///   an impact at V fares like the mean one at V exp(omega z), so its e^2 has the mean and variance
///     e^2 + omega^2 / 2 b,  omega^2 a^2 + omega^4 / 2 b^2
///   with a, b the first two derivatives of e^2 in ln V (differences over sqrt(3) omega). The sd of
///   a survivors' mean is its own, or `survivors_sd` where that is larger;
/// - setting_sd, the error of e that the points of one setting share, see `renew_settings`.
///
/// The choice of a variance function: the smallest
///   sum 2 ln sd_i + chi2 + ln |J'J| + penalty,
/// -2 ln restricted likelihood (all have one number s, so no count of parameters tells them apart)
/// and a penalty for what a wrong choice costs. With 10 to 20 points the likelihood can hardly
/// tell them apart, and the mistakes are not alike: a function that grows too little towards
/// capture makes intervals that miss the truth, one that grows too much makes wide ones. So `steep`
/// has no penalty, `constant` and `capture` 2 and `proportional` 4: few points are fitted with
/// `steep`, and at 60 the data decide. Simulated (300 data sets of 20 points,
/// f0 fixed, scatter five times larger at capture): Wald intervals of C_A and V* under `steep`
/// alone contained the truth in 93 to 95 %; of C_A with only the other three to choose from in 87
/// %.
///
/// A replicate calls this too: what was estimated from the data is estimated again.
ReweightedFit reweighted_fit(const ImpactModel& model, Observations data,
                             std::span<const double> start, const ReweightingOptions& options = {});

/// What is added to -2 ln restricted likelihood before variance functions are compared.
double penalty_of(VarianceFunction function);

/// How far the next best candidate lies behind the chosen one, penalties included, in -2 ln
/// restricted likelihood; 0 without a choice.
double choice_margin(const NoiseModel& noise);

}  // namespace recoil
