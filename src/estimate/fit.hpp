#pragma once

#include <string>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"

namespace recoil {

/// One point as the estimator sees it.
struct Observation {
  std::size_t dataset = 0;
  std::size_t series = 0;
  double diameter = 0.0;     ///< [m]
  double velocity = 0.0;     ///< [m/s]
  double restitution = 0.0;  ///< e [1]
  double sd = 0.0;           ///< standard deviation of e [1] that weights this point
  bool censored = false;     ///< all spheres of this point were captured
};

/// All points of all datasets of a fit, ready to be fitted.
struct Observations {
  std::vector<Observation> points;
  bool sd_stated = true;  ///< false: the weights are relative, the noise is estimated from the fit
  std::vector<std::string> warnings;
};

/// Flattens the datasets. Where any point of the fit lacks a standard deviation, all points are
/// weighted equally and the noise level is estimated from the residuals (and this is said).
Observations gather(const std::vector<Dataset>& datasets);

/// The weighted residual of one point and its derivative with respect to the predicted e^2.
///
/// With y = e^2 - sigma^2 (unbiased for the square of the mean) and m the predicted e^2, continued
/// below zero for a capture,
///   r = (y - m) / (sigma sqrt((e + psi(m))^2 + 2 sigma^2)),
///   psi(m) = sqrt((m + sqrt(m^2 + sigma^4)) / 2).
/// Away from capture psi = sqrt(m) and r is (e - e_model) / sigma: the Gaussian residual, without
/// the bias of weights taken from noisy points. Through capture it stays smooth, and its variance
/// is that of e^2, 4 e^2 sigma^2 + 2 sigma^4 (the floor). A censored point contributes the Tobit
/// residual sqrt(-2 ln Phi(-m / (sqrt(2) sigma^2))), which vanishes where the model captures.
struct WeightedResidual {
  double value = 0.0;
  double slope = 0.0;  ///< d value / d m
};
WeightedResidual weighted_residual(const Observation& point, double restitution_squared);

/// Where one of several starts ended.
struct StartSummary {
  std::vector<double> start;
  std::vector<double> end;
  double chi2 = 0.0;
  bool converged = false;
  std::string message;
};

struct FitOptions {
  bool several_starts = true;
  std::vector<double> start;  ///< overrides the model's initial values when not empty
  LeastSquaresOptions minimiser;
};

/// The full least-squares fit.
struct FitResult {
  bool usable = false;
  std::string failure;  ///< why not, with the parameter or point that stood in the way
  ImpactModel model;
  std::vector<double> theta;               ///< [slots]
  std::vector<bool> at_bound;              ///< [slots]
  std::vector<double> covariance;          ///< [slots x slots]; scaled by noise_scale^2
  std::vector<double> std_error;           ///< [slots]; 0 for fixed ones and those at a bound
  std::vector<double> residuals;           ///< weighted, [points]
  std::vector<double> prediction;          ///< e at each point [1]
  std::vector<double> prediction_squared;  ///< e^2, continued below zero
  std::vector<double> leverage;            ///< diagonal of the hat matrix [points]
  double chi2 = 0.0;
  int dof = 0;               ///< points less free parameters; captured points that the model also
                             ///< captures do not count, as they cannot scatter
  double p_value = 0.0;      ///< of chi2; NaN-free: 0 or 1 at the ends; meaningless if !sd_stated
  double rmse = 0.0;         ///< of e over all points that rebounded [1]
  double noise_scale = 1.0;  ///< what the stated (or unit) sd is multiplied by in every interval
  std::string noise_text;    ///< why, in a sentence
  long handovers = 0;        ///< impacts that the fast solver left to the reference
  std::vector<StartSummary> starts;
  std::vector<std::string> warnings;
};

/// Fits the free parameters of `model` to all points at once from several starts.
FitResult fit(const ImpactModel& model, const Observations& data, const FitOptions& options = {});

/// Root mean square of e - e_model over the points whose index is in `subset` (all when empty);
/// captured points count with e = 0.
double root_mean_square(const ImpactModel& model, std::span<const double> theta,
                        const Observations& data, const std::vector<std::size_t>& subset = {});

}  // namespace recoil
