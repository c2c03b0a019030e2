#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "estimate/least_squares.hpp"

namespace recoil {

/// The triangular factor R of A [n x q], with |A x| = |R x| for every x, by sequential QR
/// factorisation: the factor of the first rows, then of this factor and the next rows, and so on.
/// @param rows gives `count` rows of A from the row `first` on
Eigen::MatrixXd triangular_factor(
    Eigen::Index n, Eigen::Index q,
    const std::function<Eigen::MatrixXd(Eigen::Index first, Eigen::Index count)>& rows);

/// The columns `moving` of the result's Jacobian J, and its residuals r as the last column [m x
/// (moving + 1)]. Many rows are reduced to few (m < n) by `triangular_factor`, which preserves
/// every |r + J d|.
Eigen::MatrixXd linearised_rows(const LeastSquaresResult& result,
                                const std::vector<std::size_t>& moving);

/// Finds a minimum near `start` by Gauss-Newton steps d = -(J'J)^-1 J'r, combined as in
/// `finish_by_gauss_newton`. The last step is taken without an evaluation (the residuals are
/// extrapolated linearly). The iteration ends if the remaining error is below
/// `options.close_enough` standard errors of every parameter; with `options.finish` it ends as
/// `finish_by_gauss_newton` does.
/// @return nullopt if a step is longer than half the step before, if one leaves the bounds, if the
///   sum of squares grows or if J is singular: `start` is then too far from the minimum
std::optional<LeastSquaresResult> gauss_newton_from(const LeastSquaresProblem& problem,
                                                    std::span<const double> start,
                                                    const std::vector<bool>& fixed,
                                                    const LeastSquaresOptions& options);

/// Refines a minimum that a descent found, to the last digit. The descent stops when the sum of
/// squares does not change, which determines only half of the digits of theta. Gauss-Newton steps d
/// = -(J'J)^-1 J'r vanish at the minimum and determine all of them. The steps shrink by a constant
/// ratio, which is not small if the residuals are large; from the second step on they are combined
/// to cancel their differences (Anderson 1965, J. ACM 12, 547-560). The iteration ends when the
/// steps do not change theta or stop shrinking. It leaves `result` unchanged if J is singular, if a
/// step leaves the bounds or if the sum of squares grows.
/// @param moving the parameters that are neither fixed nor held by a bound
void finish_by_gauss_newton(const LeastSquaresProblem& problem,
                            const std::vector<std::size_t>& moving, LeastSquaresResult& result);

}  // namespace recoil
