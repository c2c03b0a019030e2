// The cost and the gain of Student's t, as stated and as simulated.
#include "estimate/student.hpp"

#include <gsl/gsl_integration.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/random.hpp"
#include "estimate/least_squares.hpp"

namespace recoil {
namespace {

/// Location of `values` (standard deviation 1 each) under Student's t.
LeastSquaresResult location(const std::vector<double>& values, const StudentNoise& student) {
  LeastSquaresProblem problem;
  problem.residual_count = values.size();
  problem.lower = {-std::numeric_limits<double>::infinity()};
  problem.upper = {std::numeric_limits<double>::infinity()};
  problem.log_scale = {false};
  problem.evaluate = [&](std::span<const double> t, std::span<double> r, std::span<double> j) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const WeightedResidual at = student.transformed({values[i] - t[0], -1.0});
      r[i] = at.value;
      if (!j.empty()) j[i] = at.slope;
    }
    return true;
  };
  return minimise(problem, std::array{0.0});
}

struct Spread {
  double mean_variance = 0.0;     // of the arithmetic mean
  double student_variance = 0.0;  // of the location under Student's t
  double claimed = 0.0;           // by its covariance
};

/// Data sets of 40 values, a share of them `factor` times as wide.
Spread simulate(const StudentNoise& student, double share, double factor) {
  constexpr int sets = 1500;
  constexpr int n = 40;
  Spread spread;
  for (int s = 0; s < sets; ++s) {
    RandomStream random(11, RandomPurpose::coverage, static_cast<std::uint64_t>(s));
    std::vector<double> values;
    double mean = 0.0;
    for (int i = 0; i < n; ++i) {
      const double width = random.uniform() < share ? factor : 1.0;
      values.push_back(width * random.normal());
      mean += values.back() / n;
    }
    const LeastSquaresResult fit = location(values, student);
    spread.mean_variance += mean * mean / sets;
    spread.student_variance += fit.theta[0] * fit.theta[0] / sets;
    spread.claimed += fit.covariance[0] * student.covariance_factor() / sets;
  }
  return spread;
}

TEST(Student, LargeDegreesOfFreedomAreNormal) {
  const StudentNoise student = student_noise(1000.0);
  EXPECT_NEAR(student.efficiency(), 1.0, 1e-4);
  EXPECT_NEAR(student.calibration(), 1.0, 1e-2);
  EXPECT_NEAR(student.transformed({2.5, -1.0}).value, 2.5, 1e-2);
}

TEST(Student, CauchyConstantsInClosedForm) {
  // nu = 1: psi = 2 r / (1 + r^2). With Mills' ratio q = Phi(-1) / phi(1): E 1/(1+z^2) = q and
  // E 1/(1+z^2)^2 = 1/2 (by parts), so E psi' = E 2 (1 - z^2) / (1 + z^2)^2
  // = E [4/(1+z^2)^2 - 2/(1+z^2)] = 2 - 2 q and E psi^2 = 4 E [1/(1+z^2) - 1/(1+z^2)^2] = 4 q - 2.
  const double q = 0.5 * std::erfc(std::sqrt(0.5)) / (std::exp(-0.5) / std::sqrt(2.0 * M_PI));
  const StudentNoise student = student_noise(1.0);
  EXPECT_NEAR(student.mean_slope, 2.0 - 2.0 * q, 1e-10);
  EXPECT_NEAR(student.mean_square, 4.0 * q - 2.0, 1e-10);
}

TEST(Student, TransformationIsSmoothAndHasAnInverse) {
  const StudentNoise student = student_noise(4.0);
  for (const double r : {-30.0, -1.0, -1e-9, 0.0, 1e-5, 0.3, 2.0, 50.0}) {
    const WeightedResidual at = student.transformed({r, 1.0});
    EXPECT_NEAR(student.original(at.value), r, 1e-9 * (1.0 + std::abs(r)));
    constexpr double h = 1e-4;
    const double difference =
        (student.transformed({r + h, 1.0}).value - student.transformed({r - h, 1.0}).value) /
        (2.0 * h);
    EXPECT_NEAR(at.slope, difference, 1e-6) << r;
  }
}

/// Made with scipy: the sum of D by stats.gamma with moments by quadrature, the largest residual by
/// stats.t, the core by root finding.
TEST(Student, TheMisfitGrowsWithOutliers) {
  const StudentNoise student = student_noise(4.0);
  std::vector<double> one(12, 0.5);
  one.back() = 33.0;
  EXPECT_NEAR(student.p_value(one, 10) / 8.246702107e-05, 1.0, 1e-6);
  std::vector<double> five(12, 0.5);
  std::copy_n(std::array{25.0, 28.0, 30.0, 31.0, 33.0}.begin(), 5, five.begin() + 7);
  EXPECT_NEAR(student.p_value(five, 10) / 3.812228448e-17, 1.0, 1e-5);
  const std::vector<double> usual = {0.2, -0.4, 0.6, -0.8, 1.0, -1.2, 1.4, -1.6};
  EXPECT_NEAR(student.p_value(usual, 6), 0.6134480868, 1e-6);
}

TEST(Student, CostsWhatItSaysUnderNormalNoise) {
  const StudentNoise student = student_noise(4.0);
  EXPECT_GT(student.efficiency(), 0.85);
  EXPECT_LT(student.efficiency(), 0.97);
  const Spread spread = simulate(student, 0.0, 1.0);
  // The ratio of two variances from the same 1500 samples: uncertain by about 1.5 %.
  EXPECT_NEAR(spread.mean_variance / spread.student_variance, student.efficiency(), 0.05);
  EXPECT_NEAR(spread.claimed / spread.student_variance, 1.0, 0.1);
}

TEST(Student, IsBetterThanTheMeanUnderOutliers) {
  const Spread spread = simulate(student_noise(4.0), 0.1, 3.0);
  EXPECT_GT(spread.mean_variance, 1.1 * spread.student_variance);
}

}  // namespace
}  // namespace recoil
