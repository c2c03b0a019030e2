#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "estimate/least_squares.hpp"

namespace recoil {

/// The columns `moving` of the result's Jacobian [n x moving].
Eigen::MatrixXd columns_of(const LeastSquaresResult& result,
                           const std::vector<std::size_t>& moving);

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
