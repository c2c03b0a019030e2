#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "diagnosis/candidate.hpp"
#include "diagnosis/discrepancy.hpp"

namespace recoil {

/// The error of the base model relative to the error of a mechanism's law [1].
inline constexpr double law_error_of_base = 0.3;

/// The allowed errors of laws: no law of a mechanism, and no base model, is exact. The effect of
/// every mechanism, Delta = e^2 with it - e^2 without it, has an unknown factor 1 + g(V, d), with g
/// smooth (`smooth_functions`) and normal with mean 0 and standard deviation `mechanism`. The loss
/// of the base model, 1 - e^2, has such a factor with the standard deviation `base`. As the error
/// is proportional to the effect, it vanishes where the law predicts no effect. This is a
/// discrepancy in the sense of Kennedy & O'Hagan (2001, J. R. Stat. Soc. B 63, 425-464) that cannot
/// imitate another cause.
struct LawErrors {
  double mechanism = 0.0;     ///< relative [1]
  double base = 0.0;          ///< relative [1]
  Eigen::MatrixXd functions;  ///< `smooth_functions` of the sample [points x rank]

  bool none() const { return !(mechanism > 0.0) && !(base > 0.0); }
  /// The errors of the laws for a subset of the points.
  LawErrors of(const std::vector<std::size_t>& points) const;
};

/// The errors of the laws in the weighted residuals of `data` at `theta`: U [points x errors] of
/// `Discrepancy`. Nullopt if an impact cannot be solved.
std::optional<Eigen::MatrixXd> law_error_columns(const Candidate& candidate,
                                                 const Observations& data, const Weights& weights,
                                                 std::span<const double> theta,
                                                 const LawErrors& laws);

/// `refit`, which was made without errors of laws, evaluated under their covariance at its
/// parameters, which do not change.
Refit under_law_errors(const Candidate& candidate, const Observations& data, const Weights& weights,
                       Refit refit, const LawErrors& laws);

/// `refit`, repeated under the covariance of the laws' errors at its parameters.
Refit with_law_errors(const Candidate& candidate, const Observations& data, const Weights& weights,
                      Refit refit, const LawErrors& laws);

}  // namespace recoil
