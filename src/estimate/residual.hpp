#pragma once

#include <optional>

#include "core/random.hpp"
#include "estimate/observation.hpp"
#include "estimate/student.hpp"
#include "estimate/weights.hpp"

namespace recoil {

/// Mean of sqrt(u + z) given u + z > 0, its derivative in u, and the variance; z is standard
/// normal. This is the restitution of spheres that were not captured, in units of sqrt(scatter),
/// where u is the predicted e^2 in units of the scatter of e^2 from impact to impact:
///   G(u) = E[sqrt(u + z) | u + z > 0],  G' = E[(u + z)^(3/2) | .] - (u + lambda) G,
///   Var = u + lambda - G^2,  lambda = phi(u) / Phi(u).
/// Relative error below 1e-9 at any u: the trapezoid rule in sqrt(u + z) (the integrand is even and
/// analytic) for u < -12, interpolation in a table of it up to u = 12, and the asymptotic series
/// above.
struct RootMoments {
  double mean = 0.0;
  double slope = 0.0;  ///< d mean / d u
  double variance = 0.0;
};
RootMoments root_of_positive_normal(double u);

/// The weighted residual of one point and its derivative with respect to the predicted e^2: the
/// signed square root of its deviance, r = sign(m_best - m) sqrt(D(m) - D(m_best)), so that the sum
/// of r^2 is -2 ln likelihood up to a constant. The cases are:
///
/// A mean of rebounds. With y = e^2 - sigma^2 (unbiased for the square of the mean), m the
/// predicted e^2, continued below zero for a capture, and tau = input_sd,
///   r = (y - m) / sqrt(sigma^2 ((e + psi(m))^2 + 2 sigma^2) + tau^2),
///   psi(m) = sqrt((m + sqrt(m^2 + sigma^4)) / 2).
/// Away from capture psi = sqrt(m), and r is the Gaussian residual (e - e_model) / sigma, without
/// the bias of weights from noisy points. r is smooth through capture; its width is the standard
/// deviation of e^2, whose variance is 4 e^2 sigma^2 + 2 sigma^4.
///
/// All n captured: the Tobit residual sqrt(-2 n_eff ln Phi(-m / s)), which vanishes if the model
/// captures. If the impacts differ (`scatter`), s^2 = scatter^2 + tau^2, and the common error tau
/// reduces the effective number, n_eff = 1 + (n - 1) scatter^2 / s^2. If the scatter is unknown,
/// the point is one observation of the mean, n_eff = 1 and s^2 = 2 sigma^4 + tau^2: sigma sqrt(n)
/// may consist of errors in measuring e, which do not capture spheres; treated as scatter of the
/// impacts they would force a captured point far below the capture velocity.
///
/// No sphere captured and e unknown: the same with Phi(m / s).
///
/// Impacts that differ (`scatter` > 0): every impact has its own x = m + shift + scatter z with z
/// standard normal; it is captured if x < 0, else e = sqrt(x). With u = (m + shift) / scatter,
///   D = -2 (k ln Phi(-u) + (n - k) ln Phi(u)) + (e - sqrt(scatter) G(u))^2 / mean_sd^2,
/// with k captures among n impacts (effective numbers as above) and G of `root_of_positive_normal`:
/// the mean of the survivors is compared with its expectation, which lies above the curve close to
/// capture. The counts are omitted if captures were not counted, the mean if only counts are known.
///
/// Student's t (`student`): r becomes sign(r) c sqrt((nu + 1) ln(1 + r^2 / nu)), see StudentNoise.
WeightedResidual weighted_residual(const Observation& point, const PointWeights& weights,
                                   double restitution_squared,
                                   const std::optional<StudentNoise>& student = std::nullopt);

/// |dr / de| of the residual r at predicted e^2 = `restitution_squared`.
double slope_in_restitution(const WeightedResidual& residual, double restitution_squared);

/// Computes the `peak` of a point for its present weights, if its deviance has a minimum.
void locate_peak(const Observation& point, PointWeights& weights);

/// The deviance of a point with scatter (see above), without constant terms.
double event_deviance(const Observation& point, const PointWeights& weights,
                      double restitution_squared);

/// Mean and variance of r^2 of a point that only counts captures, over the binomial distribution of
/// its count at this prediction. With few impacts they differ much from the 1 and 2 of chi-squared.
struct CountMoments {
  double mean = 0.0;
  double variance = 0.0;
};
CountMoments count_moments(const Observation& point, const PointWeights& weights,
                           double restitution_squared);

/// Standard deviation of the mean e of the survivors of a point with scatter [1]: the stated or
/// estimated one, but at least the one that the scatter alone causes (a deviation that was computed
/// from two or three survivors is unreliable). For a single survivor the sd is the reading error,
/// and the scatter adds in quadrature.
double survivors_sd(const Observation& point, const PointWeights& weights,
                    double restitution_squared);

/// The expected mean e of the rebounds of this point if the model predicts `restitution_squared`:
/// its square root, or the mean of the survivors [1].
double expected_restitution(const Observation& point, const PointWeights& weights,
                            double restitution_squared);

/// One point of a simulated data set, and the weights of the point from which it was drawn with the
/// sd for its number of rebounds.
struct DrawnPoint {
  Observation point;
  PointWeights weights;
};

/// Redraws the captures of a point with scatter as the binomial quantile of `uniform` if the true
/// value is `restitution_squared`, and sets the sd for a mean of the remaining rebounds. The caller
/// sets the mean.
DrawnPoint redraw_captures(const Observation& point, const PointWeights& weights,
                           double restitution_squared, double uniform);

/// Simulates a new measurement of a point under its noise model if the true value is
/// `restitution_squared`:
/// - a mean of rebounds gets an e^2 shifted by input_sd z_1 and a mean about its square root with
///   the error sd `noise_scale` z_2 (a Student variate instead of z_2 with `student`), not below 0;
/// - with scatter, the captures are drawn from the binomial distribution and the survivors' mean
///   about its expectation, with the sd for their number; all impacts of a point may become
///   captured, or a captured point may rebound;
/// - a captured point without scatter stays captured.
/// Always draws three numbers from `random`.
DrawnPoint simulate_observation(const Observation& point, const PointWeights& weights,
                                double restitution_squared, double noise_scale,
                                const std::optional<StudentNoise>& student, RandomStream& random);

}  // namespace recoil
