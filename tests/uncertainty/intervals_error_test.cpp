// Monte-Carlo errors, quantiles near a bound and sandwich errors: by hand, by closed form, and by
// doing again what they describe.
#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/random.hpp"
#include "core/statistics.hpp"
#include "uncertainty/intervals.hpp"

namespace recoil {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sd_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// `count` draws of a skewed variable, exp(0.3 z).
std::vector<double> skewed(std::size_t count, std::uint64_t repetition) {
  RandomStream random(11, RandomPurpose::bootstrap, repetition);
  std::vector<double> values(count);
  for (double& v : values) v = std::exp(0.3 * random.normal());
  return values;
}

TEST(QuantileError, EvenlySpacedByHand) {
  // Ranks 1..99: one binomial sd of rank at p = 0.5 is sqrt(99 / 4) = 4.975 ranks = 4.975 units.
  std::vector<double> values(99);
  std::iota(values.begin(), values.end(), 1.0);
  EXPECT_NEAR(quantile_error(values, 0.5), std::sqrt(99.0 / 4.0), 1e-12);
  EXPECT_NEAR(quantile_error(values, 0.5, 2.0), 2.0, 1e-12);
  // At the sample's end, what is left of it stands for both sides: rank 99 * 0.01.
  EXPECT_NEAR(quantile_error(values, 0.01), std::sqrt(99 * 0.01 * 0.99), 1e-12);
  EXPECT_EQ(quantile_error(std::vector<double>(50, 3.0), 0.5), 0.0);
}

TEST(MonteCarloError, IsWhatRepetitionsScatter) {
  // 200 bootstraps of 999 replicates each: the stated errors against the scatter of the ends.
  const std::vector<double> delete_one = {0.9, 1.0, 1.05, 1.1, 1.3};
  std::vector<double> percentile_low, percentile_high, bca_low, bca_high;
  std::vector<double> stated_percentile_low, stated_percentile_high, stated_bca_low,
      stated_bca_high;
  for (std::uint64_t r = 0; r < 200; ++r) {
    const std::vector<double> values = skewed(999, r);
    const Interval p = percentile_interval(values, 0.95);
    const Interval b = bca_interval(values, 1.02, delete_one, 0.95);
    percentile_low.push_back(*p.lower);
    percentile_high.push_back(*p.upper);
    bca_low.push_back(*b.lower);
    bca_high.push_back(*b.upper);
    stated_percentile_low.push_back(*p.lower_error);
    stated_percentile_high.push_back(*p.upper_error);
    stated_bca_low.push_back(*b.lower_error);
    stated_bca_high.push_back(*b.upper_error);
  }
  // A standard deviation from 200 values is good to 5 %, times three.
  EXPECT_NEAR(mean_of(stated_percentile_low) / sd_of(percentile_low), 1.0, 0.17);
  EXPECT_NEAR(mean_of(stated_percentile_high) / sd_of(percentile_high), 1.0, 0.17);
  EXPECT_NEAR(mean_of(stated_bca_low) / sd_of(bca_low), 1.0, 0.17);
  EXPECT_NEAR(mean_of(stated_bca_high) / sd_of(bca_high), 1.0, 0.17);
  // Leaving out that z0 is random would understate it.
  EXPECT_GT(mean_of(stated_bca_high) / mean_of(stated_percentile_high), 1.1);
}

TEST(MonteCarloError, NothingRandomHasNone) {
  EXPECT_FALSE(wald_interval(1.0, 0.1, 0.95, 0, 0.0, 10.0).lower_error);
}

TEST(Bca, LevelsByHand) {
  // z0 = 0.1, a = 0.05, p = 0.025: w = 0.1 - 1.959964 = -1.859964,
  // z = 0.1 + w / (1 + 0.0929982) = -1.601711, Phi(z) = 0.0546.
  const auto low = bca_level({0.1, 0.05}, 0.025);
  ASSERT_TRUE(low);
  EXPECT_NEAR(*low, 0.05461, 1e-4);
  EXPECT_NEAR(*bca_level({0.0, 0.0}, 0.2), 0.2, 1e-12);
  EXPECT_FALSE(bca_level({0.0, 0.6}, 0.975));  // 0.6 * 1.96 > 1
}

TEST(Bca, TooLargeAnAccelerationIsRefused) {
  std::vector<double> values(199);
  std::iota(values.begin(), values.end(), 1.0);
  // One unit decides all: a = 1 / 6 * (n - 2) / sqrt(n (n - 1)) -> 1 / 6 at most for one outlier,
  // so a high level is needed: 1 - 1e-9 has z = 6.1 and a w = 1.02.
  std::vector<double> delete_one(2000, 0.0);
  delete_one.back() = -1.0;
  const Interval interval = bca_interval(values, 100.5, delete_one, 1.0 - 2e-10);
  EXPECT_FALSE(interval.available());
  EXPECT_EQ(interval.missing, NoInterval::large_acceleration);
}

TEST(ProfileQuantile, FarFromTheBoundAndOnIt) {
  EXPECT_NEAR(profile_quantile(0.95, 0, INFINITY), 3.841458821, 1e-8);
  EXPECT_NEAR(profile_quantile(0.95, 0, 1.97), 3.841458821, 1e-8);
  EXPECT_NEAR(profile_quantile(0.95, 0, 0.0), 2.705543454, 1e-8);  // chi-bar-squared, half and half
  EXPECT_NEAR(profile_quantile(0.95, 8, INFINITY), 5.317655072, 1e-7);  // F(1, 8)
}

TEST(ProfileQuantile, HoldsEveryTruthNearTheBoundAtItsLevel) {
  // x ~ N(theta, 1), theta >= 0. The rise at the truth is (x - theta)^2, less x^2 where x < 0
  // because the fit stops at 0. The probability that it stays below the quantile, by summing the
  // density on a fine grid.
  for (const double level : {0.9, 0.95, 0.99}) {
    for (const double theta : {1e-6, 0.1, 0.3, 0.7, 1.0, 1.5, 1.9, 2.5, 4.0}) {
      const double c = profile_quantile(level, 0, theta);
      double held = 0.0;
      constexpr double step = 1e-4;
      for (double x = theta - 9.0; x < theta + 9.0; x += step) {
        const double rise = std::pow(x - theta, 2) - (x < 0.0 ? x * x : 0.0);
        if (rise <= c) held += step * std::exp(-0.5 * std::pow(x - theta, 2)) / 2.5066282746310002;
      }
      EXPECT_NEAR(held, level, 2e-4) << theta;
    }
  }
}

TEST(Sandwich, OfAMeanByHand) {
  // r_i = t - y_i: J = 1, C = 1/3, h = 1/3, residuals 1, -2, 1: each r / (1 - h) = 1.5 r, and
  // var = (1/9) 2.25 (1 + 4 + 1) = 1.5.
  const std::vector<double> covariance = sandwich_covariance(
      std::vector<double>{1, -2, 1}, std::vector<double>{1, 1, 1}, std::vector<double>{1.0 / 3.0});
  ASSERT_EQ(covariance.size(), 1U);
  EXPECT_NEAR(covariance[0], 1.5, 1e-12);
}

TEST(Leverage, OfAStraightLine) {
  // x = 0, 1, 2: h = 1/3 + (x - 1)^2 / 2.
  const std::vector<double> jacobian = {1, 0, 1, 1, 1, 2};
  const std::vector<double> covariance = {5.0 / 6.0, -0.5, -0.5, 0.5};
  const std::vector<double> h = leverages(jacobian, covariance);
  EXPECT_NEAR(h[0], 5.0 / 6.0, 1e-12);
  EXPECT_NEAR(h[1], 1.0 / 3.0, 1e-12);
}

TEST(SandwichErrors, APointThatTheFitPassesThroughCountsALittle) {
  const std::vector<double> one = {1};
  EXPECT_NEAR(sandwich_covariance(one, one, one)[0], 1e4, 1e-7);  // 1 / (1 - 0.99)
}

}  // namespace
}  // namespace recoil
