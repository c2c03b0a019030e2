#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "estimate/fit.hpp"
#include "estimate/two_point.hpp"
#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// Why nothing is held out in a comparison, or not by both.
enum class NothingHeldOut {
  single_diameter,  ///< the dataset has no other
  refit_failed,     ///< the full fit of the calibrated diameter alone
};
template <>
struct NamesOf<NothingHeldOut> {
  static constexpr std::array<std::string_view, 2> names = {"single_diameter", "refit_failed"};
};

/// Ways to the three parameters of the paper's model, compared with one another.
enum class ComparisonWay {
  two_point,     ///< the paper's iteration, f0 of eq. 12 or of the fit file
  full,          ///< all points, f0 the same
  full_f0_free,  ///< all points, f0 fitted
};
template <>
struct NamesOf<ComparisonWay> {
  static constexpr std::array<std::string_view, 3> names = {"two_point", "full", "full_f0_free"};
};

/// One of them.
struct ComparisonRow {
  ComparisonWay row = ComparisonWay::two_point;
  std::vector<double> theta;            ///< [slots]; empty without an answer
  std::string failure;                  ///< why there is none
  std::optional<double> rmse;           ///< of e at all points of the dataset [1]
  std::optional<double> held_out_rmse;  ///< on the diameters that the calibration did not see [1]
  /// [slots], the constants and an f0 that is not fitted taken as exact; empty for two points.
  std::vector<double> standard_errors = {};
};

/// Two points against all: both calibrated on one diameter, both judged on the others.
struct TwoPointComparison {
  std::size_t dataset = 0;
  TwoPointResult result;
  double rmse = 0.0;                         ///< of the two-point calibration, all points [1]
  std::optional<double> held_out_rmse;       ///< on the diameters that it did not see [1]
  double full_rmse = 0.0;                    ///< of the full fit, all points of the dataset [1]
  std::optional<double> full_held_out_rmse;  ///< full fit of that diameter alone, on the others
  std::optional<NothingHeldOut> nothing_held_out;
  std::string refit_failure;        ///< of the full fit of that diameter alone
  std::vector<ComparisonRow> rows;  ///< two points, all points, all points with f0 free
  std::vector<double> spread;       ///< sd of each slot under resampling, two-point
  std::vector<double> full_spread;  ///< the same of the full fit
  int failed = 0;                   ///< replicates without a two-point answer
};

/// Both calibrations of one dataset, at its reference diameter. Rows and spreads stay empty.
TwoPointComparison compare_two_point(const FitResult& fitted, std::size_t dataset);

/// Both calibrations of every dataset, at its reference diameter. Empty without adhesion, where
/// there is no C_A. The spreads stay empty.
std::vector<TwoPointComparison> compare_two_points(const FitResult& fitted);

/// Fills the rows: two points, all points with the same f0, all points with f0 fitted. The fit
/// itself is one of the last two; the other is fitted here.
void add_comparison_rows(const FitResult& fitted, std::vector<TwoPointComparison>& comparisons);

/// Repeats the two-point iteration on the same resampled data as the replicates of `result` (the
/// first 999 of them), and adds its answers to `result` and both spreads to `comparisons`.
void bootstrap_two_points(const FitResult& fitted, const UncertaintyOptions& options,
                          std::vector<TwoPointComparison>& comparisons, BootstrapResult& result);

}  // namespace recoil
