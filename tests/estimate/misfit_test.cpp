// The test of counts of captures. Right values: the binomial distribution, and the definition of a
// p-value.
#include "estimate/misfit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "estimate/fit.hpp"
#include "estimate/residual.hpp"
#include "support/one_size.hpp"

namespace recoil {
namespace {

/// One impact with probability 1/2: the deviance is 2 ln 2 whatever happens. Two: 4 ln 2 or 0.
TEST(CountMoments, OfOneAndTwoImpacts) {
  Observation point;
  PointWeights weights;
  weights.scatter = 0.1;
  weights.sd = 0.01;
  point.censored = true;
  EXPECT_NEAR(count_moments(point, weights, 0.0).mean, 2.0 * std::log(2.0), 1e-12);
  EXPECT_NEAR(count_moments(point, weights, 0.0).variance, 0.0, 1e-12);
  point.events = 2;
  EXPECT_NEAR(count_moments(point, weights, 0.0).mean, 2.0 * std::log(2.0), 1e-12);
  EXPECT_NEAR(count_moments(point, weights, 0.0).variance, std::pow(2.0 * std::log(2.0), 2), 1e-12);
}

/// Ten velocities, 5 to 20 impacts each, V* scatters by 7.5 %; only counts are known. A p-value is
/// below 0.05 in 5 % of all sets, 10 of 200 with a binomial standard deviation of 3.1.
TEST(Misfit, OfCountsHasTheLevelOfItsTest) {
  const double capture = true_capture_velocity(one_size::truth(), one_size::diameter);
  FitSpec spec = synthetic::spec();
  spec.parameters.front().free = false;
  spec.parameters.front().initial = 3e-3;
  int below = 0;
  int below_half = 0;
  for (unsigned k = 0; k < 200; ++k) {
    std::mt19937 random(k + 1);
    std::normal_distribution<double> normal;
    std::uniform_int_distribution<int> impacts(5, 20);
    Dataset data = one_size::design(2);
    data.points.clear();
    for (int i = 0; i < 10; ++i) {
      ImpactPoint point;
      point.diameter = one_size::diameter;
      point.incident_velocity = capture * (0.75 + 0.6 * i / 9.0);
      point.events = impacts(random);
      for (int j = 0; j < point.events; ++j) {
        if (point.incident_velocity < capture * std::exp(0.075 * normal(random))) ++point.captured;
      }
      point.counted = true;
      point.counts_only = point.captured < point.events;
      data.points.push_back(point);
    }
    const std::vector<Dataset> datasets = {data};
    const FitResult fitted = fit(make_model(spec, datasets), gather(datasets));
    ASSERT_TRUE(fitted.usable) << fitted.failure;
    if (fitted.p_value < 0.05) ++below;
    if (fitted.p_value < 0.5) ++below_half;
  }
  std::printf("p below 0.05 in %d, below 0.5 in %d of 200\n", below, below_half);
  EXPECT_LE(below, 19);
  EXPECT_GE(below, 2);
  EXPECT_NEAR(below_half, 100, 21);
}

}  // namespace
}  // namespace recoil
