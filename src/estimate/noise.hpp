#pragma once

#include <span>
#include <vector>

#include "core/random.hpp"
#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// How far the points lie from a fit, in the measure that fits their distribution.
///
/// Where the noise is estimated, only means of rebounds count: counts of captures do not scatter
/// less when the standard deviations are larger.
struct Misfit {
  double square = 0.0;   ///< sum of r^2; for Student's t sum of psi(r)^2 / E psi^2: both expect dof
  int dof = 0;           ///< points less free parameters; captured points that the model also
                         ///< captures do not count, as they cannot scatter
  double p_value = 1.0;  ///< of `square` under the weights as they are; 1 without dof

  double scale() const;  ///< sqrt(square / dof): what the weights are too small by; 1 without dof
};

/// @param residuals of `weighted_residual`, [points]
/// @param predicted e^2 [points]
Misfit misfit(const Observations& data, std::span<const double> residuals,
              std::span<const double> predicted, int free_count);

/// Parameters and the weights that belong to them.
struct Settled {
  LeastSquaresResult run;  ///< the last descent; not converged when a round failed
  Observations data;       ///< with the weights that `run` worked on
  bool at_rest = true;     ///< false: still moving when the rounds ran out
};

struct SettleOptions {
  LeastSquaresOptions minimiser;
  double parameters = 1e-3;  ///< rounds end when no parameter moves by more, in standard errors,
  double scale = 1e-4;       ///< and the estimated scale by no more, relative
};

/// Fits the parameters from `start` (near the answer: a fit with rough weights, or the estimate of
/// the data that a replicate was drawn from) and settles everything that depends on them, in turns
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
///   a survivors' mean is its own, or `survivors_sd` where that is larger.
///
/// The choice of a variance function: the smallest
///   sum 2 ln sd_i + chi2 + ln |J'J| + handicap,
/// -2 ln restricted likelihood (all have one number s, so no count of parameters tells them apart)
/// and a handicap for what a wrong choice costs. With 10 to 20 points the likelihood can hardly
/// tell them apart, and the mistakes are not alike: a function that grows too little towards
/// capture makes intervals that miss the truth, one that grows too much makes wide ones. So `steep`
/// has no handicap, `constant` and `capture` 2 and `proportional` 4: few points are fitted with
/// `steep`, and at 60 the data decide. Simulated (300 data sets of 20 points,
/// f0 fixed, scatter five times larger at capture): Wald intervals of C_A and V* under `steep`
/// alone held in 93 to 95 %; of C_A with only the other three to choose from in 87 %.
///
/// A replicate calls this too: what was estimated from the data is estimated again.
Settled settle(const ImpactModel& model, Observations data, std::span<const double> start,
               const SettleOptions& options = {});

/// What is added to -2 ln restricted likelihood before variance functions are compared.
double handicap(VarianceFunction function);

/// (J'J)^-1 of a fit to `data` as a covariance for weights that are right up to `noise_scale`.
std::vector<double> scaled_covariance(const Observations& data,
                                      const std::vector<double>& inverse_information,
                                      double noise_scale);

/// The captures among the impacts of a point with scatter, drawn anew by the binomial quantile of
/// `uniform` where the truth is `restitution_squared`, with the sd that a mean of this many
/// rebounds has; its mean is left to the caller.
Observation redraw_captures(const Observation& point, double restitution_squared, double uniform);

/// A point measured anew under the noise that weights it, where the truth is `restitution_squared`:
/// - a mean of rebounds gets an e^2 shifted by input_sd z_1 and a mean about its root by sd
///   `noise_scale` z_2 (Student's t in place of z_2 where the residuals are), not below 0;
/// - where impacts differ (scatter), the captures among its events are drawn from the binomial
///   distribution and the survivors' mean about its expectation, with the sd that this many have; a
///   point may so become captured altogether, or a captured one rebound;
/// - a captured point without scatter stays captured.
/// Draws three numbers from `random`, whatever happens. The weights of the result are those of
/// `point`; `settle` renews them.
Observation simulate_observation(const Observation& point, double restitution_squared,
                                 double noise_scale, RandomStream& random);

}  // namespace recoil
