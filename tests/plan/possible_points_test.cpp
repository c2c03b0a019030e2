// What one planned point tells, against closed forms and against the scatter of simulated points.
#include "plan/possible_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

using recoil::PlannedScatter;
using recoil::point_outlook;

PlannedScatter sharp() {
  PlannedScatter scatter;
  scatter.spread = 0.0;
  return scatter;
}

TEST(PointOutlook, FarFromCaptureAMeanIsAsGoodAsItsDeviation) {
  const double e = 0.8;
  const recoil::PointOutlook found = point_outlook(e * e, 0.4, 0.1, sharp());
  const double sd = std::hypot(0.05 * e, 0.01) / std::sqrt(20.0);
  EXPECT_NEAR(found.sd, sd, 1e-12);
  EXPECT_NEAR(found.restitution, e, 1e-12);
  EXPECT_EQ(found.captured, 0.0);
  EXPECT_NEAR(found.information, 1.0 / (4.0 * e * e * sd * sd), 1e-3 * found.information);
}

TEST(PointOutlook, ErrorsOfVelocityAndDiameterAreShared) {
  PlannedScatter scatter = sharp();
  scatter.velocity_error = 0.02;
  scatter.diameter_error = 0.03;
  const double e = 0.8;
  const double sd = std::hypot(0.05 * e, 0.01) / std::sqrt(20.0);
  const double variance = 4.0 * e * e * sd * sd + std::pow(0.4 * 0.02, 2) + std::pow(0.1 * 0.03, 2);
  EXPECT_NEAR(point_outlook(e * e, 0.4, 0.1, scatter).information, 1.0 / variance, 1e-3 / variance);
  scatter.rebound_measured = true;  // an e too large by as much as V is too small
  const double shared = variance + (std::pow(0.4 + 2.0 * e * e, 2) - 0.16) * 0.0004;
  EXPECT_NEAR(point_outlook(e * e, 0.4, 0.1, scatter).information, 1.0 / shared, 1e-3 / shared);
}

TEST(PointOutlook, DeepInCaptureThereIsNothingToLearn) {
  EXPECT_EQ(point_outlook(-0.5, 2.0, 0.5, sharp()).information, 0.0);
  EXPECT_EQ(point_outlook(-0.5, 2.0, 0.5, sharp()).captured, 1.0);
  EXPECT_LT(point_outlook(-2.0, 2.0, 0.5, {}).information, 1e-6);
}

// Half of the spheres stay: a count of n has the information n (2 / pi) about z.
TEST(PointOutlook, AtCaptureCountsTell) {
  PlannedScatter scatter;
  scatter.floor = 1e3;  // the mean tells nothing
  const double s = 0.05 * 2.0;
  const recoil::PointOutlook found = point_outlook(0.0, 2.0, 0.5, scatter);
  EXPECT_NEAR(found.captured, 0.5, 1e-12);
  EXPECT_NEAR(found.information, 20.0 * 2.0 / std::numbers::pi / (s * s), 1e-6 / (s * s));
}

// The mean of the survivors of 20 impacts, simulated: its expectation, its scatter.
TEST(PointOutlook, SurvivorsAreExpectedAsTheyCome) {
  const double m = 0.08;
  const double slope = 2.0;
  const PlannedScatter scatter;
  const recoil::PointOutlook found = point_outlook(m, slope, 0.5, scatter);
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  double captured = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  double rebounds = 0.0;
  constexpr int impacts = 400000;
  for (int i = 0; i < impacts; ++i) {
    const double x = m + scatter.spread * slope * normal(random);
    if (x <= 0.0) {
      captured += 1.0;
      continue;
    }
    const double e = std::sqrt(x);
    const double read = e + std::hypot(scatter.scatter * e, scatter.floor) * normal(random);
    rebounds += 1.0;
    sum += read;
    squares += read * read;
  }
  const double mean = sum / rebounds;
  const double sd = std::sqrt(squares / rebounds - mean * mean);
  EXPECT_NEAR(found.captured, captured / impacts, 0.003);
  EXPECT_NEAR(found.restitution, mean, 0.001);
  EXPECT_NEAR(found.sd, sd / std::sqrt(20.0 * rebounds / impacts), 0.02 * found.sd);
}

// Where the scatter from impact to impact hardly captures any more, both forms agree.
TEST(PointOutlook, TheTwoFormsMeet) {
  const PlannedScatter scatter;
  const double s = scatter.spread * 0.2;
  const double below = point_outlook(29.99 * s, 0.2, 0.1, scatter).information;
  const double above = point_outlook(30.01 * s, 0.2, 0.1, scatter).information;
  EXPECT_NEAR(below / above, 1.0, 0.01);
}

}  // namespace
