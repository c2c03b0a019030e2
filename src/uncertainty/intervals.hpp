#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/statistics.hpp"
#include "uncertainty/interval.hpp"

namespace recoil {

/// Percentile interval of bootstrap replicates (Efron 1979).
Interval percentile_interval(std::vector<double> replicates, double level);

/// The constants of the BCa interval. Ties with the estimate count one half each. Nullopt if all
/// replicates lie on one side of the estimate.
std::optional<BcaConstants> bca_constants(std::span<const double> replicates, double estimate,
                                          std::span<const double> delete_one);

/// The level at which BCa takes the quantile of the replicates instead of p:
///   Phi( z0 + w / (1 - a w) ),  w = z0 + Phi^-1(p).
/// Nullopt if a w >= 1: the acceleration is too large for this level.
std::optional<double> bca_level(const BcaConstants& constants, double p);

/// Bias-corrected and accelerated interval. Its Monte-Carlo error includes that z0 is estimated
/// from the same replicates.
Interval bca_interval(std::vector<double> replicates, double estimate,
                      std::span<const double> delete_one, double level);

/// Studentised (bootstrap-t) interval (Davison & Hinkley 1997, section 5.2.1):
///   [estimate - s t*_(1-a), estimate - s t*_(a)],  t* = (replicate - estimate) / s*,
/// cut at the bounds.
/// @param replicate_errors s* of each replicate; replicates with 0 (no standard error) are omitted
Interval studentized_interval(std::span<const double> replicates,
                              std::span<const double> replicate_errors, double estimate,
                              double std_error, double level, double lower, double upper);

/// The distribution function of Student's t and its inverse; normal for dof 0.
double student_probability(double x, int dof);
double student_quantile(double p, int dof);

/// estimate +- quantile * std_error, cut at the bounds.
/// @param dof degrees of freedom of the estimated noise; 0: the noise is known (normal quantile)
Interval wald_interval(double estimate, double std_error, double level, int dof, double lower,
                       double upper);

/// The estimate under one of several noise models, for `averaged_wald_interval`.
struct WaldTerm {
  double weight = 1.0;
  double estimate = 0.0;
  double std_error = 0.0;  ///< 0: at a bound; omitted unless it is the first
  int dof = 0;             ///< as in `wald_interval`
};

/// The Wald interval averaged over noise models. Its ends solve
///   sum_k w_k P_k((x - estimate_k) / std_error_k) = (1 -+ level) / 2,  sum_k w_k = 1,
/// with P_k Student's distribution function (normal for dof 0), so that the tail areas are
/// averaged, not the ends (Turek & Fletcher 2012, Comput. Stat. Data Anal. 56, 2809-2815). With one
/// term it equals `wald_interval`.
/// @param terms the first is the chosen one; without its error there is no interval
Interval averaged_wald_interval(std::span<const WaldTerm> terms, double level, double lower,
                                double upper);

/// The rise of chi2 / s^2 at which a profile interval ends, for a value that lies `distance`
/// standard errors inside the parameter's bound.
///
/// Far from the bound it is the quantile of chi-squared with one degree of freedom, or of F(1, dof)
/// if the noise is estimated. Near it, the estimate cannot exceed the bound: the likelihood ratio
/// is a mixture of chi-squared distributions, and the coverage of the usual quantile would be too
/// high (up to (1 + level) / 2 on the bound). For a Gaussian estimate with the bound at zero, chi2
/// rises by more than c when x - theta > sqrt(c), or theta - x > (c + d^2) / (2 d), and
///   P(sqrt(c)) - P(-(c + d^2) / (2 d)) = level
/// gives every theta exactly the coverage `level` (P: distribution function, normal or Student; d:
/// distance). On the bound c is the chi-bar-squared quantile, P^-1(level)^2. Feldman & Cousins
/// (1998), Phys. Rev. D 57, 3873, section IV.B; Self & Liang (1987), J. Am. Stat. Assoc. 82,
/// 605-610.
/// @param dof 0: the noise is known
double profile_quantile(double level, int dof, double distance);

/// The sandwich covariance, which is valid for unequal scatter of the points without a noise model:
/// C J' diag(r^2 / (1 - h)^2) J C with C = (J'J)^-1, "HC3" (MacKinnon & White 1985, J. Econometrics
/// 29, 305-325) [p x p].
/// @param residuals r [n]
/// @param jacobian J [n x p, row major]
/// @param covariance C [p x p]; zero rows for parameters that are not free
std::vector<double> sandwich_covariance(std::span<const double> residuals,
                                        std::span<const double> jacobian,
                                        std::span<const double> covariance);

}  // namespace recoil
