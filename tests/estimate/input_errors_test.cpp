// Errors of velocity and diameter: effective variances on data whose errors are known. The truth
// comes from the simulator of the reconstructions.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "support/one_size.hpp"

namespace recoil {
namespace {

using one_size::design;
using one_size::fit_to;
using one_size::truth;

/// Mean relative errors of C_H and C_A and of chi2 / dof over data sets with errors in velocity.
struct Summary {
  double theta[2] = {0.0, 0.0};
  double scatter[2] = {0.0, 0.0};
  double reduced = 0.0;
};

Summary with_velocity_errors(bool accounted_for, bool rebound_measured) {
  constexpr int sets = 80;
  constexpr double relative = 0.03;
  const Dataset clean = design(20);
  Summary summary;
  for (std::uint64_t k = 0; k < sets; ++k) {
    Dataset data = clean;
    if (rebound_measured) data.columns.push_back({"rebound_velocity", "m/s"});
    RandomStream random(24, RandomPurpose::coverage, k);
    for (ImpactPoint& point : data.points) {
      const double actual = point.incident_velocity;
      point.velocity_sd = relative * actual;
      point.incident_velocity += *point.velocity_sd * random.normal();
      if (rebound_measured) point.restitution *= actual / point.incident_velocity;
      point.restitution += 0.01 * random.normal();
      point.restitution_sd = 0.01;
    }
    NoiseSpec spec;
    spec.velocity_errors = accounted_for;
    const FitResult result = fit_to(data, spec);
    if (!result.usable) {
      ADD_FAILURE() << result.failure;
      continue;
    }
    const double expected[2] = {3e-3, 0.03};
    for (std::size_t j = 0; j < 2; ++j) {
      const double error = result.theta[j] / expected[j] - 1.0;
      summary.theta[j] += error / sets;
      summary.scatter[j] += error * error / sets;
    }
    summary.reduced += result.chi2 / result.dof / sets;
  }
  for (std::size_t j = 0; j < 2; ++j) {
    summary.scatter[j] = std::sqrt(summary.scatter[j] - std::pow(summary.theta[j], 2));
  }
  return summary;
}

TEST(InputErrors, EffectiveVarianceExplainsErrorsOfVelocity) {
  for (const bool rebound_measured : {false, true}) {
    const Summary with = with_velocity_errors(true, rebound_measured);
    const Summary without = with_velocity_errors(false, rebound_measured);
    EXPECT_NEAR(with.reduced, 1.0, 0.12) << rebound_measured;  // 3 sqrt(2 / 18 / 80)
    EXPECT_GT(without.reduced, 1.35) << rebound_measured;
    // First order: what is left over is below a third of the scatter of one data set.
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_LT(std::abs(with.theta[j]), 0.33 * with.scatter[j]) << rebound_measured << j;
      EXPECT_LT(with.scatter[j], 1.02 * without.scatter[j]) << rebound_measured << j;
    }
  }
}

TEST(InputErrors, EffectiveVarianceIsTheSlopeTimesTheError) {
  // Far from capture sd(e) = |de/dV| sd_V, from the reconstruction's simulator.
  Dataset data = design(8);
  for (ImpactPoint& point : data.points) {
    point.restitution_sd = 0.01;
    point.velocity_sd = 0.02 * point.incident_velocity;
    point.diameter_sd = 0.04 * point.diameter;
  }
  data.points.front().diameter_sd = 0.0401 * one_size::diameter;  // no batch
  const FitResult result = fit_to(data);
  ASSERT_TRUE(result.usable);
  for (const std::size_t i : {std::size_t{1}, std::size_t{4}, std::size_t{7}}) {
    const Observation& point = result.data.points[i];
    const auto square = [&](double v, double d) {
      const double e = true_restitution(truth(), d * point.diameter, v * point.velocity);
      return e * e;
    };
    const double in_velocity = 0.5 * (square(1.02, 1.0) - square(0.98, 1.0));
    const double in_diameter = 0.5 * (square(1.0, 1.04) - square(1.0, 0.96));
    EXPECT_NEAR(result.weights.points[i].input_sd / std::hypot(in_velocity, in_diameter), 1.0, 2e-2)
        << i;
  }
}

/// Rows of one nominal diameter that state the same error share it, those of each size their own.
TEST(Batches, AreRowsOfOneDiameterAndOneError) {
  Dataset data = synthetic::dataset({.diameters = {2e-6, 5e-6}, .velocities = {5.0, 9.0, 20.0}});
  for (ImpactPoint& point : data.points) point.diameter_sd = 0.03 * point.diameter;
  const auto batches = [&] {
    int count = 0;
    for (const Observation& point : gather({data}).points) {
      EXPECT_TRUE((point.batch_diameter_sd > 0.0) != (point.diameter_sd > 0.0));
      count += point.batch_diameter_sd > 0.0 ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(batches(), 6);
  const Observations both = gather({data});
  EXPECT_TRUE(both.share(SharedBy::size));
  EXPECT_EQ(both.points[0].size, both.points[2].size);
  EXPECT_NE(both.points[0].size, both.points[3].size);
  data.points[1].diameter_sd = 0.031 * data.points[1].diameter;  // measured one by one
  EXPECT_EQ(batches(), 3);
  data.points[3].diameter *= 1.01;  // leaves two of its size
  EXPECT_EQ(batches(), 2);
  for (ImpactPoint& point : data.points) point.series_diameter_sd = 1e-8;
  EXPECT_EQ(batches(), 0) << "diameter_sd is the part beside the error of the series";
}

TEST(InputErrors, ErrorsTooLargeForAFirstOrderAreWarnedOf) {
  Dataset data = design(10);
  for (ImpactPoint& point : data.points) {
    point.restitution_sd = 1e-4;
    point.velocity_sd = 0.12 * point.incident_velocity;
  }
  const FitResult result = fit_to(data);
  ASSERT_TRUE(result.usable);
  EXPECT_GT(result.strained_points, 0);
  EXPECT_FALSE(std::isnan(result.chi2));
}

}  // namespace
}  // namespace recoil
