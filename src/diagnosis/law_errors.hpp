#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "diagnosis/candidate.hpp"
#include "diagnosis/discrepancy.hpp"
#include "estimate/law_average.hpp"

namespace recoil {

/// The error of the base model relative to the error of a mechanism's law, if that is stated [1].
inline constexpr double law_error_of_base = 0.3;

/// The error of the law of a mechanism, if none is stated [1]. Published laws of one cause differ
/// by about as much.
inline constexpr double usual_law_error = 0.1;

/// The smallest size of the error of the base model: no cause is accused of a misfit that such an
/// error explains [1].
inline constexpr double least_law_error = 0.03;

/// The largest size of this error: what a larger one would explain, has a cause [1].
inline constexpr double largest_law_error_of_base = 0.12;

/// The allowed errors of laws: no law of a mechanism, and no base model, is exact. The effect of
/// every mechanism, Delta = e^2 with it - e^2 without it, has an unknown factor 1 + g(V, d), with g
/// smooth (`smooth_functions`) and normal with mean 0 and standard deviation `mechanism`. The loss
/// of the base model, 1 - e^2, has such a factor with the standard deviation s. As the error is
/// proportional to the effect, it vanishes where the law predicts no effect. This is a discrepancy
/// in the sense of Kennedy & O'Hagan (2001, J. R. Stat. Soc. B 63, 425-464) that cannot imitate
/// another cause.
///
/// The size s is not assumed: every explanation, with a cause or without, is averaged over the
/// sizes that a fit averages over (`sizes_of_law_error`), from `least_law_error` to
/// `largest_law_error_of_base`. So a cause competes with an error of the laws.
struct LawErrors {
  std::vector<LawErrorSize> sizes;     ///< s with its prior probability, ascending
  Eigen::MatrixXd functions;           ///< `smooth_functions` of the sample [points x rank]
  double mechanism = usual_law_error;  ///< relative error of the law of a mechanism [1]

  /// Does `candidate` have an error if that of its base model has the size `size`?
  bool act(const Candidate& candidate, double size) const {
    return size > 0.0 || (mechanism > 0.0 && !candidate.model.chain.empty());
  }
  /// The errors of the laws for a subset of the points.
  LawErrors of(const std::vector<std::size_t>& points) const;
};

/// The errors that a diagnosis allows.
/// @param stated error of the law of a mechanism [1]; empty: averaged over
LawErrors allowed_law_errors(std::optional<double> stated, const Observations& data);

/// The errors of the laws, `size` for the base model, in the weighted residuals of `data` at
/// `theta`: U [points x errors] of `Discrepancy`. Nullopt if an impact cannot be solved.
std::optional<Eigen::MatrixXd> law_error_columns(const Candidate& candidate,
                                                 const Observations& data, const Weights& weights,
                                                 std::span<const double> theta,
                                                 const LawErrors& laws, double size);

/// `refit`, which was made with exact laws, repeated under the covariance of errors of one size at
/// its parameters.
Refit refit_with_law_error(const Candidate& candidate, const Observations& data,
                           const Weights& weights, Refit refit, const LawErrors& laws, double size);

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
