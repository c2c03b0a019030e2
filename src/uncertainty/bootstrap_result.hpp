#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "estimate/fit_spec.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {

/// Which data made refits fail.
struct FailedReplicates {
  struct Suspect {
    std::size_t point = 0;        ///< index into the observations
    double failed = 0.0;          ///< mean disturbance of the point in the replicates that failed
    double usual = 0.0;           ///< and in the others
    bool clearly_unlike = false;  ///< by more than three standard errors of a mean
  };
  std::vector<std::uint64_t> index;  ///< of every failed replicate, ascending
  bool undetermined = false;  ///< the first ended by itself, but its points do not determine all
                              ///< that is free
  std::string message;        ///< else the minimiser's words in it
  std::vector<Suspect> suspects;  ///< the points most unlike the others, the worst first
};

/// The replicates of one bootstrap, in replicate order whatever the thread count.
struct BootstrapResult {
  Scheme scheme = Scheme::parametric;  ///< never automatic
  SchemeBecause because = SchemeBecause::asked_for;
  std::size_t series = 0;  ///< that the scheme exchanges, where it does
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

  /// Have so many refits failed that a reader has to know (more than one in a hundred)?
  bool failed_often() const { return failed > 0.01 * replicates; }
  /// So many that those that did not fail are no fair sample (more than a tenth)?
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
