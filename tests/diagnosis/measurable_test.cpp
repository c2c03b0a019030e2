#include "diagnosis/measurable.hpp"

#include <gtest/gtest.h>

#include "support/noisy_case.hpp"

namespace recoil {
namespace {

TEST(ScatterOfOneEvent, IsThatOfTheNearestPointInLogVelocity) {
  synthetic::Case c = synthetic::noisy_case();
  for (Observation& point : c.fitted.data.points) {
    point.weights.sd = point.velocity < 10.0 ? 0.02 : 0.005;
    point.events = 1;
  }
  EXPECT_DOUBLE_EQ(scatter_of_one_event(c.fitted, 0, 3.0), 0.02);
  EXPECT_DOUBLE_EQ(scatter_of_one_event(c.fitted, 0, 400.0), 0.005);
}

TEST(ScatterOfOneEvent, IsAThousandthWhereLessIsStated) {
  synthetic::Case c = synthetic::noisy_case();
  for (Observation& point : c.fitted.data.points) point.weights.sd = 1e-6;
  EXPECT_DOUBLE_EQ(scatter_of_one_event(c.fitted, 0, 3.0), 1e-3);
  EXPECT_DOUBLE_EQ(scatter_of_one_event(c.fitted, 5, 3.0), 1e-3);  // a dataset without points
}

}  // namespace
}  // namespace recoil
