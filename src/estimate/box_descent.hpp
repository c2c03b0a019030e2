#pragma once

#include <span>
#include <vector>

#include "estimate/least_squares.hpp"

namespace recoil {

/// Levenberg-Marquardt within bounds, for few parameters: every step d minimises
/// |r + J d|^2 + |D d|^2 / radius, D the lengths of the columns of J, over the d that stay within
/// the bounds. A step that is computed without them and then cut off is no step of the method any
/// more: it leads down a little, the radius shrinks, and the descent creeps along the bound.
/// Fills all of the result but what `minimise` adds at the end. The tolerances are those of the
/// options; a parameter at a bound satisfies the Karush-Kuhn-Tucker conditions there.
/// @param fixed the parameters that stay where they start
LeastSquaresResult descend_in_box(const LeastSquaresProblem& problem, std::span<const double> start,
                                  const std::vector<bool>& fixed,
                                  const LeastSquaresOptions& options);

}  // namespace recoil
