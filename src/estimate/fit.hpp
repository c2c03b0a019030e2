#pragma once

#include <string>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"

namespace recoil {

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
  Observations data;  ///< the points with the weights that belong to this fit: what every refit,
                      ///< profile and simulation starts from
  std::vector<double> theta;               ///< [slots]
  std::vector<bool> at_bound;              ///< [slots]
  std::vector<double> covariance;          ///< [slots x slots]; scaled by noise_scale^2
  std::vector<double> spread_covariance;   ///< in it, what not knowing event_spread adds; or empty
  std::vector<double> std_error;           ///< [slots]; 0 for fixed ones and those at a bound
  std::vector<double> residuals;           ///< weighted, [points]
  std::vector<double> prediction;          ///< e at each point [1]
  std::vector<double> prediction_squared;  ///< e^2, continued below zero
  std::vector<double> leverage;            ///< diagonal of the hat matrix [points]
  double chi2 = 0.0;
  int dof = 0;           ///< see Misfit
  double p_value = 0.0;  ///< of the misfit; NaN-free: 0 or 1 at the ends; meaningless if !sd_stated
  double rmse = 0.0;     ///< of e over all points that rebounded [1]
  double noise_scale = 1.0;  ///< what the standard deviations of `data` are multiplied by in every
                             ///< interval: 1 where they hold, or were estimated by this fit
  std::string noise_text;    ///< what was taken as noise and why, in sentences with semicolons
  long handovers = 0;        ///< impacts that the fast solver left to the reference
  std::vector<StartSummary> starts;
  std::vector<std::string> warnings;
};

/// Fits the free parameters of `model` to all points at once from several starts, then settles the
/// weights that depend on the fit (`settle`).
FitResult fit(const ImpactModel& model, const Observations& data, const FitOptions& options = {});

/// Root mean square of e - e_model over the points whose index is in `subset` (all when empty);
/// captured points count with e = 0, means of survivors beside `expected_restitution`.
double root_mean_square(const ImpactModel& model, std::span<const double> theta,
                        const Observations& data, const std::vector<std::size_t>& subset = {});

}  // namespace recoil
