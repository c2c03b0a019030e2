// What an ideal judge could name and see, from closed forms.
#include "validation/studies/ideal_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "validation/synthetic/case.hpp"

namespace {

using namespace recoil::hidden;

double normal_share(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// Lambda is 9: the normal distribution at 5/6 and, with a parameter more, at 7/6 (tables).
TEST(NearestRival, IsToldApartAsOftenAsTheNormalDistributionSays) {
  EXPECT_NEAR((NearestRival{"plate_flexure", 3.0, 0}).nameable(), 0.7977, 1e-4);
  EXPECT_NEAR((NearestRival{"electrostatic_image", 3.0, 1}).nameable(), 0.8783, 1e-4);
  EXPECT_EQ((NearestRival{"", 0.0, 0}).nameable(), 0.0);
  EXPECT_EQ((NearestRival{"", std::numeric_limits<double>::infinity(), 0}).nameable(), 1.0);
}

// The energy that crushes asperities falls with the size as the field of a charge that grows with
// another power of it does.
TEST(NearestRival, OfAsperitiesIsAChargeWithAFreeExponent) {
  const Case made = make_case({"wall", {"asperity_loss"}, 20.0, 0});
  ASSERT_TRUE(made.reached);
  const NearestRival rival = nearest_rivals(made).first;
  EXPECT_EQ(rival.id, "electrostatic_image");
  EXPECT_EQ(rival.freed, 1);
  const ScratchFolder scratch;
  const std::filesystem::path fit = write_case(without_noise(made), scratch.path());
  EXPECT_GT(misfit_left(fit, rival.id), 2.0 * rival.misfit);
}

// They are laws of one cause, and nothing else of the catalogue has so much the same effect.
TEST(NearestRival, OfAnotherCauseIsFartherThanALawOfTheSame) {
  const Case made = make_case({"li", {"jkr_hysteresis"}, 20.0, 0});
  ASSERT_TRUE(made.reached);
  const auto [any, other] = nearest_rivals(made);
  EXPECT_GE(other.nameable(), any.nameable());
  EXPECT_NE(other.id, "adhesion_hysteresis");
  EXPECT_NE(other.id, "crack_rate");
}

TEST(WhatCanBeSeen, WithExactLawsIsWhatTheNormalDistributionSays) {
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(5, 1);
  for (const double size : {1.0, 2.0, 3.0}) {
    const Eigen::VectorXd effect = Eigen::VectorXd::Constant(5, size / std::sqrt(5.0));
    const double seen = power_beside_law_errors(effect, none, 7, 20000);
    EXPECT_NEAR(seen, normal_share(size - 1.6449), 0.02) << size;
  }
}

// An error of the laws that has the shape of the effect: above a limit z of which 5 % lie without
// it. The limit is found by halving.
TEST(WhatCanBeSeen, BesideAnErrorOfItsShapeIsWhatAMixtureOfThreeNormalsLeaves) {
  const Eigen::VectorXd effect = Eigen::VectorXd::Constant(1, 4.0);
  const double scale = 30.0;  // 3, 6 and 12 % make 0.9, 1.8 and 3.6 standard deviations
  const Eigen::MatrixXd error = Eigen::MatrixXd::Constant(1, 1, scale);
  const auto above = [&](double limit) {
    double sum = 0.0;
    for (const double s : {0.03, 0.06, 0.12}) {
      sum += s / 0.21 * normal_share(-limit / std::hypot(1.0, s * scale));
    }
    return sum;
  };
  double low = 0.0, high = 100.0;
  for (int i = 0; i < 60; ++i) (above(0.5 * (low + high)) > 0.05 ? low : high) = 0.5 * (low + high);
  EXPECT_NEAR(power_beside_law_errors(effect, error, 7, 20000), normal_share(4.0 - low), 0.02);
}

TEST(WhatCanBeSeen, BesideAnErrorOfAnotherShapeIsUntouched) {
  const Eigen::Vector2d effect(3.0, 0.0);
  const Eigen::MatrixXd error = Eigen::Vector2d(0.0, 100.0);
  EXPECT_NEAR(power_beside_law_errors(effect, error, 7, 20000), normal_share(3.0 - 1.6449), 0.02);
}

TEST(WhatCanBeSeen, OfACaseIsLessThanWithExactLawsAndGrowsWithItsStrength) {
  double before = 0.0;
  for (const double strength : {5.0, 10.0, 40.0}) {
    const Case made = make_case({"wall", {"jkr_hysteresis"}, strength, 0});
    ASSERT_TRUE(made.reached);
    const double seen = probability_to_see(made);
    EXPECT_LE(seen, normal_share(strength - 1.6449));
    EXPECT_GE(seen, before);
    before = seen;
  }
  EXPECT_GT(before, 0.5);
}

}  // namespace
