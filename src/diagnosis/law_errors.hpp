#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "diagnosis/candidate.hpp"
#include "diagnosis/discrepancy.hpp"

namespace recoil {

/// The error of the base model over the error of a mechanism's law [1].
inline constexpr double law_error_of_base = 0.3;

/// How wrong laws may be: no law of a mechanism, and no base model, is exact in nature. The effect
/// of every mechanism, Delta = e^2 with it - e^2 without it, is right but for a factor 1 + g(V, d),
/// g smooth (`smooth_functions`) and normal with mean 0 and standard deviation `mechanism`; the
/// loss of the base model, 1 - e^2, likewise with `base`. Bound to the effect, what is allowed to
/// be wrong is nothing where the law says that nothing happens: a discrepancy in the manner of
/// Kennedy & O'Hagan (2001, J. R. Stat. Soc. B 63, 425-464) that cannot stand for another cause.
struct LawErrors {
  double mechanism = 0.0;     ///< relative [1]
  double base = 0.0;          ///< relative [1]
  Eigen::MatrixXd functions;  ///< `smooth_functions` of the sample [points x rank]

  bool none() const { return !(mechanism > 0.0) && !(base > 0.0); }
  /// The errors of a part of the points.
  LawErrors of(const std::vector<std::size_t>& points) const;
};

/// What the laws' errors add to the weighted residuals of `data` under `theta`: U [points x errors]
/// of `Discrepancy`. Empty where the model has no answer.
std::optional<Eigen::MatrixXd> law_error_columns(const Candidate& candidate,
                                                 const Observations& data,
                                                 std::span<const double> theta,
                                                 const LawErrors& laws);

/// `refit`, which knows no errors of laws, seen under the covariance that they have there: nothing
/// moves.
Refit under_law_errors(const Candidate& candidate, const Observations& data, Refit refit,
                       const LawErrors& laws);

/// `refit` again, under the covariance that the laws' errors have there.
Refit with_law_errors(const Candidate& candidate, const Observations& data, Refit refit,
                      const LawErrors& laws);

}  // namespace recoil
