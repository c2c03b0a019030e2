// Levels by simulation where they are known.
#include "uncertainty/calibrated_level.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/noisy_case.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/intervals.hpp"

namespace recoil {
namespace {

// The level of a rise is the inverse of the rise of a level, at any distance from the bound.
TEST(CalibratedLevel, OfARiseIsTheInverseOfTheQuantile) {
  for (const int dof : {0, 5}) {
    for (const double distance : {0.0, 0.3, 1.0, 1.9, 4.0}) {
      for (const double level : {0.6, 0.95, 0.99}) {
        EXPECT_NEAR(level_of_rise(profile_quantile(level, dof, distance), dof, distance), level,
                    1e-6)
            << dof << ' ' << distance;
      }
    }
  }
}

TEST(CalibratedLevel, OfAnEndIsThatOfTheInterval) {
  const std::vector<WaldTerm> terms = {{0.7, 0.0, 1.0, 8}, {0.3, 0.2, 3.0, 8}};
  for (const double level : {0.5, 0.95}) {
    const Interval interval = averaged_wald_interval(terms, level, -INFINITY, INFINITY);
    EXPECT_NEAR(averaged_wald_level(terms, *interval.lower), level, 1e-9);
    EXPECT_NEAR(averaged_wald_level(terms, *interval.upper), level, 1e-9);
  }
}

// With stated noise and a likelihood that is nearly a parabola the plain interval has its level:
// the calibrated one is the same but for chance. The 95 % quantile of 199 levels, each uniform, has
// a standard deviation of 0.016.
TEST(CalibratedLevel, IsThePlainOneWhereThatHolds) {
  const synthetic::Case c = synthetic::noisy_case();
  const std::vector<NoiseAlternative> alternatives = noise_alternatives(c.fitted);
  const std::vector<CaptureEstimate> capture = capture_estimates(alternatives, 0.95, c.datasets);
  const CalibratedLevels levels = calibrate_levels(alternatives, capture, {.simulations = 199});
  EXPECT_EQ(levels.failed, 0);
  for (std::size_t j = 0; j < c.fitted.theta.size(); ++j) {
    if (c.fitted.model.slots[j].free) {
      EXPECT_NEAR(levels.parameters[j], 0.95, 0.048) << j;
    } else {
      EXPECT_TRUE(std::isnan(levels.parameters[j])) << j;
    }
  }
  for (const double level : levels.capture) EXPECT_NEAR(level, 0.95, 0.048);
  const CalibratedLevels again =
      calibrate_levels(alternatives, capture, {.simulations = 199, .threads = 1});
  EXPECT_EQ(levels.capture, again.capture) << "no digit depends on threads";
}

}  // namespace
}  // namespace recoil
