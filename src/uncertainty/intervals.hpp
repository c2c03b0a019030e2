#pragma once

#include <optional>
#include <span>
#include <vector>

#include "uncertainty/uncertainty.hpp"

namespace recoil {

/// The p-quantile of an ascending sample by the (B + 1) p rule with linear interpolation (Davison &
/// Hinkley 1997, section 5.2.1), clamped to the sample.
double sorted_quantile(std::span<const double> ascending, double p);

/// Percentile interval of bootstrap replicates (Efron 1979).
Interval percentile_interval(std::vector<double> replicates, double level);

/// Constants of the BCa interval (Efron 1987, JASA 82, 171-185).
struct BcaConstants {
  double bias = 0.0;          ///< z0 = Phi^-1( fraction of replicates below the estimate )
  double acceleration = 0.0;  ///< a = sum d^3 / (6 (sum d^2)^(3/2)), d = mean - delete-one value
};

/// Ties with the estimate count one half each. Nothing when all replicates lie on one side.
std::optional<BcaConstants> bca_constants(std::span<const double> replicates, double estimate,
                                          std::span<const double> delete_one);

/// Bias-corrected and accelerated interval.
Interval bca_interval(std::vector<double> replicates, double estimate,
                      std::span<const double> delete_one, double level);

/// Studentised (bootstrap-t) interval (Davison & Hinkley 1997, section 5.2.1):
///   [estimate - s t*_(1-a), estimate - s t*_(a)],  t* = (replicate - estimate) / s*,
/// cut at the bounds.
/// @param replicate_errors s* of each replicate; 0 where it has none, and the replicate is left out
Interval studentized_interval(std::span<const double> replicates,
                              std::span<const double> replicate_errors, double estimate,
                              double std_error, double level, double lower, double upper);

/// estimate +- quantile * std_error, cut at the bounds.
/// @param dof degrees of freedom of the estimated noise; 0: the noise is known (normal quantile)
Interval wald_interval(double estimate, double std_error, double level, int dof, double lower,
                       double upper);

}  // namespace recoil
