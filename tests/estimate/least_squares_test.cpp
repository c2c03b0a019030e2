// The minimiser on problems whose answers are known without it.
#include "estimate/least_squares.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "small_problem.hpp"

namespace recoil {
namespace {

/// y = a + b x on five points; the normal equations are solved by hand below.
LeastSquaresProblem straight_line() {
  LeastSquaresProblem problem = unbounded(5, 2);
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    const std::array<double, 5> x = {0, 1, 2, 3, 4};
    const std::array<double, 5> y = {1, 3, 2, 5, 4};
    for (std::size_t i = 0; i < 5; ++i) {
      r[i] = y[i] - t[0] - t[1] * x[i];
      if (!j.empty()) {
        j[2 * i] = -1.0;
        j[2 * i + 1] = -x[i];
      }
    }
    return true;
  };
  return problem;
}

TEST(LeastSquares, StraightLine) {
  // Sxx = 10, Sxy = 8, means 2 and 3: slope 0.8, intercept 1.4, sum of squares 3.6.
  const LeastSquaresResult result = minimise(straight_line(), std::array{10.0, -7.0});
  ASSERT_TRUE(result.converged) << result.message;
  EXPECT_NEAR(result.theta[0], 1.4, 1e-9);
  EXPECT_NEAR(result.theta[1], 0.8, 1e-9);
  EXPECT_NEAR(result.sum_of_squares, 3.6, 1e-9);
  // (X'X)^-1 = [[30, -10], [-10, 5]] / 50
  const std::array<double, 4> expected = {0.6, -0.2, -0.2, 0.1};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(result.covariance[k], expected[k], 1e-9);
}

TEST(LeastSquares, ParameterAtItsBound) {
  LeastSquaresProblem problem = straight_line();
  problem.upper[1] = 0.5;  // the best intercept with slope 0.5 is 3 - 0.5 * 2 = 2
  const LeastSquaresResult result = minimise(problem, std::array{0.0, 0.0});
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.theta[0], 2.0, 1e-6);
  EXPECT_EQ(result.theta[1], 0.5);
  EXPECT_FALSE(result.at_bound[0]);
  EXPECT_TRUE(result.at_bound[1]);
  EXPECT_NEAR(result.covariance[0], 0.2, 1e-9);  // 1/n, the slope being fixed
  EXPECT_EQ(result.covariance[3], 0.0);
}

TEST(LeastSquares, FixedParameterStays) {
  LeastSquaresProblem problem = straight_line();
  problem.fixed = {false, true};
  const LeastSquaresResult result = minimise(problem, std::array{0.0, 1.0});
  EXPECT_EQ(result.theta[1], 1.0);
  EXPECT_NEAR(result.theta[0], 1.0, 1e-8);
}

TEST(LeastSquares, LogarithmicScaleFindsTheSameMinimum) {
  LeastSquaresProblem problem = straight_line();
  problem.lower = {1e-6, 1e-6};
  problem.log_scale = {true, true};
  const LeastSquaresResult result = minimise(problem, std::array{100.0, 1e-3});
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.theta[0], 1.4, 1e-7);
  EXPECT_NEAR(result.theta[1], 0.8, 1e-7);
  EXPECT_NEAR(result.covariance[3], 0.1, 1e-7);
}

TEST(LeastSquares, Rosenbrock) {
  LeastSquaresProblem problem = unbounded(2, 2);
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    r[0] = 10.0 * (t[1] - t[0] * t[0]);
    r[1] = 1.0 - t[0];
    if (!j.empty()) {
      j[0] = -20.0 * t[0];
      j[1] = 10.0;
      j[2] = -1.0;
      j[3] = 0.0;
    }
    return true;
  };
  const LeastSquaresResult result = minimise(problem, std::array{-1.2, 1.0});
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.theta[0], 1.0, 1e-8);
  EXPECT_NEAR(result.theta[1], 1.0, 1e-8);
}

TEST(LeastSquares, RedundantParametersHaveNoCovariance) {
  LeastSquaresProblem problem = unbounded(3, 2);
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    for (std::size_t i = 0; i < 3; ++i) {
      r[i] = t[0] + t[1] - static_cast<double>(i);
      if (!j.empty()) j[2 * i] = j[2 * i + 1] = 1.0;
    }
    return true;
  };
  const LeastSquaresResult result = minimise(problem, std::array{0.0, 0.0});
  EXPECT_NEAR(result.theta[0] + result.theta[1], 1.0, 1e-6);
  EXPECT_TRUE(result.covariance.empty());
}

TEST(LeastSquares, RefusedEvaluationIsAFailureNotACrash) {
  LeastSquaresProblem problem = unbounded(1, 1);
  problem.evaluate = [](auto, auto, auto) { return false; };
  const LeastSquaresResult result = minimise(problem, std::array{1.0});
  EXPECT_FALSE(result.converged);
  EXPECT_FALSE(result.message.empty());
}

}  // namespace
}  // namespace recoil
