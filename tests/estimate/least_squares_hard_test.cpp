// The minimiser where fits go wrong: starts far away, valleys, bounds that act, parameters that
// the residuals cannot tell apart.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

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
  const LeastSquaresProblem problem = two_bounds_at_once();
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

/// y = a (1 - exp(-k x)), saturated wherever k is large: data that rise from 109 to 224.
LeastSquaresProblem saturated() {
  LeastSquaresProblem problem = unbounded(6, 2);
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    constexpr std::array<double, 6> x = {1, 2, 3, 5, 7, 10};
    constexpr std::array<double, 6> y = {109, 149, 149, 191, 213, 224};
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double rest = std::exp(-t[1] * x[i]);
      r[i] = t[0] * (1.0 - rest) - y[i];
      if (!std::isfinite(r[i])) return false;
      if (!j.empty()) {
        j[2 * i] = 1.0 - rest;
        j[2 * i + 1] = t[0] * x[i] * rest;
      }
    }
    return true;
  };
  return problem;
}

TEST(HardCases, FlatGroundIsNoMinimum) {
  // From there exp(-k x) is nothing but rounding; a alone finds its best value, the mean of y.
  for (const double far : {60.0, 200.0, 1e4}) {
    LeastSquaresProblem problem = saturated();
    const LeastSquaresResult result = minimise(problem, std::array{1.0, far});
    EXPECT_EQ(result.end, DescentEnd::flat) << far;
    EXPECT_FALSE(result.converged);
    EXPECT_TRUE(result.ended());
    EXPECT_EQ(result.flat, std::vector<std::size_t>{1});
    EXPECT_TRUE(result.covariance.empty());
    EXPECT_NEAR(result.theta[0], 172.5, 1e-3);
    // Bounds and logarithms do not hide it.
    problem.lower = {1e-3, 1e-3};
    problem.upper = {1e4, 1e5};
    EXPECT_EQ(minimise(problem, std::array{1.0, far}).end, DescentEnd::flat) << far;
    problem.log_scale = {true, true};
    EXPECT_EQ(minimise(problem, std::array{1.0, far}).end, DescentEnd::flat) << far;
  }
}

TEST(HardCases, ASmallEffectIsNoFlatGround) {
  // The second parameter moves the residuals, which are 1 and -1 by turns, by a millionth of them.
  LeastSquaresProblem problem = unbounded(8, 2);
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    for (std::size_t i = 0; i < 8; ++i) {
      const double x = static_cast<double>(i / 2) - 1.5;
      r[i] = t[0] - 3.0 + 1e-6 * x * (t[1] - 2.0) + (i % 2 == 0 ? 1.0 : -1.0);
      if (!j.empty()) {
        j[2 * i] = 1.0;
        j[2 * i + 1] = 1e-6 * x;
      }
    }
    return true;
  };
  const LeastSquaresResult result = minimise(problem, std::array{0.0, 0.0});
  EXPECT_EQ(result.end, DescentEnd::minimum) << result.message;
  EXPECT_NEAR(result.theta[1], 2.0, 1e-6);
  // var = 1 / (2e-12 sum of x^2 over four x) = 1 / (2e-12 * 5)
  ASSERT_FALSE(result.covariance.empty());
  EXPECT_NEAR(result.covariance[3] * 1e-11, 1.0, 1e-9);
}

TEST(HardCases, IterationsThatRanOutAreNoMinimum) {
  LeastSquaresOptions options;
  options.max_iterations = 3;
  const LeastSquaresResult result = minimise(saturated(), std::array{100.0, 0.1}, options);
  EXPECT_EQ(result.end, DescentEnd::limit) << result.message;
  EXPECT_FALSE(result.converged);
  EXPECT_FALSE(result.ended());
  EXPECT_TRUE(result.covariance.empty());
  EXPECT_GT(result.sum_of_squares, 1168.1);  // that of the minimum is 1168.009, see BoxBOD of NIST
}

TEST(HardCases, ADirectionThatIsLeftOpenIsAValley) {
  // y = a b exp(-x): only the product is known, 2.5.
  LeastSquaresProblem problem = unbounded(4, 2);
  problem.evaluate = [](std::span<const double> t, std::span<double> r, std::span<double> j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double decay = std::exp(-static_cast<double>(i));
      r[i] = (t[0] * t[1] - 2.5) * decay + (i == 3 ? 0.1 : 0.0) -
             (i == 0 ? 0.1 * std::exp(-3.0) : 0.0);
      if (!j.empty()) {
        j[2 * i] = t[1] * decay;
        j[2 * i + 1] = t[0] * decay;
      }
    }
    return true;
  };
  const LeastSquaresResult result = minimise(problem, std::array{1.0, 1.0});
  EXPECT_EQ(result.end, DescentEnd::valley) << result.message;
  EXPECT_TRUE(result.converged);
  EXPECT_TRUE(result.flat.empty());
  EXPECT_TRUE(result.covariance.empty());
  EXPECT_NEAR(result.theta[0] * result.theta[1], 2.5, 1e-9);
}

TEST(HardCases, TheFinishBringsTheLastDigits) {
  // The minimum where a and k are fitted as they are and as logarithms is one; the descent alone
  // stops at another digit of it.
  LeastSquaresProblem problem = saturated();
  LeastSquaresOptions descent_alone;
  descent_alone.finish = false;
  int evaluations = 0;
  problem.evaluate = [&evaluations, evaluate = problem.evaluate](auto t, auto r, auto j) {
    ++evaluations;
    return evaluate(t, r, j);
  };
  const LeastSquaresResult rough = minimise(problem, std::array{100.0, 0.75}, descent_alone);
  const int before = std::exchange(evaluations, 0);
  const LeastSquaresResult fine = minimise(problem, std::array{100.0, 0.75});
  EXPECT_LE(evaluations, before + 3);  // residuals of 10 % make it three Jacobians
  problem.lower = {1e-3, 1e-3};
  problem.log_scale = {true, true};
  const LeastSquaresResult logarithms = minimise(problem, std::array{50.0, 0.2});
  ASSERT_TRUE(rough.converged && fine.converged && logarithms.converged);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(logarithms.theta[k] / fine.theta[k], 1.0, 1e-12);
    EXPECT_NEAR(logarithms.covariance[3 * k] / fine.covariance[3 * k], 1.0, 1e-12);
    EXPECT_GT(std::abs(rough.theta[k] / fine.theta[k] - 1.0), 1e-10);
  }
}

}  // namespace
}  // namespace recoil
