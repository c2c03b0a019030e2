#include "core/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace recoil {
namespace {

std::vector<double> one_to(int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

TEST(Mean, AndStandardDeviation) {
  EXPECT_DOUBLE_EQ(mean(one_to(5)), 3.0);
  EXPECT_DOUBLE_EQ(standard_deviation(one_to(5)), std::sqrt(2.5));
  EXPECT_EQ(mean({}), 0.0);
  EXPECT_EQ(standard_deviation(one_to(1)), 0.0);
}

TEST(Quantile, FollowsTheBPlusOneRule) {
  const std::vector<double> values = one_to(99);  // (99 + 1) p is a whole number for p = 0.025 * 4
  EXPECT_DOUBLE_EQ(sorted_quantile(values, 0.05), 5.0);
  EXPECT_DOUBLE_EQ(sorted_quantile(values, 0.5), 50.0);
  EXPECT_DOUBLE_EQ(sorted_quantile(values, 0.975), 97.5);
  EXPECT_DOUBLE_EQ(sorted_quantile(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(sorted_quantile(values, 1.0), 99.0);
}

TEST(Median, IsTheMiddleValueOrTheMeanOfTwo) {
  EXPECT_DOUBLE_EQ(median({4.0, 1.0, 3.0, 2.0}), 2.5);
  EXPECT_DOUBLE_EQ(median({9.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({}), 0.0);
}

TEST(RobustSd, IsNotMovedByOneValueFarOff) {
  EXPECT_NEAR(robust_sd({1.0, 2.0, 3.0, 4.0, 1000.0}), 1.4826, 1e-12);
  EXPECT_EQ(robust_sd({}), 0.0);
}

TEST(Poisson, TailOfSmallMeansIsTheSumOfItsTerms) {
  EXPECT_DOUBLE_EQ(poisson_at_least(0, 2.0), 1.0);
  EXPECT_NEAR(poisson_at_least(1, 2.0), 1.0 - std::exp(-2.0), 1e-15);
  EXPECT_NEAR(poisson_at_least(3, 2.0), 1.0 - 5.0 * std::exp(-2.0), 1e-15);
  EXPECT_EQ(poisson_at_least(1, 0.0), 0.0);
}

// exp(-mean) is zero from a mean of 745 on: whoever sums the terms from there finds a tail of 1.
TEST(Poisson, TailOfLargeMeansFallsAsThatOfTheNormalDistribution) {
  for (const double mean : {700.0, 800.0, 30000.0, 1e7}) {
    const auto above = [&](double sds) {
      return poisson_at_least(static_cast<std::size_t>(mean + sds * std::sqrt(mean)), mean);
    };
    EXPECT_NEAR(above(0.0), 0.5, 0.02) << mean;
    EXPECT_NEAR(above(2.0), 0.0228, 0.005) << mean;
    EXPECT_LT(above(6.0), 1e-8) << mean;
    EXPECT_GT(above(-6.0), 1.0 - 1e-8) << mean;
  }
}

// Newcombe (1998), Stat. Med. 17, 857-872, table I, score method.
TEST(ShareLimits, AreThoseOfTheScore) {
  const struct {
    int part, whole;
    double lower, upper;
  } published[] = {{81, 263, 0.2553, 0.3662},
                   {15, 148, 0.0624, 0.1605},
                   {0, 20, 0.0, 0.1611},
                   {1, 29, 0.0061, 0.1718}};
  for (const auto& row : published) {
    const ShareLimits limits = share_limits(row.part, row.whole);
    EXPECT_NEAR(limits.lower, row.lower, 5e-5) << row.part;
    EXPECT_NEAR(limits.upper, row.upper, 5e-5) << row.part;
  }
}

}  // namespace
}  // namespace recoil
