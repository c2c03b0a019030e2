#pragma once

#include <optional>

#include "core/random.hpp"
#include "estimate/observation.hpp"
#include "estimate/student.hpp"

namespace recoil {

/// Mean, its derivative and variance of sqrt(u + z) given u + z > 0, z standard normal: the
/// restitution of spheres that were not captured, in units of sqrt(scatter), where u is the
/// predicted e^2 in units of the scatter of e^2 from impact to impact.
///   G(u) = E[sqrt(u + z) | u + z > 0],  G' = E[(u + z)^(3/2) | .] - (u + lambda) G,
///   Var = u + lambda - G^2,  lambda = phi(u) / Phi(u).
/// To 1e-9 relative at any u: the trapezoid rule in sqrt(u + z), whose integrand is even and
/// analytic, interpolated from a table above u = -12, and the asymptotic series above u = 12.
struct RootMoments {
  double mean = 0.0;
  double slope = 0.0;  ///< d mean / d u
  double variance = 0.0;
};
RootMoments root_of_positive_normal(double u);

/// The weighted residual of one point and its derivative with respect to the predicted e^2: the
/// signed root of its deviance, r = sign(m_best - m) sqrt(D(m) - D(m_best)), so that the sum of r^2
/// is -2 ln likelihood but for a constant.
///
/// A mean of rebounds. With y = e^2 - sigma^2 (unbiased for the square of the mean), m the
/// predicted e^2, continued below zero for a capture, and tau = input_sd,
///   r = (y - m) / sqrt(sigma^2 ((e + psi(m))^2 + 2 sigma^2) + tau^2),
///   psi(m) = sqrt((m + sqrt(m^2 + sigma^4)) / 2).
/// Away from capture psi = sqrt(m) and r is (e - e_model) / sigma: the Gaussian residual, without
/// the bias of weights taken from noisy points. Through capture it stays smooth, and its variance
/// is that of e^2, 4 e^2 sigma^2 + 2 sigma^4 (the floor).
///
/// All n captured: the Tobit residual sqrt(-2 n_eff ln Phi(-m / s)), which vanishes where the model
/// captures. Where the impacts differ (`scatter`), s^2 = scatter^2 + tau^2, and what they share
/// (tau) makes them fewer: n_eff = 1 + (n - 1) scatter^2 / s^2. Where nothing is known of that, the
/// point is one observation, s^2 = 2 sigma^4 + tau^2 that of the mean: errors of measuring e, of
/// which sigma sqrt(n) may consist, let no sphere stick, and taken for impacts that differ they
/// would hold a captured point far below the capture velocity.
///
/// None captured, and no e known: the same with Phi(m / s).
///
/// Impacts that differ (`scatter` > 0): every impact has its own x = m + shift + scatter z, z
/// normal; x < 0 is captured, else e = sqrt(x). With u = (m + shift) / scatter,
///   D = -2 (k ln Phi(-u) + (n - k) ln Phi(u)) + (e - sqrt(scatter) G(u))^2 / mean_sd^2,
/// G of `root_of_positive_normal`: the mean of the survivors is compared with the expected mean of
/// survivors, which lies above the curve close to capture. The counts are left out where nobody
/// counted, the mean where only counts are known.
///
/// Student's t (`student`): r becomes sign(r) c sqrt((nu + 1) ln(1 + r^2 / nu)), see StudentNoise.
WeightedResidual weighted_residual(const Observation& point, double restitution_squared,
                                   const std::optional<StudentNoise>& student = std::nullopt);

/// Finds `peak` of a point with scatter, for its present weights.
void locate_peak(Observation& point);

/// The deviance of a point with scatter (see above), constants left out.
double event_deviance(const Observation& point, double restitution_squared);

/// Standard deviation of the mean e of the survivors of a point with scatter [1]: its own, but no
/// less than what the scatter alone makes of so few (with two or three survivors a deviation stated
/// from their differences may be anything). That of a single survivor is the error of its reading,
/// to which the scatter adds in quadrature.
double survivors_sd(const Observation& point, double restitution_squared);

/// What the mean e of the rebounds of this point should be where the model predicts
/// `restitution_squared`: sqrt(e^2), or the mean of the survivors [1].
double expected_restitution(const Observation& point, double restitution_squared);

/// The captures among the impacts of a point with scatter, drawn anew by the binomial quantile of
/// `uniform` where the truth is `restitution_squared`, with the sd that a mean of this many
/// rebounds has; its mean is left to the caller.
Observation redraw_captures(const Observation& point, double restitution_squared, double uniform);

/// Of the error that a point has for itself: 0 for a bounce whose error `draw_setting_errors`
/// draws.
inline double own_noise_scale(const Observation& point, double noise_scale) {
  return point.launch == Observation::no_launch ? noise_scale : 0.0;
}

/// A point measured anew under the noise that weights it, where the truth is `restitution_squared`:
/// - a mean of rebounds gets an e^2 shifted by input_sd z_1 and a mean about its root by sd
///   `noise_scale` z_2 (Student's t in place of z_2 where `student` says so), not below 0;
/// - where impacts differ (scatter), the captures among its events are drawn from the binomial
///   distribution and the survivors' mean about its expectation, with the sd that this many have; a
///   point may so become captured altogether, or a captured one rebound;
/// - a captured point without scatter stays captured.
/// Draws three numbers from `random`, whatever happens. The weights of the result are those of
/// `point`; `renew_weights` renews them.
Observation simulate_observation(const Observation& point, double restitution_squared,
                                 double noise_scale, const std::optional<StudentNoise>& student,
                                 RandomStream& random);

}  // namespace recoil
