// The plain methods that the study compares a diagnosis with.
#include "validation/studies/baseline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace recoil::hidden;

/// By numpy: with K = exp(-|x - x'|^2 / 2), x = (ln V, ln d), of the grid s = 0.1 * 10^(k / 4) the
/// smallest r' C^-1 r + ln det C, C = I + s^2 K, is 11.56 at s = 1.778 (without f: 31.74), and the
/// mean is s^2 K C^-1 r.
TEST(Baseline, DiscrepancyIsTheMeanOfTheLikeliestGaussianProcess) {
  std::vector<double> log_velocity, log_diameter;
  for (const double v : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) log_velocity.push_back(std::log(v));
  for (const double d : {5.0, 5.0, 10.0, 10.0, 20.0, 20.0}) log_diameter.push_back(std::log(d));
  const std::vector<double> expected = {2.442370108064188,   2.2591657288236022,
                                        0.8824350619324604,  -0.3993710922002552,
                                        -1.9688470368874251, -2.462822099573246};
  const std::vector<double> mean =
      discrepancy_mean(log_velocity, log_diameter, {3.0, 2.5, 1.0, -0.5, -2.0, -3.2});
  ASSERT_EQ(mean.size(), expected.size());
  for (std::size_t i = 0; i < mean.size(); ++i) EXPECT_NEAR(mean[i], expected[i], 1e-9) << i;
  EXPECT_TRUE(
      discrepancy_mean(log_velocity, log_diameter, {0.5, -0.7, 0.2, 0.1, -0.4, 0.6}).empty());
}

/// The offset of one batch lies 40 standard deviations from what the base model can follow, and is
/// the only thing in the data that differs from batch to batch at equal V and d.
TEST(Baseline, BothMethodsFindAStrongOffsetOfABatch) {
  const BaselineAnswers answers = baseline_answers(
      make_case({.design = "wall-batches", .effects = {"series_offset"}, .signal_to_noise = 40.0}));
  ASSERT_FALSE(answers.stepwise.empty());
  EXPECT_EQ(answers.stepwise.front(), "series_offset");
  EXPECT_EQ(answers.correlated, "series_offset");
}

}  // namespace
