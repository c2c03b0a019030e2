#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "estimate/fit.hpp"
#include "estimate/two_point.hpp"
#include "uncertainty/information.hpp"

namespace recoil {

/// [lower, upper] in the parameter's unit, or the reason why there is none.
struct Interval {
  std::optional<double> lower;
  std::optional<double> upper;
  std::string why;    ///< set when there is no interval
  std::string shape;  ///< of a profile: "bounded", "one-sided", "flat"

  bool available() const { return lower.has_value() && upper.has_value(); }
};

/// Every interval of one parameter, at one level.
struct IntervalSet {
  Interval wald, profile, percentile, bca, studentized;
  std::string recommended;      ///< which one: "profile", "bca", ...
  std::string recommended_why;  ///< by which rule
};

/// The replicates of one bootstrap, in replicate order whatever the thread count.
struct BootstrapResult {
  std::string scheme;  ///< "parametric" or "residual", and why
  std::string scheme_why;
  int replicates = 0;
  int failed = 0;
  std::uint64_t seed = 0;
  std::vector<std::vector<double>> theta;             ///< usable replicates [count][slots]
  std::vector<std::vector<double>> std_error;         ///< of each replicate [count][slots], 0: none
  std::vector<std::vector<double>> capture_velocity;  ///< [count][diameters], per CaptureEstimate
  std::vector<int> two_point_failed;  ///< [datasets] replicates in which it did not converge
  /// [datasets][converged replicates][slots]
  std::vector<std::vector<std::vector<double>>> two_point_theta;
};

/// The capture velocity of one (dataset, diameter).
struct CaptureEstimate {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double value = 0.0;     ///< [m/s]
  bool found = false;
  Interval interval;  ///< percentile of the bootstrap
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
  double level = 0.95;
  std::uint64_t seed = 20260101;
  int threads = 0;  ///< 0: all cores. No digit depends on it.
  bool profile = true;
  bool curves = true;
  bool two_point = true;  ///< compare with the paper's calibration; without it the list is empty
};

struct UncertaintyResult {
  UncertaintyOptions options;
  std::vector<IntervalSet> intervals;  ///< [slots]
  BootstrapResult bootstrap;
  std::vector<CaptureEstimate> capture;
  std::vector<RestitutionCurve> curves;
  std::vector<TwoPointComparison> two_point;  ///< one per dataset, unless it was not asked for
  Identifiability identifiability;
  std::vector<std::string> warnings;
};

/// Everything that follows a fit: bootstrap, intervals, capture velocities, bands, two-point
/// spread.
UncertaintyResult assess_uncertainty(const FitResult& fitted, const Observations& data,
                                     const std::vector<Dataset>& datasets,
                                     const UncertaintyOptions& options);

}  // namespace recoil
