#pragma once

#include <algorithm>
#include <limits>
#include <span>

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

/// Minimise (a - 3)^2 + (b + 2)^2 + (a + b + c)^2 with a <= 1, b >= 0: a = 1, b = 0, c = -1.
inline LeastSquaresProblem two_bounds_at_once() {
  LeastSquaresProblem problem = unbounded(3, 3);
  problem.upper[0] = 1.0;
  problem.lower[1] = 0.0;
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    r[0] = t[0] - 3.0;
    r[1] = t[1] + 2.0;
    r[2] = t[0] + t[1] + t[2];
    if (!j.empty()) {
      std::fill(j.begin(), j.end(), 0.0);
      j[0] = j[4] = j[6] = j[7] = j[8] = 1.0;
    }
    return true;
  };
  return problem;
}

}  // namespace recoil
