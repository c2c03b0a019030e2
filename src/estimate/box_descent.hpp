#pragma once

#include <span>
#include <vector>

#include "estimate/least_squares.hpp"

namespace recoil {

/// Levenberg-Marquardt within bounds, for few parameters: each step d minimises |r + J d|^2 + |D
/// d|^2 / radius within the bounds, where D holds the lengths of the columns of J. (A step that is
/// computed without bounds and then projected onto them decreases the sum of squares little, the
/// radius shrinks, and the descent moves slowly along the bound.) Fills the result except for the
/// members that `minimise` sets at the end. The options give the tolerances; a parameter at a bound
/// satisfies the Karush-Kuhn-Tucker conditions there.
/// @param fixed the parameters that keep their start values
LeastSquaresResult descend_in_box(const LeastSquaresProblem& problem, std::span<const double> start,
                                  const std::vector<bool>& fixed,
                                  const LeastSquaresOptions& options);

}  // namespace recoil
