// Interval formulas against cases worked by hand.
#include "uncertainty/intervals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace recoil {
namespace {

std::vector<double> one_to(int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

TEST(Percentile, OfAThousandNineHundredNinetyNine) {
  const Interval interval = percentile_interval(one_to(1999), 0.95);
  EXPECT_NEAR(*interval.lower, 50.0, 1e-9);
  EXPECT_NEAR(*interval.upper, 1950.0, 1e-9);
}

TEST(Percentile, NeedsEnoughReplicates) {
  const Interval interval = percentile_interval(one_to(20), 0.95);
  EXPECT_FALSE(interval.available());
  EXPECT_EQ(interval.missing, NoInterval::few_replicates);
}

TEST(Bca, ConstantsByHand) {
  // Two of five below the estimate: z0 = Phi^-1(0.4) = -0.253347. Delete-one values 1, 2, 6: mean
  // 3, d = 2, 1, -3, sum d^3 = 8 + 1 - 27 = -18, sum d^2 = 14: a = -18 / (6 * 14^1.5) = -0.0572703.
  const auto constants =
      bca_constants(std::vector<double>{1, 2, 3, 4, 5}, 2.5, std::vector<double>{1, 2, 6});
  ASSERT_TRUE(constants);
  EXPECT_NEAR(constants->bias, -0.2533471031, 1e-9);
  EXPECT_NEAR(constants->acceleration, -18.0 / (6.0 * std::pow(14.0, 1.5)), 1e-12);
}

TEST(Bca, TiesCountOneHalf) {
  const auto constants =
      bca_constants(std::vector<double>{1, 2, 3}, 2.0, std::vector<double>{1, 1});
  ASSERT_TRUE(constants);
  EXPECT_NEAR(constants->bias, 0.0, 1e-15);
  EXPECT_EQ(constants->acceleration, 0.0);
}

TEST(Bca, WithoutBiasAndAccelerationItIsThePercentileInterval) {
  const std::vector<double> values = one_to(1999);
  const Interval bca = bca_interval(values, 1000.0, std::vector<double>{1, 2, 3}, 0.95);
  EXPECT_NEAR(*bca.lower, 50.0, 1e-6);
  EXPECT_NEAR(*bca.upper, 1950.0, 1e-6);
}

TEST(Bca, AtABoundThereIsNone) {
  const Interval interval =
      bca_interval(std::vector<double>(100, 1.0), 0.5, std::vector<double>{1, 2, 3}, 0.95);
  EXPECT_FALSE(interval.available());
  EXPECT_EQ(interval.missing, NoInterval::one_sided_replicates);
}

TEST(Bca, WithoutWhatItNeedsThereIsNone) {
  const std::vector<double> one_left_out = {1, 2, 3};
  const auto missing = [](const Interval& interval) {
    EXPECT_FALSE(interval.available());
    EXPECT_FALSE(interval.contains(2.0));
    return interval.missing;
  };
  EXPECT_EQ(missing(bca_interval({}, 2.0, one_left_out, 0.95)), NoInterval::few_replicates);
  EXPECT_EQ(missing(bca_interval(one_to(20), 2.0, one_left_out, 0.95)), NoInterval::few_replicates);
  EXPECT_EQ(missing(bca_interval(one_to(99), 2.0, std::vector<double>{1, 2}, 0.95)),
            NoInterval::few_delete_one_refits);
  EXPECT_EQ(missing(bca_interval(one_to(99), 100.0, one_left_out, 0.95)),
            NoInterval::one_sided_replicates);
}

TEST(AnInterval, WithOneEndContainsNothing) {
  Interval interval;
  interval.lower = 1.0;
  EXPECT_FALSE(interval.contains(2.0));
  interval.upper = 3.0;
  EXPECT_TRUE(interval.contains(1.0));
  EXPECT_TRUE(interval.contains(3.0));
  EXPECT_FALSE(interval.contains(0.9));
  EXPECT_FALSE(interval.contains(3.1));
}

TEST(Studentized, ByHand) {
  // 99 replicates at estimate + (k - 50) / 50 with equal errors 0.5: pivots (k - 50) / 25, their 5
  // % and 95 % quantiles are k = 5 and 95, so +-1.8; with s = 2 the interval is 10 -+ 3.6.
  std::vector<double> replicates;
  for (int k = 1; k <= 99; ++k) replicates.push_back(10.0 + (k - 50) / 50.0);
  const std::vector<double> errors(99, 0.5);
  const Interval interval = studentized_interval(replicates, errors, 10.0, 2.0, 0.9, 0.0, 13.0);
  EXPECT_NEAR(*interval.lower, 6.4, 1e-9);
  EXPECT_EQ(*interval.upper, 13.0);  // 13.6 cut at the bound
}

TEST(Studentized, SkewedPivotsGoTheOtherWay) {
  // Replicates far above the estimate mean that the estimate itself tends to lie above the truth.
  std::vector<double> replicates;
  for (int k = 1; k <= 99; ++k) replicates.push_back(10.0 + 0.1 * k);
  const Interval interval =
      studentized_interval(replicates, std::vector<double>(99, 1.0), 10.0, 1.0, 0.9, 0.0, 100.0);
  EXPECT_NEAR(*interval.lower, 10.0 - 9.5, 1e-9);
  EXPECT_NEAR(*interval.upper, 10.0 - 0.5, 1e-9);
}

TEST(Studentized, WithoutErrorsThereIsNone) {
  const std::vector<double> replicates(99, 1.0);
  EXPECT_FALSE(
      studentized_interval(replicates, std::vector<double>(99, 0.0), 1.0, 1.0, 0.95, 0.0, 2.0)
          .available());
}

TEST(Wald, NormalAndStudentQuantilesAndBounds) {
  const Interval normal = wald_interval(1.0, 0.1, 0.95, 0, 0.0, 10.0);
  EXPECT_NEAR(*normal.lower, 1.0 - 0.1959963985, 1e-9);
  const Interval student = wald_interval(1.0, 0.1, 0.95, 10, 0.0, 10.0);
  EXPECT_NEAR(*student.upper, 1.0 + 0.1 * 2.228138852, 1e-8);
  EXPECT_EQ(*wald_interval(0.1, 0.1, 0.95, 0, 0.0, 10.0).lower, 0.0);
  EXPECT_FALSE(wald_interval(0.0, 0.0, 0.95, 0, 0.0, 10.0).available());
}

TEST(Wald, TailAreasAreAveragedOverDescriptions) {
  // (P(x - 1) + P(x + 1)) / 2 = 0.975 at x = 2.64614554821531 (bisection in another program).
  const std::vector<WaldTerm> apart = {{0.5, -1.0, 1.0, 0}, {0.5, 1.0, 1.0, 0}};
  const Interval both = averaged_wald_interval(apart, 0.95, -9.0, 9.0);
  EXPECT_NEAR(*both.upper, 2.64614554821531, 1e-9);
  EXPECT_NEAR(*both.lower, -2.64614554821531, 1e-9);
  EXPECT_EQ(*averaged_wald_interval(apart, 0.95, -2.0, 9.0).lower, -2.0) << "the bound";
  const std::vector<WaldTerm> one = {{1.0, 1.0, 0.1, 10}};
  EXPECT_EQ(*averaged_wald_interval(one, 0.95, 0.0, 10.0).upper,
            *wald_interval(1.0, 0.1, 0.95, 10, 0.0, 10.0).upper);
  // A description without an error is left out, unless it is the one that was chosen.
  const std::vector<WaldTerm> second = {{0.6, 1.0, 0.1, 10}, {0.4, 5.0, 0.0, 10}};
  EXPECT_NEAR(*averaged_wald_interval(second, 0.95, 0.0, 10.0).upper, 1.0 + 0.1 * 2.228138852,
              1e-8);
  const std::vector<WaldTerm> first = {{0.4, 5.0, 0.0, 10}, {0.6, 1.0, 0.1, 10}};
  EXPECT_FALSE(averaged_wald_interval(first, 0.95, 0.0, 10.0).available());
}

}  // namespace
}  // namespace recoil
