#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "estimate/fit_spec.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {

/// The data that made refits fail.
struct FailedReplicates {
  struct Suspect {
    std::size_t point = 0;        ///< index into the observations
    double failed = 0.0;          ///< mean perturbation of the point in the replicates that failed
    double usual = 0.0;           ///< its mean perturbation in the others
    bool clearly_unlike = false;  ///< the means differ by more than three standard errors
  };
  std::vector<std::uint64_t> index;  ///< every failed replicate, ascending
  bool undetermined = false;  ///< the first failed refit converged, but its points do not determine
                              ///< all free parameters
  std::string message;        ///< otherwise the message of the minimiser in that refit
  std::vector<Suspect> suspects;  ///< the points with the largest differences, the largest first
};

/// The replicates of one bootstrap, in the order of their index: one member for each number of a
/// replicate, and for each count.
struct BootstrapResult {
  Scheme scheme = Scheme::parametric;  ///< never automatic
  SchemeBecause because = SchemeBecause::asked_for;
  std::size_t series = 0;  ///< number of series that the cluster scheme draws
  int replicates = 0;
  int failed = 0;
  FailedReplicates failures;
  std::uint64_t seed = 0;
  /// Standard errors of the fit, computed as for the replicates: from the covariance, or (wild,
  /// case, cluster) from the sandwich covariance, which allows unequal scatter [slots].
  std::vector<double> reference_error;
  /// The largest Monte-Carlo error of an interval end over the width of its interval, see
  /// `bootstrap` [1]; nullopt without intervals.
  std::optional<double> relative_error;
  std::vector<std::vector<double>> theta;  ///< usable replicates [count][slots]
  /// Standard errors of each replicate [count][slots], 0: none.
  std::vector<std::vector<double>> std_error;
  /// V* [m/s] [count][diameters], in the order of the CaptureEstimates.
  std::vector<std::vector<double>> capture_velocity;
  /// Standard error of ln V* [count][diameters], 0: none.
  std::vector<std::vector<double>> capture_error;
  /// Standard error of ln V* of the fit itself [diameters].
  std::vector<double> capture_reference_error;
  int two_point_replicates = 0;       ///< number of first replicates with a two-point calibration
  std::vector<int> two_point_failed;  ///< [datasets] number of these in which it did not converge
  /// [datasets][converged replicates][slots]
  std::vector<std::vector<std::vector<double>>> two_point_theta;

  /// Did more than 1 % of the refits fail, so that a reader must know?
  bool failed_often() const { return failed > 0.01 * replicates; }
  /// Did more than 10 % fail, so that the others are not a fair sample?
  bool withheld() const { return failed > 0.10 * replicates; }
};

/// The finite values of column j of `rows`.
inline std::vector<double> finite_column(const std::vector<std::vector<double>>& rows,
                                         std::size_t j) {
  std::vector<double> values;
  for (const std::vector<double>& row : rows) {
    if (j < row.size() && std::isfinite(row[j])) values.push_back(row[j]);
  }
  return values;
}

}  // namespace recoil
