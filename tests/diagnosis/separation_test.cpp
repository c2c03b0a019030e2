#include "diagnosis/separation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace recoil {
namespace {

// Readings of a curve have unit noise; the rival's curve lies sqrt(lambda) away. The deviances of
// both are then counted directly.
TEST(Separation, IsTheShareOfNoisyReadingsThatNameTheCause) {
  constexpr int draws = 200000;
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  for (const double lambda : {1.0, 4.0, 9.0, 25.0}) {
    for (const double penalty : {-2.2, 0.0, 2.2}) {
      int named = 0;
      for (int i = 0; i < draws; ++i) {
        const double reading = normal(engine);
        const double rival = reading - std::sqrt(lambda);
        named += rival * rival + penalty - reading * reading >= 4.0 ? 1 : 0;
      }
      const double share = static_cast<double>(named) / draws;
      const double error = 4.0 * std::sqrt(0.25 / draws);
      EXPECT_NEAR(probability_of_naming(lambda, penalty, 4.0), share, error)
          << lambda << " " << penalty;
    }
  }
}

TEST(Separation, IsCertainWithoutADifferenceOfTheCurves) {
  EXPECT_EQ(probability_of_naming(0.0, 3.9, 4.0), 0.0);
  EXPECT_EQ(probability_of_naming(0.0, 4.1, 4.0), 1.0);
}

}  // namespace
}  // namespace recoil
