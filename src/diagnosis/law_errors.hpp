#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "diagnosis/candidate.hpp"
#include "diagnosis/discrepancy.hpp"
#include "estimate/law_average.hpp"

namespace recoil {

/// The error of the base model relative to the error of a mechanism's law [1].
inline constexpr double law_error_of_base = 0.3;

/// The allowed errors of laws: no law of a mechanism, and no base model, is exact. The loss of the
/// base model, 1 - e^2, has an unknown factor 1 + g(V, d), with g smooth (`smooth_functions`) and
/// normal with mean 0 and standard deviation s. The effect of every mechanism, Delta = e^2 with it
/// - e^2 without it, has such a factor with the standard deviation s / `law_error_of_base`, as laws
/// of mechanisms are less well tested. As the error is proportional to the effect, it vanishes
/// where the law predicts no effect. This is a discrepancy in the sense of Kennedy & O'Hagan (2001,
/// J. R. Stat. Soc. B 63, 425-464) that cannot imitate another cause.
///
/// Its size s is not assumed: every explanation, with a cause or without, is averaged over the
/// sizes that a fit averages over (`sizes_of_law_error`). So a cause competes with an error of the
/// laws.
struct LawErrors {
  std::vector<LawErrorSize> sizes;  ///< s with its prior probability, ascending
  Eigen::MatrixXd functions;        ///< `smooth_functions` of the sample [points x rank]
};

/// The errors that a diagnosis allows.
/// @param stated error of the law of a mechanism [1]; empty: averaged over
LawErrors allowed_law_errors(std::optional<double> stated, const Observations& data);

/// The errors of the laws of size `size` in the weighted residuals of `data` at `theta`: U [points
/// x errors] of `Discrepancy`. Nullopt if an impact cannot be solved.
std::optional<Eigen::MatrixXd> law_error_columns(const Candidate& candidate,
                                                 const Observations& data, const Weights& weights,
                                                 std::span<const double> theta,
                                                 const Eigen::MatrixXd& functions, double size);

/// `refit`, which was made with exact laws, repeated under the covariance of errors of one size at
/// its parameters.
Refit refit_with_law_error(const Candidate& candidate, const Observations& data,
                           const Weights& weights, Refit refit, const Eigen::MatrixXd& functions,
                           double size);

/// A fit averaged over the errors of the laws.
struct RefitOverLaws {
  Refit refit;                  ///< under the likeliest size, which it states
  double criterion = INFINITY;  ///< -2 ln of the mean of exp(-`corrected_criterion` / 2)
  double first_chi2 = 0.0;      ///< chi2 under the smallest size
};

/// `refit`, which was made with exact laws, repeated under every size of error.
RefitOverLaws refit_over_laws(const Candidate& candidate, const Observations& data,
                              const Weights& weights, const Refit& refit, const LawErrors& laws);

/// The same at the parameters of `refit`, which do not change.
RefitOverLaws screen_over_laws(const Candidate& candidate, const Observations& data,
                               const Weights& weights, const Refit& refit, const LawErrors& laws);

}  // namespace recoil
