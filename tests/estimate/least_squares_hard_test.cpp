// The minimiser where fits go wrong: starts far away, valleys, bounds that act, parameters that
// the residuals cannot tell apart.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "small_problem.hpp"

namespace recoil {
namespace {

/// y = a exp(-k x) without noise.
LeastSquaresProblem decay(double a, double k) {
  LeastSquaresProblem problem = unbounded(8, 2);
  problem.evaluate = [=](std::span<const double> t, std::span<double> r, std::span<double> j) {
    for (std::size_t i = 0; i < 8; ++i) {
      const double x = static_cast<double>(i);
      const double model = t[0] * std::exp(-t[1] * x);
      r[i] = model - a * std::exp(-k * x);
      if (!std::isfinite(r[i])) return false;
      if (!j.empty()) {
        j[2 * i] = std::exp(-t[1] * x);
        j[2 * i + 1] = -x * model;
      }
    }
    return true;
  };
  return problem;
}

TEST(HardCases, FarStartInLogarithms) {
  LeastSquaresProblem problem = decay(3.0, 0.4);
  problem.lower = {1e-9, 1e-9};
  problem.log_scale = {true, true};
  for (const std::array<double, 2> start :
       {std::array{0.3, 0.1}, std::array{1.0, 0.02}, std::array{0.3, 1.0}, std::array{1e2, 0.02},
        std::array{1e3, 1.0}, std::array{1e5, 1e-4}}) {
    const LeastSquaresResult result = minimise(problem, start);
    ASSERT_TRUE(result.converged) << result.message;
    EXPECT_NEAR(result.theta[0], 3.0, 1e-6) << "from " << start[0] << ", " << start[1];
    EXPECT_NEAR(result.theta[1], 0.4, 1e-6) << "from " << start[0] << ", " << start[1];
  }
}

TEST(HardCases, PowellSingularFunctionEndsInItsFlatMinimum) {
  // Powell (1962); More, Garbow & Hillstrom (1981), ACM Trans. Math. Softw. 7, 17-41, problem 13:
  // the Jacobian is singular at the minimum, which lies at the origin with sum of squares 0.
  LeastSquaresProblem problem = unbounded(4, 4);
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    const double u = t[1] - 2.0 * t[2];
    const double v = t[0] - t[3];
    r[0] = t[0] + 10.0 * t[1];
    r[1] = std::sqrt(5.0) * (t[2] - t[3]);
    r[2] = u * u;
    r[3] = std::sqrt(10.0) * v * v;
    if (j.empty()) return true;
    std::fill(j.begin(), j.end(), 0.0);
    j[0] = 1.0;
    j[1] = 10.0;
    j[6] = std::sqrt(5.0);
    j[7] = -std::sqrt(5.0);
    j[9] = 2.0 * u;
    j[10] = -4.0 * u;
    j[12] = 2.0 * std::sqrt(10.0) * v;
    j[15] = -2.0 * std::sqrt(10.0) * v;
    return true;
  };
  const LeastSquaresResult result = minimise(problem, std::array{3.0, -1.0, 0.0, 1.0});
  EXPECT_LT(result.sum_of_squares, 1e-10);
  for (const double t : result.theta) EXPECT_NEAR(t, 0.0, 1e-2);
}

TEST(HardCases, NearlyRedundantColumnsStillHaveTheirCovariance) {
  // Columns (1, 1 + d x): J'J by hand. With x = -1, 0, 1: sum 1 = 3, sum (1 + d x) = 3,
  // sum (1 + d x)^2 = 3 + 2 d^2, determinant 6 d^2, so var(b) = 3 / (6 d^2) = 1 / (2 d^2).
  constexpr double d = 1e-4;
  LeastSquaresProblem problem = unbounded(3, 2);
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = static_cast<double>(i) - 1.0;
      r[i] = t[0] + t[1] * (1.0 + d * x) - (2.0 + 3.0 * (1.0 + d * x));
      if (!j.empty()) {
        j[2 * i] = 1.0;
        j[2 * i + 1] = 1.0 + d * x;
      }
    }
    return true;
  };
  const LeastSquaresResult result = minimise(problem, std::array{0.0, 0.0});
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.theta[1], 3.0, 1e-4);
  ASSERT_FALSE(result.covariance.empty());
  EXPECT_NEAR(result.covariance[3] * 2.0 * d * d, 1.0, 1e-5);
}

TEST(HardCases, TwoBoundsActAtOnce) {
  // Minimise (a - 3)^2 + (b + 2)^2 + (a + b + c)^2 with a <= 1, b >= 0: a = 1, b = 0, c = -1.
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
  const LeastSquaresResult result = minimise(problem, std::array{0.0, 5.0, 7.0});
  ASSERT_TRUE(result.converged);
  EXPECT_EQ(result.theta[0], 1.0);
  EXPECT_EQ(result.theta[1], 0.0);
  EXPECT_NEAR(result.theta[2], -1.0, 1e-6);
  EXPECT_TRUE(result.at_bound[0] && result.at_bound[1] && !result.at_bound[2]);
  EXPECT_NEAR(result.covariance[8], 1.0, 1e-9);
  EXPECT_EQ(result.covariance[0], 0.0);
}

TEST(HardCases, LeavesABoundThatItStartedOn) {
  LeastSquaresProblem problem = decay(3.0, 0.4);
  problem.lower = {0.0, 0.0};
  const LeastSquaresResult result = minimise(problem, std::array{0.0, 0.0});
  ASSERT_TRUE(result.converged) << result.message;
  EXPECT_NEAR(result.theta[0], 3.0, 1e-6);
  EXPECT_NEAR(result.theta[1], 0.4, 1e-6);
  EXPECT_FALSE(result.at_bound[0] || result.at_bound[1]);
}

TEST(HardCases, StepsBackFromWhereThereIsNoAnswer) {
  // sqrt(t) - 0.1 has no answer below 0; Gauss-Newton from 4 would step to -3.6.
  LeastSquaresProblem problem = unbounded(1, 1);
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    if (!(t[0] > 0.0)) return false;
    r[0] = std::sqrt(t[0]) - 0.1;
    if (!j.empty()) j[0] = 0.5 / std::sqrt(t[0]);
    return true;
  };
  const LeastSquaresResult result = minimise(problem, std::array{4.0});
  ASSERT_TRUE(result.converged) << result.message;
  EXPECT_NEAR(result.theta[0], 0.01, 1e-7);
}

}  // namespace
}  // namespace recoil
