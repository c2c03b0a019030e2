// Standard deviations from few impacts, pooled. Right values: closed forms.
#include "estimate/pooled_deviations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "estimate/fit.hpp"
#include "estimate/noise_doubt.hpp"
#include "support/one_size.hpp"

namespace recoil {
namespace {

/// Points with e = 0.8 far from capture, where all variance functions are flat, and these sds of
/// one impact, computed from `impacts` of them.
WeightedData points_with(const std::vector<double>& sds, const std::vector<int>& impacts) {
  WeightedData made;
  made.data.points.resize(sds.size());
  made.weights.points.resize(sds.size());
  for (std::size_t i = 0; i < sds.size(); ++i) {
    made.data.points[i].restitution = 0.8;
    made.data.points[i].events = impacts[i];
    made.data.points[i].sd = sds[i] / std::sqrt(static_cast<double>(impacts[i]));
  }
  return made;
}

TEST(PooledDeviations, AreTheMeanOfTheVariancesByTheirDegreesOfFreedom) {
  const WeightedData made = points_with({0.01, 0.02, 0.03}, {3, 4, 6});
  const auto pooled = pool_deviations(made.data, made.weights, std::vector(3, 0.64));
  ASSERT_TRUE(pooled);
  EXPECT_EQ(pooled->dof, 10);
  // (2 0.01^2 + 3 0.02^2 + 5 0.03^2) / 10
  Noise noise;
  noise.variance = pooled->variance;
  noise.scale = pooled->scale;
  EXPECT_NEAR(noise.estimated_sd(0.64, 0.0, 1), std::sqrt(5.9e-4), 1e-5);  // `capture`: to sd^2
}

TEST(PooledDeviations, FollowTheScatterThatGrowsTowardsCapture) {
  std::vector<double> sds;
  for (int k = 0; k < 8; ++k) sds.push_back(0.02 * std::exp(2.0 * k / 8.0));
  WeightedData made = points_with(sds, std::vector(8, 5));
  for (std::size_t i = 0; i < 8; ++i) {
    made.weights.points[i].proximity = static_cast<double>(i) / 8.0;
  }
  const auto pooled = pool_deviations(made.data, made.weights, std::vector(8, 0.64));
  ASSERT_TRUE(pooled);
  EXPECT_EQ(pooled->variance, VarianceFunction::steep);
  EXPECT_NEAR(pooled->scale, 0.02, 1e-9);
}

TEST(PooledDeviations, ThatDifferByMoreThanFewImpactsExplainAreNot) {
  const WeightedData made =
      points_with({0.001, 0.05, 0.001, 0.05, 0.001, 0.05}, std::vector(6, 10));
  EXPECT_FALSE(pool_deviations(made.data, made.weights, std::vector(6, 0.64)));
}

/// One number for all points, or for all impacts, was not computed from each point's impacts.
TEST(PooledDeviations, AreThoseOfSamples) {
  Dataset data = one_size::design(8);
  int n = 3;
  for (ImpactPoint& point : data.points) {
    point.events = n++;
    point.restitution_sd = 0.01;
  }
  EXPECT_EQ(gather({data}).noise.sd_of_few, 0);
  for (ImpactPoint& point : data.points) point.restitution_sd = 0.02 / std::sqrt(point.events);
  EXPECT_EQ(gather({data}).noise.sd_of_few, 0);
  data.points[2].restitution_sd = 0.011;
  EXPECT_EQ(gather({data}).noise.sd_of_few, 8);
  EXPECT_TRUE(gather({data}).noise.pools_sd);
  NoiseSpec stated;
  stated.variance = VarianceFunction::stated;
  EXPECT_FALSE(gather({data}, stated).noise.pools_sd);
}

/// Pooling cures the doubt; what is used as stated keeps it.
TEST(PooledDeviations, LeaveNoDoubt) {
  Dataset data = one_size::design(12);
  std::mt19937 random(3);
  std::chi_squared_distribution<double> square(4.0);
  std::normal_distribution<double> normal;
  for (ImpactPoint& point : data.points) {
    point.events = 5;
    point.restitution_sd = 0.01 * std::sqrt(square(random) / 4.0);
    point.restitution += 0.01 * normal(random);
  }
  const FitResult pooled = one_size::fit_to(data);
  ASSERT_TRUE(pooled.usable);
  EXPECT_EQ(pooled.weights.noise.pooled_dof, 48);
  EXPECT_EQ(pooled.quantile_dof, 48);
  EXPECT_TRUE(noise_doubts(pooled).empty());
  NoiseSpec stated;
  stated.variance = VarianceFunction::stated;
  const FitResult as_stated = one_size::fit_to(data, stated);
  EXPECT_EQ(as_stated.quantile_dof, 0);
  ASSERT_EQ(noise_doubts(as_stated).size(), 1U);
  EXPECT_EQ(noise_doubts(as_stated).front().number, 12.0);
}

}  // namespace
}  // namespace recoil
