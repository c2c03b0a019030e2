// The coefficient of friction from made tangential restitutions, with the formulas written out.
#include "estimate/friction.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace recoil {
namespace {

constexpr double one_degree = std::numbers::pi / 180.0;

/// A point at `degrees` from the normal whose sphere slides or rolls at the friction `mu`.
ImpactPoint oblique(double degrees, double e, double mu, double error = 0.0) {
  ImpactPoint point;
  point.incidence_angle = degrees * one_degree;
  point.incident_velocity = 3.0;
  point.restitution = e;
  const double lost =
      mu * (1.0 + e) * std::cos(degrees * one_degree) / std::sin(degrees * one_degree);
  point.tangential_restitution = (lost <= 2.0 / 7.0 ? 1.0 - lost : 5.0 / 7.0) + error;
  return point;
}

Dataset oblique_dataset(const std::vector<ImpactPoint>& points) {
  Dataset dataset;
  dataset.points = points;
  return dataset;
}

TEST(Friction, NothingWithoutTangentialRestitutions) {
  ImpactPoint plain = oblique(30.0, 0.8, 0.1);
  plain.tangential_restitution.reset();
  ImpactPoint counted = oblique(30.0, 0.8, 0.1);
  counted.counts_only = true;  // no e
  EXPECT_FALSE(fit_friction(oblique_dataset({})));
  EXPECT_FALSE(fit_friction(oblique_dataset({plain, counted})));
}

TEST(Friction, IsFoundFromSpheresThatSlideAndRoll) {
  const double mu = 0.15;
  // Sliding begins where tan(angle) = 7/2 mu (1 + e): at 43 degrees for e = 0.8.
  const auto found = fit_friction(
      oblique_dataset({oblique(10.0, 0.8, mu), oblique(30.0, 0.7, mu), oblique(50.0, 0.8, mu),
                       oblique(60.0, 0.6, mu), oblique(75.0, 0.5, mu)}));
  ASSERT_TRUE(found && found->mu && found->interval);
  EXPECT_NEAR(*found->mu, mu, 1e-9);
  EXPECT_NEAR((*found->interval)[0], mu, 1e-6);
  EXPECT_NEAR((*found->interval)[1], mu, 1e-6);
  EXPECT_EQ(found->points, 5U);
  EXPECT_EQ(found->sliding, 3U);
  EXPECT_FALSE(found->least);
}

TEST(Friction, TheIntervalOfSlidingSpheresIsStudents) {
  const double mu = 0.1;
  const std::array<double, 4> errors = {0.01, -0.02, 0.015, -0.005};
  const std::array<double, 4> degrees = {50.0, 55.0, 60.0, 70.0};
  std::vector<ImpactPoint> points;
  double top = 0.0, bottom = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    points.push_back(oblique(degrees[i], 0.8, mu, errors[i]));
    const double x = 1.8 / std::tan(degrees[i] * one_degree);
    top += x * (mu * x - errors[i]);
    bottom += x * x;
  }
  const double best = top / bottom;
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = 1.8 / std::tan(degrees[i] * one_degree);
    squares += std::pow(mu * x - errors[i] - best * x, 2);
  }
  const double half = 3.182446305 * std::sqrt(squares / 3.0 / bottom);  // t of 3 dof, 97.5 %
  const auto found = fit_friction(oblique_dataset(points));
  ASSERT_TRUE(found && found->mu && found->interval);
  EXPECT_EQ(found->sliding, 4U);
  EXPECT_NEAR(*found->mu, best, 1e-12);
  EXPECT_NEAR((*found->interval)[0], best - half, 1e-8);
  EXPECT_NEAR((*found->interval)[1], best + half, 1e-8);
}

TEST(Friction, OfRollingSpheresOnlyALowerLimitIsKnown) {
  // The flattest impact rolls if mu (1 + e) / tan(angle) > 2/7: mu > 2/7 tan(40 deg) / 1.8 = 0.133.
  const double least = 2.0 / 7.0 * std::tan(40.0 * one_degree) / 1.8;
  const auto exact = fit_friction(
      oblique_dataset({oblique(20.0, 0.8, 0.5), oblique(30.0, 0.8, 0.5), oblique(40.0, 0.8, 0.5)}));
  ASSERT_TRUE(exact && exact->least);
  EXPECT_FALSE(exact->mu);
  EXPECT_FALSE(exact->interval);
  EXPECT_NEAR(*exact->least, least, 1e-6);
  // Scatter does not look like sliding.
  const auto scattered = fit_friction(
      oblique_dataset({oblique(20.0, 0.8, 0.5, -0.02), oblique(30.0, 0.8, 0.5, 0.01),
                       oblique(40.0, 0.8, 0.5, 0.015), oblique(35.0, 0.8, 0.5, -0.01)}));
  ASSERT_TRUE(scattered && scattered->least);
  EXPECT_FALSE(scattered->mu);
  EXPECT_LT(*scattered->least, least);
  EXPECT_GT(*scattered->least, 0.5 * least);
}

TEST(Friction, OnePointHasNoInterval) {
  const auto slides = fit_friction(oblique_dataset({oblique(60.0, 0.8, 0.1)}));
  ASSERT_TRUE(slides && slides->mu);
  EXPECT_NEAR(*slides->mu, 0.1, 1e-12);
  EXPECT_FALSE(slides->interval);
  const auto rolls = fit_friction(oblique_dataset({oblique(60.0, 0.8, 0.9)}));
  ASSERT_TRUE(rolls && rolls->least);
  EXPECT_NEAR(*rolls->least, 2.0 / 7.0 * std::tan(60.0 * one_degree) / 1.8, 1e-6);
}

TEST(Friction, TheIntervalHoldsTheTruthAtItsLevel) {
  const double mu = 0.15;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, 0.02);
  constexpr int tables = 2000;
  int held = 0;
  int unbounded = 0;
  for (int k = 0; k < tables; ++k) {
    std::vector<ImpactPoint> points;
    for (const double degrees : {15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0}) {
      points.push_back(oblique(degrees, 0.8, mu, normal(random)));
    }
    const auto found = fit_friction(oblique_dataset(points));
    ASSERT_TRUE(found);
    if (!found->mu) {
      ++unbounded;
      held += *found->least <= mu ? 1 : 0;
      continue;
    }
    held += (*found->interval)[0] <= mu && mu <= (*found->interval)[1] ? 1 : 0;
  }
  // 95 % of 2000 with a binomial standard deviation of 0.5 %
  EXPECT_GT(held, 0.93 * tables);
  EXPECT_LT(held, 0.97 * tables);
  EXPECT_LT(unbounded, 0.05 * tables);
}

}  // namespace
}  // namespace recoil
