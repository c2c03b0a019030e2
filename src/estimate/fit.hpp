#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// How one of several starts ended.
enum class StartOutcome {
  best,           ///< at the smallest chi2
  same,           ///< at the same place as the best
  tie,            ///< with the same chi2 elsewhere, see StartSummary::differing
  worse,          ///< in a worse local minimum
  flat,           ///< where the points do not depend on a parameter
  not_converged,  ///< without an answer
};

/// Where one of several starts ended.
struct StartSummary {
  std::vector<double> start;
  std::vector<double> end;
  double chi2 = 0.0;
  DescentEnd ending = DescentEnd::no_answer;
  std::string message;  ///< the minimiser's own words
  StartOutcome outcome = StartOutcome::not_converged;
  std::vector<std::size_t> differing = {};  ///< of a tie: the slots whose values differ

  bool converged() const { return ending == DescentEnd::minimum || ending == DescentEnd::valley; }
};

/// What the scatter of the points says of the standard deviations that they state.
enum class NoiseVerdict {
  unchecked,  ///< there are as many parameters as points, or nothing scatters about the fit
  estimated,  ///< none are stated: the noise is estimated from the residuals
  explained,  ///< they explain the scatter
  doubtful,   ///< the scatter is at the edge of what chance makes of them
  exceeded,   ///< it is larger: every error and interval is widened by FitResult::noise_scale
};

/// Counts of captures that a fit does not use, as a mechanism says how the impacts of a point
/// differ.
struct UnusedCounts {
  const Mechanism* mechanism = nullptr;  ///< null: the sizes that the datasets state
  int points = 0;
};

/// Curvature over the errors of V and d from which on their effective variance is strained, in
/// standard deviations of the point's e^2.
inline constexpr double strained_bias = 0.1;

struct FitOptions {
  bool several_starts = true;
  std::vector<double> start;  ///< overrides the model's initial values when not empty
  LeastSquaresOptions minimiser;
  int threads = 0;  ///< 0: those of the caller. Many points fly on several; no digit depends on it.
};

/// The full least-squares fit.
struct FitResult {
  bool usable = false;
  std::string failure;  ///< for an error message: why not, and which point stood in the way
  ImpactModel model;
  Observations data;  ///< the points with the weights that belong to this fit: what every refit,
                      ///< profile and simulation starts from
  std::vector<double> theta;                   ///< [slots]
  std::vector<bool> at_bound;                  ///< [slots]
  DescentEnd ending = DescentEnd::minimum;     ///< of the last descent: minimum, valley or flat
  Strategy strategy = Strategy::trust_region;  ///< that led there
  std::vector<std::size_t>
      flat;  ///< slots on which no point depends there; their values mean nothing
  std::vector<double> covariance;         ///< [slots x slots]; scaled by noise_scale^2
  std::vector<double> spread_covariance;  ///< in it, what not knowing event_spread adds; or empty
  /// Of constants that fits do not move: [constant][slot] how far theta goes when the constant is
  /// one standard deviation above what is stated. Their squares are in `covariance`.
  std::vector<std::vector<double>> constant_effects;
  std::vector<double> std_error;           ///< [slots]; 0 for fixed ones and those at a bound
  std::vector<double> residuals;           ///< weighted, [points]
  std::vector<double> prediction;          ///< e at each point [1]
  std::vector<double> prediction_squared;  ///< e^2, continued below zero
  std::vector<double> leverage;            ///< diagonal of the hat matrix [points]
  double chi2 = 0.0;                       ///< sum of squares under the weights as stated, with the
                                           ///< deviations of uncertain constants
  double objective = 0.0;  ///< sum of squares at the minimum; differs from chi2 where the constants
                           ///< have another weight (noise_scale != 1)
  int dof = 0;             ///< see Misfit
  double p_value = 0.0;  ///< of the misfit; NaN-free: 0 or 1 at the ends; meaningless if !sd_stated
  /// How far the uncertain constants of the materials went from what is stated, in standard
  /// deviations [ImpactModel::constants].
  std::vector<double> constants_moved;
  double rmse = 0.0;         ///< of e over all points that rebounded [1]
  double noise_scale = 1.0;  ///< what the standard deviations of `data` are multiplied by in every
                             ///< interval: 1 where they hold, or were estimated by this fit
  /// Degrees of freedom of the Student's t whose quantiles make intervals of standard errors: of
  /// the estimated error that is known least. 0: nothing is estimated, and they are normal.
  int quantile_dof = 0;
  NoiseVerdict noise_verdict = NoiseVerdict::unchecked;
  int strained_points = 0;      ///< with an input_bias above `strained_bias`
  bool weights_at_rest = true;  ///< false: the weights still moved when their rounds ran out
  std::optional<UnusedCounts> unused_counts;
  long handovers = 0;  ///< impacts that the fast solver left to the reference
  std::vector<StartSummary> starts;
  std::size_t searched_points = 0;  ///< on which the starts were compared, see `fit`

  /// @pre usable
  const StartSummary& best_start() const;
};

/// Fits the free parameters of `model` to all points at once from several starts, then once more
/// together with the weights that depend on the fit (`reweighted_fit`). Of more than 500 points
/// the starts see 10,000, spread evenly over the datasets, diameters and velocities; where they
/// end, as far as these points cannot tell the ends apart, the fit to all points begins.
FitResult fit(const ImpactModel& model, Observations data, const FitOptions& options = {});

/// The dampings that rest on their upper bound: slots of C_H and C_A.
std::vector<std::size_t> held_back_dampings(const FitResult& fitted);

/// Root mean square of e - e_model over the points whose index is in `subset` (all when empty);
/// captured points count with e = 0, means of survivors beside `expected_restitution`.
double root_mean_square(const ImpactModel& model, std::span<const double> theta,
                        const Observations& data, const std::vector<std::size_t>& subset = {});

/// Where a start ended that may lead to the best fit.
struct StartLead {
  std::size_t start = 0;  ///< its place among the starts
  LeastSquaresResult run;
};

/// What the descents from several starts found.
struct StartSearch {
  std::vector<StartSummary> starts;
  std::size_t points = 0;  ///< that they saw
  bool sampled = false;    ///< these were drawn from very many
  /// The best of them, and where the points were sampled all that end elsewhere with a sum of
  /// squares that these points cannot tell from the smallest. None where no descent ended.
  std::vector<StartLead> leads;
  long handovers = 0;  ///< impacts that the fast solver left to the reference
};

/// Descends from `first` and, with `several`, from the places about it where other minima are
/// known to lie.
StartSearch search_from_starts(const ImpactModel& model, const Observations& data,
                               const std::vector<double>& first, bool several,
                               LeastSquaresOptions options);

/// A point without which the others fit.
struct OddPoint {
  std::size_t index = 0;  ///< among the observations
  double residual = 0.0;  ///< from what the others predict, in standard deviations
  FitResult without;      ///< the fit to the others
};

/// The point whose removal mends a fit. None unless more than one degree of freedom is left without
/// it, and it lies further from what the others predict than one of all points does in one of
/// twenty data sets (Bonferroni), by its residual r and leverage h: r / sqrt(1 - h) where standard
/// deviations are stated, else the externally studentised r / (s_(i) sqrt(1 - h)) (Cook & Weisberg
/// 1982, Residuals and Influence in Regression, section 2.2), at one of a hundred. Where they are
/// stated, the fit to all has to be rejected at 5 %, and the fit to the others not.
std::optional<OddPoint> odd_point(const FitResult& fitted);

}  // namespace recoil
