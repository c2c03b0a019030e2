// C_H against the HuntCrossleyForce of Simbody (Sherman, Seth & Delp 2011, Procedia IUTAM 2,
// 241-261), integrated by Simbody: Hertz's force times 1 + (3/2) c n', so that c = (2/3) C_H.
#include <gtest/gtest.h>

#include <cmath>

#include "impact/impact.hpp"
#include "simbody_impact.hpp"

namespace recoil {
namespace {

double restitution_by_recoil(double C_H) {
  ImpactOptions options;
  options.tolerance = 1e-13;
  return std::sqrt(simulate_impact({C_H, 0.0, 0.0}, options).restitution_squared);
}

TEST(Simbody, AgreesOnTheDampingOfTheElasticContact) {
  for (const double alpha : {0.001, 0.01, 0.05, 0.3, 1.0}) {
    const double expected = restitution_by_recoil(alpha);
    const double coarse = restitution_by_simbody(alpha, 1e-4);
    const double fine = restitution_by_simbody(alpha, 1e-8);
    EXPECT_NEAR(coarse, expected, 1e-3) << alpha;
    EXPECT_NEAR(fine, expected, 5e-8) << alpha;
    EXPECT_LT(std::abs(fine - expected), 1e-2 * std::abs(coarse - expected)) << alpha;
  }
}

TEST(Simbody, AFinerAccuracyTakesTheDifferenceAway) {
  const double expected = restitution_by_recoil(0.1);
  double before = INFINITY;
  for (const double accuracy : {1e-4, 1e-6, 1e-8}) {
    const double difference = std::abs(restitution_by_simbody(0.1, accuracy) - expected);
    EXPECT_LT(difference, 0.2 * before) << accuracy;
    before = difference;
  }
  EXPECT_LT(before, 1e-8);
}

}  // namespace
}  // namespace recoil
