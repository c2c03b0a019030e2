#pragma once

#include <optional>
#include <span>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"
#include "estimate/weights.hpp"

namespace recoil {

/// The estimate together with its weights (iteratively reweighted least squares).
struct ReweightedFit {
  LeastSquaresResult run;  ///< the last descent; not ended() when a round failed
  Weights weights;         ///< those of `run`
  bool at_rest = true;     ///< false: still changing in the last round
  long handovers = 0;      ///< impacts that the fast solver handed to the reference
};

/// Residuals of e below this are taken as rounding [1].
inline constexpr double least_noise = 1e-6;

struct ReweightingOptions {
  LeastSquaresOptions minimiser;
  /// Rounds end if no parameter moves by more than `parameters` standard errors and the estimated
  /// scale by less than `scale`, relative.
  double parameters = 1e-3;
  double scale = 1e-4;
  /// The data are a replicate of a fit with the candidates of `noise`: every variance function
  /// starts from its scale and parameters there, shifted as those of the function before it.
  bool replicate = false;
};

/// Fits the parameters from `start` (near the answer: a fit with rough weights, or the estimate
/// from which a replicate was drawn) and the weights in turns until neither changes. The weights
/// depend on:
/// - the variance function at the predicted e, its scale s such that square / dof = 1 (restricted
///   maximum likelihood; Carroll & Ruppert 1988, sections 2.2 and 3.2), and the choice of the
///   function unless the fit file names one (see below);
/// - effective variances: the errors of V and d propagate to e^2,
///     var(e^2) += (d e^2 / d ln V)^2 (sd_V / V)^2 + (d e^2 / d ln d)^2 (sd_d / d)^2,
///   with slopes taken as differences over one such deviation, and 2 e^2 added to the slope in V if
///   e was computed from V. This is first order. The curvature shifts e^2 by about input_bias =
///   (sd_V / V)^2 / 2 d^2 e^2 / d ln V^2 (and equally for d); the fit warns if this exceeds a tenth
///   of the standard deviation of a point. Errors are independent from point to point;
/// - event_spread, the relative scatter omega of the capture velocity from impact to impact, by
///   maximum likelihood of the counts and the survivors' means, in the range where spheres rebound
///   and stick: an impact at V behaves like the mean impact at V exp(omega z), so its e^2 has the
///   mean and variance
///     e^2 + omega^2 / 2 b,  omega^2 a^2 + omega^4 / 2 b^2
///   with a, b the first two derivatives of e^2 in ln V (differences over sqrt(3) omega). The sd of
///   a survivors' mean is that of `survivors_sd`;
/// - setting_sd, the error of e that the points of one setting share, see `setting_sd_at`.
///
/// The chosen variance function has the smallest
///   sum 2 ln sd_i + chi2 + ln |J'J| + penalty,
/// the first three terms being -2 ln restricted likelihood (all functions have one parameter s) and
/// the last a penalty for the cost of a wrong choice. With 10 to 20 points the likelihood hardly
/// distinguishes the functions, and the errors are not symmetric: if the function increases too
/// little towards capture, intervals miss the truth; if it increases too much, they are wide. So
/// `steep` has no penalty, `constant` and `capture` 2 and `proportional` 4: few points select
/// `steep`, and 60 points decide by the data. In simulations (300 data sets of 20 points, f0 fixed,
/// scatter five times larger at capture): Wald intervals of C_A and V* under `steep` alone
/// contained the truth in 93 to 95 %; of C_A with only the other three to choose from in 87 %.
///
/// Replicates call this function too, so that everything that was estimated from the data is
/// estimated again.
/// @param noise where the estimates of the noise start
ReweightedFit reweighted_fit(const ImpactModel& model, const Observations& data, const Noise& noise,
                             std::span<const double> start, const ReweightingOptions& options = {});

/// -2 ln restricted likelihood up to a constant that all variance functions and all errors of the
/// laws share: sum 2 ln sd_i + chi2 + ln |J'J|.
double restricted_criterion(const ImpactModel& model, const Observations& data,
                            const LeastSquaresResult& run, const Weights& weights);

/// The penalty added to -2 ln restricted likelihood in the comparison of variance functions.
double penalty_of(VarianceFunction function);

/// The difference in -2 ln restricted likelihood, with penalties, between the second-best and the
/// chosen candidate; 0 without a choice.
double choice_margin(const Noise& noise);

}  // namespace recoil
