// The ways to see the noise: their weights, and when they leave an error undecided.
#include "uncertainty/fit_alternatives.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "estimate/reweighting.hpp"
#include "support/one_size.hpp"

namespace recoil {
namespace {

FitResult noisy_fit(const NoiseSpec& spec = {}) {
  Dataset data = one_size::design(12);
  RandomStream random(5, RandomPurpose::coverage, 0);
  for (ImpactPoint& point : data.points) point.restitution += 0.02 * random.normal();
  return one_size::fit_to(data, spec);
}

TEST(FitAlternatives, WeighAsTheirCriteriaDo) {
  const FitResult fitted = noisy_fit();
  ASSERT_TRUE(fitted.usable) << fitted.failure;
  const std::vector<FitAlternative> all = fit_alternatives(fitted);
  ASSERT_GE(all.size(), 2U);
  EXPECT_EQ(all.front().fitted().theta, fitted.theta) << "the fit comes first";
  double sum = 0.0;
  for (const FitAlternative& alternative : all) {
    sum += alternative.weight;
    EXPECT_LE(alternative.weight, all.front().weight) << "the chosen one is the most likely";
    const auto total = [&](const FitResult& of) {
      for (const Noise::Candidate& candidate : fitted.weights.noise.candidates) {
        if (candidate.function == of.weights.noise.variance) {
          return candidate.criterion + penalty_of(candidate.function);
        }
      }
      return std::nan("");
    };
    EXPECT_NEAR(std::log(alternative.weight / all.front().weight),
                -0.5 * (total(alternative.fitted()) - total(fitted)), 1e-9);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(FitAlternatives, PrescribedNoiseStandsAlone) {
  NoiseSpec spec;
  spec.variance = VarianceFunction::constant;
  const FitResult fitted = noisy_fit(spec);
  ASSERT_TRUE(fitted.usable) << fitted.failure;
  const std::vector<FitAlternative> all = fit_alternatives(fitted);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all.front().weight, 1.0);
  const Interval plain = wald_interval(fitted.theta[1], fitted.std_error[1], 0.95, fitted.dof,
                                       fitted.model.slots[1].lower, fitted.model.slots[1].upper);
  EXPECT_EQ(*averaged_wald(all, 1, 0.95).lower, *plain.lower);
}

TEST(FitAlternatives, OnlyPlausibleOnesLeaveAnErrorUndecided) {
  EXPECT_EQ(undecided_factor({{1.0, 0.0, 0.3, 8}}), 1.0);
  EXPECT_NEAR(undecided_factor({{0.7, 0.0, 0.3, 8}, {0.26, 0.0, 0.1, 8}, {0.04, 0.0, 0.01, 8}}),
              3.0, 1e-12);
  EXPECT_EQ(undecided_factor({{0.7, 0.0, 0.3, 8}, {0.3, 0.0, 0.0, 8}}), 1.0) << "at a bound";
}

}  // namespace
}  // namespace recoil
