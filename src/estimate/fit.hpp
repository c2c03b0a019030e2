#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"
#include "estimate/start_search.hpp"
#include "estimate/weights.hpp"

namespace recoil {

/// How the scatter of the points compares with their stated standard deviations.
enum class NoiseVerdict {
  unchecked,  ///< no degrees of freedom are left, or the points do not scatter about the fit
  estimated,  ///< none are stated: the noise is estimated from the residuals
  explained,  ///< the standard deviations explain the scatter
  doubtful,   ///< p-value between 0.01 and 0.05: chance may explain the scatter
  exceeded,   ///< the scatter is larger: every error and interval is widened by
              ///< FitResult::noise_scale
};

/// Counts of captures that a fit does not use, because a mechanism, or the stated sizes, describe
/// how the impacts of a point differ.
struct UnusedCounts {
  const Mechanism* mechanism = nullptr;  ///< null: the stated sizes of the datasets
  int points = 0;
};

/// `input_bias` above which the effective variance of a point is strained, in standard deviations
/// of the point's e^2 [1].
inline constexpr double strained_bias = 0.1;

struct FitOptions {
  bool several_starts = true;
  std::vector<double> start;  ///< overrides the model's initial values when not empty
  LeastSquaresOptions minimiser;
  std::optional<Noise> noise;  ///< where the estimates of the noise start; empty: `first_noise`
  int threads = 0;  ///< 0: the caller's arena. Results do not depend on the number of threads.
};

/// The end of the descent to the least sum of squares.
struct FitEnd {
  bool usable = false;
  std::string failure;                         ///< the reason, and the point that caused it
  std::vector<double> theta;                   ///< [slots]
  std::vector<bool> at_bound;                  ///< [slots]
  DescentEnd ending = DescentEnd::minimum;     ///< end of the last descent: minimum, valley or flat
  Strategy strategy = Strategy::trust_region;  ///< strategy of the last descent
  /// Slots without effect on any point; their values are undetermined.
  std::vector<std::size_t> flat;
  std::vector<StartSummary> starts;
  std::size_t searched_points = 0;  ///< points on which the starts were compared, see `fit`
  /// Impacts of all descents that the fast solver handed to the reference.
  long handovers = 0;

  /// @pre usable
  const StartSummary& best_start() const;
};

/// The fit at each point.
struct FitAtPoints {
  std::vector<double> residuals;           ///< weighted residuals [points]
  std::vector<double> prediction;          ///< e at each point [1]
  std::vector<double> prediction_squared;  ///< e^2, continued below zero
  std::vector<double> leverage;            ///< diagonal of the hat matrix [points]
};

/// An error that the points determine.
enum class Estimated { noise, spread, setting };

/// The part of the covariance that an estimated error causes, and how well that error is known.
struct EstimatedPart {
  Estimated error = Estimated::noise;
  int dof = 0;                     ///< degrees of freedom of its estimate
  std::vector<double> covariance;  ///< [slots x slots]
};

/// The errors of the parameters.
struct FitErrors {
  std::vector<double> covariance;  ///< [slots x slots]; scaled by noise_scale^2
  /// The part of `covariance` that the uncertainty of event_spread adds; or empty.
  std::vector<double> spread_covariance;
  /// For constants that fits do not move: the change of theta when the constant is one standard
  /// deviation above its stated value [constant][slot]. `covariance` includes their outer products.
  std::vector<std::vector<double>> constant_effects;
  std::vector<double> std_error;  ///< [slots]; 0 for fixed ones and those at a bound
  std::vector<EstimatedPart> estimated;
  /// Degrees of freedom of the estimated error that has the fewest; 0: no error is estimated. For
  /// the quantiles of an interval see `degrees_of_freedom`.
  int quantile_dof = 0;
};

/// How the points agree with the fit.
struct FitQuality {
  double chi2 = 0.0;       ///< sum of squares under the stated weights, including the deviations of
                           ///< uncertain constants
  double objective = 0.0;  ///< sum of squares at the minimum; differs from chi2 if noise_scale !=
                           ///< 1, as the constants then have another weight
  int dof = 0;             ///< see Misfit
  double p_value = 0.0;    ///< of the misfit, in [0, 1]; meaningless if !sd_stated
  double criterion = 0.0;  ///< `restricted_criterion`
  double rmse = 0.0;       ///< root mean square of e - e_model over all points with a known e [1]
  /// Deviations of the uncertain material constants from their stated values, in standard
  /// deviations [ImpactModel::constants].
  std::vector<double> constants_moved;
  double noise_scale = 1.0;  ///< factor on the standard deviations of `data` in every interval; 1
                             ///< if they explain the scatter or this fit estimated them
  NoiseVerdict noise_verdict = NoiseVerdict::unchecked;
  int strained_points = 0;      ///< points with an input_bias above `strained_bias`
  bool weights_at_rest = true;  ///< false: the weights still changed in the last round
  std::optional<UnusedCounts> unused_counts;
};

struct FitResult;

/// The fit under one assumption about the error of the laws.
struct LawAlternative {
  LawErrorPrior prior;  ///< size 0: the laws are exact
  double weight = 0.0;  ///< its posterior probability; those of all add up to 1
  /// Null: the weight is negligible, or it is the result that has this alternative.
  std::shared_ptr<const FitResult> fitted;

  /// Is `result` the fit under this assumption?
  bool is_of(const FitResult& result) const;
};

/// The full least-squares fit.
struct FitResult : FitEnd, FitAtPoints, FitErrors, FitQuality {
  ImpactModel model;
  Observations data;  ///< the points that were fitted
  Weights weights;    ///< theirs in this fit; refits, profiles and simulations start from them
  /// What `fit_over_laws` compared; empty: the laws were taken as exact, or their error as known.
  std::vector<LawAlternative> laws;
};

/// Fits the free parameters of `model` to all points at once from several starts, then once more
/// together with the weights that depend on the fit (`reweighted_fit`). With more than 500 points
/// the descents from the starts use 250 to 374 of them, spread evenly over datasets, diameters and
/// velocities. The fit to all points continues from each of their minima that these points cannot
/// distinguish from the best.
FitResult fit(const ImpactModel& model, Observations data, const FitOptions& options = {});

/// Degrees of freedom of Student's t, whose quantiles turn the standard error of a quantity with
/// this gradient [slots] into an interval. With v its variance, and v_k the part of it that an
/// estimated error of nu_k degrees of freedom causes, v^2 / sum (v_k^2 / nu_k) (Satterthwaite 1946,
/// Biometrics Bull. 2, 110), rounded down. Stated errors, also those of constants and of the laws,
/// are known. 0: the quantiles are normal.
int degrees_of_freedom(const FitResult& fitted, std::span<const double> gradient);
/// The same for a slot.
int degrees_of_freedom(const FitResult& fitted, std::size_t slot);

/// The slots of C_H and C_A that rest on their upper bound.
std::vector<std::size_t> held_back_dampings(const FitResult& fitted);

/// Root mean square of e - e_model over the points whose index is in `subset` (all when empty);
/// captured points count with e = 0, and means of survivors are compared with
/// `expected_restitution`.
double root_mean_square(const ImpactModel& model, std::span<const double> theta,
                        const Observations& data, const Weights& weights,
                        const std::vector<std::size_t>& subset = {});

}  // namespace recoil
