#pragma once

#include <limits>

#include "estimate/least_squares.hpp"

namespace recoil {

constexpr double infinity = std::numeric_limits<double>::infinity();

inline LeastSquaresProblem unbounded(std::size_t residuals, std::size_t parameters) {
  LeastSquaresProblem problem;
  problem.residual_count = residuals;
  problem.lower.assign(parameters, -infinity);
  problem.upper.assign(parameters, infinity);
  problem.log_scale.assign(parameters, false);
  return problem;
}

}  // namespace recoil
