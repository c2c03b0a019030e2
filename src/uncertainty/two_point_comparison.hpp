#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "estimate/fit.hpp"
#include "estimate/two_point.hpp"
#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// The compared methods of estimating the three parameters of the paper's model.
enum class CalibrationKind {
  two_point,     ///< the paper's iteration, with f0 of eq. 12 or of the fit file
  full,          ///< all points, with the same f0
  full_f0_free,  ///< all points, with f0 fitted
  fit,           ///< the fit itself, if constants and laws are not those of the other rows
};
constexpr auto names_of_values(CalibrationKind) {
  return name_list("two_point", "full", "full_f0_free", "fit");
}

/// The result of one method.
struct ComparisonRow {
  CalibrationKind row = CalibrationKind::two_point;
  std::vector<double> theta;   ///< [slots]; empty if the method failed
  std::string failure;         ///< reason of a failure
  std::optional<double> rmse;  ///< root mean square of e - e_model at all points of the dataset [1]
  /// The same at the diameters that the calibration did not use [1].
  std::optional<double> held_out_rmse;
  /// [slots], with exact constants and, if it is not fitted, exact f0; 0 for fixed parameters and
  /// those at a bound; empty for two points, if the noise is not known, or if J'J is singular.
  std::vector<double> standard_errors = {};
  bool noise_known = true;  ///< Noise::known of the fit
  bool headline = false;    ///< is it the fit whose parameters are reported?
};

/// Comparison of the two-point calibration with the fit to all points: both are calibrated on one
/// diameter and tested on the others.
struct TwoPointComparison {
  std::size_t dataset = 0;
  TwoPointResult result;
  double rmse = 0.0;                    ///< two-point calibration, all points of the dataset [1]
  std::optional<double> held_out_rmse;  ///< two-point calibration, on the other diameters [1]
  double full_rmse = 0.0;               ///< full fit, all points of the dataset [1]
  /// Full fit of that diameter alone, on the other diameters [1].
  std::optional<double> full_held_out_rmse;
  /// There is no held-out error of the full fit: the refit failed, or the dataset has one diameter.
  bool nothing_held_out = false;
  std::string refit_failure;        ///< failure of the full fit of that diameter alone
  long handovers = 0;               ///< FitResult::handovers of the fits for this comparison
  std::vector<ComparisonRow> rows;  ///< two points, all points, all points with f0 free
  std::vector<double> spread;       ///< sd of each slot over the replicates, two-point
  std::vector<double> full_spread;  ///< the same for the full fit
  int failed = 0;                   ///< replicates in which the two-point calibration failed
};

/// Compares both calibrations of one dataset, at its reference diameter. Leaves rows and spreads
/// empty.
TwoPointComparison compare_two_point(const FitResult& fitted, std::size_t dataset);

/// Compares both calibrations of every dataset, at its reference diameter. Empty without adhesion,
/// as there is then no C_A. Leaves the spreads empty.
std::vector<TwoPointComparison> compare_two_points(const FitResult& fitted);

/// Fills the rows: two points, all points with the same f0, all points with f0 fitted. The fit
/// itself is one of the last two and the headline; this fits the other.
void add_comparison_rows(const FitResult& fitted, std::vector<TwoPointComparison>& comparisons);

/// Adds the row of `fitted`, as the headline, to those of a fit with other constants or laws.
void add_headline_row(const FitResult& fitted, std::vector<TwoPointComparison>& comparisons);

/// Repeats the two-point iteration on the same resampled data as the replicates of `result` (the
/// first 999 of them), and adds its estimates to `result` and both spreads to `comparisons`.
void bootstrap_two_points(const FitResult& fitted, const UncertaintyOptions& options,
                          std::vector<TwoPointComparison>& comparisons, BootstrapResult& result);

}  // namespace recoil
