// What the points know of every parameter, and what more of them would tell.
#include "uncertainty/information.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimate/capture_velocity.hpp"
#include "estimate/predictor.hpp"
#include "support/noisy_case.hpp"

namespace recoil {
namespace {

/// A fit to points without noise: more of them do not move the estimate. Density and f0 are known
/// to 3 and 5 %.
synthetic::Case exact_case(Materials materials) {
  synthetic::Case made;
  made.datasets = {synthetic::dataset({})};
  made.datasets[0].system.errors = {{Body::particle, Constant::density, 40.0},
                                    {Body::pair, Constant::adhesion_force_f0, 0.45}};
  made.data = gather(made.datasets);
  FitSpec spec = synthetic::spec();
  spec.uncertainty.materials = materials;
  made.fitted = fit(make_model(spec, made.datasets), made.data);
  return made;
}

class Information : public testing::TestWithParam<Materials> {};
INSTANTIATE_TEST_SUITE_P(Materials, Information,
                         testing::Values(Materials::exact, Materials::propagated,
                                         Materials::adjusted));

std::vector<CapturePlace> places(const synthetic::Case& c) {
  std::vector<CapturePlace> found;
  for (const double diameter : distinct_diameters(c.datasets[0])) {
    found.push_back(
        {0, diameter, capture_velocity(c.fitted.model, c.fitted.theta, 0, diameter).value});
  }
  return found;
}

TEST_P(Information, KnowsEveryFreeParameterAsTheFitDoes) {
  const synthetic::Case c = exact_case(GetParam());
  const recoil::Information known = information_at(c.fitted, places(c));
  for (std::size_t j = 0; j < c.fitted.model.first_constant(); ++j) {
    EXPECT_NEAR(known.relative_sd[j], c.fitted.std_error[j] / c.fitted.theta[j],
                1e-6 * known.relative_sd[j])
        << j;
    EXPECT_EQ(known.relative_sd[j] > 0.0, c.fitted.model.slots[j].free) << j;
  }
  ASSERT_EQ(known.directions.size(), 2U);
  EXPECT_GT(known.condition, 1.0);
  EXPECT_NEAR(std::hypot(known.directions[0].exponents[0], known.directions[0].exponents[1]), 1.0,
              1e-12);
}

TEST_P(Information, AFitWithThePlannedPointsHasThePlannedErrors) {
  const synthetic::Case c = exact_case(GetParam());
  const recoil::Information known = information_at(c.fitted, places(c));
  ASSERT_FALSE(known.plans.empty());
  for (const PlannedPoints& plan : {known.plans.front(), known.plans.back()}) {
    Observations more = c.data;
    const auto like =
        std::min_element(more.points.begin(), more.points.end(), [&](const auto& a, const auto& b) {
          const auto distance = [&](const Observation& o) {
            return std::abs(std::log(o.velocity / plan.velocity)) +
                   (o.diameter == plan.diameter ? 0.0 : 100.0);
          };
          return distance(a) < distance(b);
        });
    Observation point = *like;
    point.velocity = plan.velocity;
    point.restitution =
        predict(c.fitted.model, c.fitted.theta, 0, plan.diameter, plan.velocity, false)
            .restitution();
    more.points.insert(more.points.end(), static_cast<std::size_t>(plan.points), point);
    const FitResult then = fit(c.fitted.model, more);
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(plan.relative_sd[j], then.std_error[j] / then.theta[j],
                  1e-3 * plan.relative_sd[j])
          << j;
      // Where constants are held, more points may rest the estimate on them more than before.
      if (GetParam() == Materials::propagated) continue;
      EXPECT_LT(plan.relative_sd[j], known.relative_sd[j]) << j;
    }
  }
}

TEST(InformationGains, NamesEveryParameterThatMorePointsWouldTell) {
  recoil::Information known;
  known.relative_sd = {0.10, 0.10, 0.0, 0.10};
  known.plans = {{0, 4.9e-6, 3.0, 2.0, 5, {0.05, 0.09, 0.0, 0.02}}};
  const std::vector<ErrorGain> gains = worthwhile_gains(known);
  ASSERT_EQ(gains.size(), 2U);
  EXPECT_EQ(gains[0].slot, 0U);
  EXPECT_EQ(gains[0].now, 0.10);
  EXPECT_EQ(gains[0].then, 0.05);
  EXPECT_EQ(gains[1].slot, 3U);
  EXPECT_TRUE(worthwhile_gains(recoil::Information{}).empty());
}

}  // namespace
}  // namespace recoil
