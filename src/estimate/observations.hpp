#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/noise_spec.hpp"
#include "estimate/student.hpp"

namespace recoil {

/// The predicted e^2 at which one point is most likely, and the deviance D = -2 ln L there.
struct DeviancePeak {
  double at = 0.0;         ///< [1]
  double deviance = 0.0;   ///< D(at)
  double curvature = 0.0;  ///< D''(at), > 0
  double third = 0.0;      ///< D'''(at)
};

/// One point as the estimator sees it: what was measured, then what weights it.
struct Observation {
  std::size_t dataset = 0;
  std::size_t series = 0;
  double diameter = 0.0;     ///< [m]
  double velocity = 0.0;     ///< [m/s]
  double restitution = 0.0;  ///< mean e of the impacts that rebounded [1]
  double sd = 0.0;           ///< standard deviation of that mean [1]
  bool censored = false;     ///< all spheres of this point were captured

  int events = 1;                 ///< impacts, captured ones included
  int captured = 0;               ///< how many of them were captured
  bool counted = false;           ///< captures were counted: `captured = 0` is a measurement
  bool rebound_measured = false;  ///< e is the quotient of two velocities: it shares the error of V
  double velocity_sd = 0.0;       ///< [m/s]; 0: none
  double diameter_sd = 0.0;       ///< [m]; 0: none

  // Settled round by round at the parameters of the round before, see `reweigh`.
  double nearness = 0.0;    ///< (V* / V)^2, at most 1; only where the noise is estimated
  double input_sd = 0.0;    ///< sd of e^2 that the errors of V and d cause [1]
  double input_bias = 0.0;  ///< what the curvature of e^2 over these errors amounts to [1]
  double scatter = 0.0;     ///< sd of e^2 from impact to impact [1]; 0: not in use
  double shift = 0.0;       ///< mean e^2 of the impacts minus that of the mean impact [1]
  double mean_sd = 0.0;     ///< sd of the mean e with its share of input_sd, beside scatter [1]
  DeviancePeak peak;        ///< where scatter is in use and some sphere rebounded
  std::optional<StudentNoise> student;  ///< residuals are Student's t, not normal

  int rebounds() const { return events - captured; }
  /// Standard deviation of a single impact's e [1]: n independent impacts make a mean of sd.
  double event_sd() const;
};

/// One way to see the scatter of the points, and how well it does.
struct VarianceCandidate {
  VarianceFunction function = VarianceFunction::constant;
  double scale = 0.0;      ///< s of the function, for a single impact [1]
  double criterion = 0.0;  ///< -2 ln restricted likelihood: smaller is better
};

/// What weights the points of a fit.
struct NoiseModel {
  VarianceFunction variance = VarianceFunction::stated;
  double scale = 0.0;  ///< s of the function, for a single impact [1]; 0 when stated
  std::vector<VarianceCandidate> candidates;  ///< all that were tried, when it was chosen
  double event_spread = 0.0;  ///< relative sd of the capture velocity from impact to impact; 0
                              ///< where no point has both rebounds and captures
};

/// All points of all datasets of a fit, ready to be fitted.
struct Observations {
  std::vector<Observation> points;
  bool sd_stated = true;  ///< false: the noise is estimated from the residuals
  NoiseSpec spec;
  NoiseModel noise;
  std::vector<std::string> warnings;

  /// Must the weights be settled together with the parameters?
  bool weights_depend_on_fit() const;
};

/// Flattens the datasets. Where the standard deviations are not stated (or not to be used) the
/// weights are a first guess, one constant for every impact.
/// @throws InputError when `spec` insists on stated standard deviations and a point has none.
Observations gather(const std::vector<Dataset>& datasets, const NoiseSpec& spec = {});

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
/// Impacts that differ (`scatter` > 0): every impact has its own x = m + shift + scatter z, z
/// normal; x < 0 is captured, else e = sqrt(x). With u = (m + shift) / scatter,
///   D = -2 (k ln Phi(-u) + (n - k) ln Phi(u)) + (e - sqrt(scatter) G(u))^2 / mean_sd^2,
/// G of `root_of_positive_normal`: the mean of the survivors is compared with the expected mean of
/// survivors, which lies above the curve close to capture. The counts are left out where nobody
/// counted.
///
/// Student's t: r becomes sign(r) c sqrt((nu + 1) ln(1 + r^2 / nu)), see StudentNoise.
WeightedResidual weighted_residual(const Observation& point, double restitution_squared);

/// Finds `peak` of a point with scatter, for its present weights.
void locate_peak(Observation& point);

/// The deviance of a point with scatter (see above), constants left out.
double event_deviance(const Observation& point, double restitution_squared);

/// Standard deviation of the mean e of the survivors of a point with scatter [1]: its own, but no
/// less than what the scatter alone makes of so few (with two or three survivors a deviation stated
/// from their differences may be anything).
double survivors_sd(const Observation& point, double restitution_squared);

/// What the mean e of the rebounds of this point should be where the model predicts
/// `restitution_squared`: sqrt(e^2), or the mean of the survivors [1].
double expected_restitution(const Observation& point, double restitution_squared);

}  // namespace recoil
