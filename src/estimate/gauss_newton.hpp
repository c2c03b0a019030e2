#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "estimate/least_squares.hpp"

namespace recoil {

/// The columns `moving` of the result's Jacobian and its residuals, [m x (moving + 1)]: as they
/// are, or where there are many by orthogonal transformations of some rows at a time brought to few
/// (m < n), which leaves every |r + J d| as it is.
Eigen::MatrixXd linearised_rows(const LeastSquaresResult& result,
                                const std::vector<std::size_t>& moving);

/// A minimum that lies near `start`, by the steps d = -(J'J)^-1 J'r of Gauss and Newton, combined
/// as below. It ends where the last step, which is taken without an evaluation (the residuals
/// follow it linearly), leaves less than `options.close_enough` of any parameter's standard error;
/// with `options.finish` where `finish_by_gauss_newton` ends.
/// @return nothing where the steps do not shrink to a half each, where one leaves the bounds, where
/// the sum of squares grows or J is singular: then the way is too long for it
std::optional<LeastSquaresResult> gauss_newton_from(const LeastSquaresProblem& problem,
                                                    std::span<const double> start,
                                                    const std::vector<bool>& fixed,
                                                    const LeastSquaresOptions& options);

/// Takes a minimum that a descent found to the last digit. The descent stops where the sum of
/// squares does, which is flat there and knows half of the digits; the steps d = -(J'J)^-1 J'r of
/// Gauss and Newton vanish at the minimum and know all of them. They shrink by a constant ratio,
/// which is not small where the residuals are large; from the second on they are combined so that
/// the differences among them cancel (Anderson 1965, J. ACM 12, 547-560). It ends where the steps
/// do not move theta any more or stop shrinking, and leaves `result` as it is where J is singular,
/// where a step leaves the bounds or where the sum of squares grows.
/// @param moving the parameters that are neither fixed nor held by a bound
void finish_by_gauss_newton(const LeastSquaresProblem& problem,
                            const std::vector<std::size_t>& moving, LeastSquaresResult& result);

}  // namespace recoil
