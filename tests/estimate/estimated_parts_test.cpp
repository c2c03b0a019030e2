// Degrees of freedom of errors of which a part is estimated (Satterthwaite). Right values: closed
// forms.
#include "estimate/estimated_parts.hpp"

#include <gtest/gtest.h>

#include "support/one_size.hpp"

namespace recoil {
namespace {

TEST(DegreesOfFreedom, OnlyTheEstimatedPartOfTheVarianceIsUncertain) {
  FitResult fitted;
  fitted.theta = {1.0, 2.0};
  fitted.covariance = {4.0, 0.0, 0.0, 1.0};
  fitted.quantile_dof = 3;
  // The variance of the first parameter has parts of 1 (3 degrees of freedom) and 2 (12); a
  // quarter is known: 4^2 / (1 / 3 + 4 / 12) = 24. That of the second is estimated as a whole.
  fitted.estimated = {{Estimated::spread, 3, {1.0, 0.0, 0.0, 1.0}},
                      {Estimated::noise, 12, {2.0, 0.0, 0.0, 0.0}}};
  EXPECT_EQ(degrees_of_freedom(fitted, 0), 24);
  EXPECT_EQ(degrees_of_freedom(fitted, 1), 3);
  fitted.estimated.clear();
  fitted.quantile_dof = 0;
  EXPECT_EQ(degrees_of_freedom(fitted, 0), 0);
}

/// Without any other error, the estimated noise is the whole covariance.
TEST(EstimatedParts, NoiseAloneIsTheCovariance) {
  Dataset data = one_size::design(12);
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    data.points[i].restitution += i % 2 == 0 ? 0.01 : -0.01;
  }
  NoiseSpec noise;
  noise.variance = VarianceFunction::constant;
  const FitResult fitted = one_size::fit_to(data, noise);
  ASSERT_TRUE(fitted.usable);
  ASSERT_EQ(fitted.estimated.size(), 1U);
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    const std::size_t diagonal = k * (fitted.theta.size() + 1);
    EXPECT_NEAR(fitted.estimated[0].covariance[diagonal] / fitted.covariance[diagonal], 1.0, 1e-6);
    EXPECT_EQ(degrees_of_freedom(fitted, k), 10);
  }
}

/// Points of one setting whose own scatter is negligible: the error of the settings is nearly all.
TEST(EstimatedParts, SettingsAloneAreTheCovariance) {
  Dataset data = one_size::design(8);
  const std::vector<ImpactPoint> once = data.points;
  data.points.clear();
  for (std::size_t i = 0; i < once.size(); ++i) {
    for (const double own : {-1e-4, 1e-4}) {
      ImpactPoint point = once[i];
      point.setting = std::to_string(i);
      point.restitution += (i % 2 == 0 ? 0.02 : -0.02) + own;
      point.restitution_sd = 1e-4;
      data.points.push_back(point);
    }
  }
  const FitResult fitted = one_size::fit_to(data);
  ASSERT_TRUE(fitted.usable);
  ASSERT_EQ(fitted.estimated.size(), 1U);
  EXPECT_EQ(fitted.estimated[0].error, Estimated::setting);
  const std::size_t diagonal = fitted.theta.size() + 1;
  EXPECT_NEAR(fitted.estimated[0].covariance[diagonal] / fitted.covariance[diagonal], 1.0, 0.01);
}

}  // namespace
}  // namespace recoil
