#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "estimate/fit.hpp"
#include "estimate/point_conditions.hpp"
#include "estimate/scheme.hpp"
#include "estimate/two_point.hpp"
#include "uncertainty/information.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/two_point_pairs.hpp"

namespace recoil {

/// One point of a profile likelihood.
struct ProfilePoint {
  double value = 0.0;    ///< of the parameter [its unit]
  double rise = 0.0;     ///< of chi2 over its minimum, the others refitted, in units of s^2 [1]
  double allowed = 0.0;  ///< the rise at which the interval would end here [1]
};

/// Every interval of one parameter, at one level.
struct IntervalSet {
  Interval wald, profile, percentile, bca, studentized;
  std::string recommended;                  ///< which one: "profile", "bca", ...
  std::string recommended_why;              ///< by which rule
  std::vector<ProfilePoint> profile_curve;  ///< empty unless `curves` were asked for
  std::string disagreement;  ///< why the kinds differ, one sentence; empty when they agree
  /// Numbers that the sentence rests on.
  std::optional<BcaConstants> bca_constants;
  std::optional<double> bound_share;  ///< of the usable replicates that rest on a bound [1]
};

/// Which data made refits fail.
struct FailedReplicates {
  struct Suspect {
    std::size_t point = 0;  ///< index into the observations
    double failed = 0.0;    ///< mean disturbance of the point in the replicates that failed
    double usual = 0.0;     ///< and in the others
  };
  std::vector<std::uint64_t> index;  ///< of every failed replicate, ascending
  std::string message;               ///< the minimiser's words in the first of them
  std::vector<Suspect> suspects;     ///< the points most unlike the others, the worst first
  std::string text;                  ///< all of it in a sentence; empty when none failed
};

/// The replicates of one bootstrap, in replicate order whatever the thread count.
struct BootstrapResult {
  std::string scheme;      ///< "parametric", "residual", "wild", "case" or "cluster"
  std::string scheme_why;  ///< asked for, or by which rule, and what it does
  int replicates = 0;
  int failed = 0;
  FailedReplicates failures;
  std::uint64_t seed = 0;
  /// Standard errors of the fit made as those of the replicates: from the covariance, or (wild,
  /// case, cluster) by the sandwich that holds for unequal scatter [slots].
  std::vector<double> reference_error;
  /// The largest Monte-Carlo error of a percentile, recommended or capture end over the width of
  /// its interval [1]; none without intervals.
  std::optional<double> relative_error;
  std::vector<std::vector<double>> theta;             ///< usable replicates [count][slots]
  std::vector<std::vector<double>> std_error;         ///< of each replicate [count][slots], 0: none
  std::vector<std::vector<double>> capture_velocity;  ///< [count][diameters], per CaptureEstimate
  std::vector<std::vector<double>> capture_error;     ///< of ln V* [count][diameters], 0: none
  std::vector<double> capture_reference_error;        ///< of ln V* of the fit itself [diameters]
  int two_point_replicates = 0;  ///< the first of them also ran the two-point iteration
  std::vector<int>
      two_point_failed;  ///< [datasets] of those, replicates in which it did not converge
  /// [datasets][converged replicates][slots]
  std::vector<std::vector<std::vector<double>>> two_point_theta;
};

/// The capture velocity of one (dataset, diameter).
struct CaptureEstimate {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double value = 0.0;     ///< [m/s]
  bool found = false;
  Interval delta;        ///< V* exp(+- q sd(ln V*)), sd by the covariance and d V* / d theta; q of
                         ///< Student, averaged over the variance functions, where the noise is
                         ///< estimated
  Interval percentile;   ///< of the bootstrap
  Interval studentized;  ///< of ln V*, errors by its gradient in every replicate
  Interval interval;     ///< the recommended one of the three
  std::string recommended;      ///< "delta", "percentile" or "studentized"
  std::string recommended_why;  ///< by which rule
};

/// One curve e(V) of a diameter with its pointwise band.
struct RestitutionCurve {
  std::size_t dataset = 0;
  std::string series;
  double diameter = 0.0;             ///< [m]
  std::vector<double> velocity;      ///< [m/s]
  std::vector<double> restitution;   ///< full fit [1]
  std::vector<double> lower, upper;  ///< band of the full fit [1]; empty without a bootstrap
  std::vector<double> two_point;     ///< the two-point calibration [1]; empty when it failed
  std::size_t series_number = PointConditions::no_series;  ///< of `series` in its dataset
};

/// Two points against all: both calibrated on one diameter, both judged on the others.
struct TwoPointComparison {
  std::size_t dataset = 0;
  TwoPointResult result;
  double rmse = 0.0;                         ///< of the two-point calibration, all points [1]
  std::optional<double> held_out_rmse;       ///< on the diameters that it did not see [1]
  double full_rmse = 0.0;                    ///< of the full fit, all points of the dataset [1]
  std::optional<double> full_held_out_rmse;  ///< full fit of that diameter alone, on the others
  std::string held_out_why;                  ///< when there are no others
  std::vector<double> spread;                ///< sd of each slot under resampling, two-point
  std::vector<double> full_spread;           ///< the same of the full fit
  int failed = 0;                            ///< replicates without a two-point answer
};

/// What the data can tell about the parameters.
struct Identifiability {
  std::string verdict;          ///< "identifiable", "partly" or "not_identifiable"
  std::string text;             ///< which parameter, why, and what to measure
  std::vector<bool> parameter;  ///< [slots] identifiable on its own
  Information information;      ///< what the points know, direction by direction
};

struct UncertaintyOptions {
  int replicates = 1999;
  /// Add batches until every percentile and recommended end has a Monte-Carlo error below
  /// `wanted_error` of its interval's width, from 999 on and up to 19999. `replicates` is not used.
  bool replicates_auto = false;
  double wanted_error = 0.02;
  Scheme scheme = Scheme::automatic;
  double level = 0.95;
  std::uint64_t seed = 20260101;
  int threads = 0;  ///< 0: all cores. No digit depends on it.
  bool profile = true;
  bool curves = true;     ///< restitution curves with bands, and those of the profiles
  bool capture = true;    ///< intervals of the capture velocities
  bool two_point = true;  ///< compare with the paper's calibration; without it the list is empty
  /// Simulated data sets on which every pair of points is tried (`study_two_point_pairs`), at most
  /// as many as replicates; none without `two_point`.
  int pair_simulations = 199;
  /// Where finished replicates are kept when the user stops the run, and looked for by the next run
  /// of the same fit; empty: nowhere. The file is left behind; whoever has written the results
  /// removes it.
  std::filesystem::path keep;
  std::string keep_key;  ///< what else the replicates depend on: the program that makes them
};

struct UncertaintyResult {
  UncertaintyOptions options;
  std::vector<IntervalSet> intervals;  ///< [slots]
  BootstrapResult bootstrap;
  std::vector<CaptureEstimate> capture;
  std::vector<RestitutionCurve> curves;
  std::vector<TwoPointComparison> two_point;  ///< one per dataset, unless it was not asked for
  std::vector<PairStudy> pairs;  ///< one per dataset with a pair of points, unless not asked for
  Identifiability identifiability;
  std::vector<std::string> warnings;
};

/// Everything that follows a fit: bootstrap, intervals, capture velocities, bands, two-point
/// spread.
UncertaintyResult assess_uncertainty(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                     const UncertaintyOptions& options);

}  // namespace recoil
