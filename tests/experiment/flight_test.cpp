#include "experiment/flight.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace {

using namespace recoil;

// h = 9.80665 / 2000 m: from rest at the plane the fall takes sqrt(2 h / g) = sqrt(1e-3) s.
constexpr double kHeight = 9.80665 / 2000.0;
const double kFall = std::sqrt(1e-3);

TEST(Flight, FromRestByHand) {
  EXPECT_NEAR(flight::surface_velocity(0.0, kHeight), 9.80665 * kFall, 1e-14);
  EXPECT_NEAR(flight::slowest_return(kHeight), 9.80665 * kFall, 1e-14);
  EXPECT_NEAR(flight::round_trip(0.0, 0.0, kHeight), 2.0 * kFall, 1e-14);
  EXPECT_NEAR(flight::longest_round_trip(0.0, kHeight), 2.0 * kFall, 1e-14);
  EXPECT_NEAR(flight::time_above(9.80665), 2.0, 1e-14);
}

/// Follows the fall and the rise in small steps.
double stepped_round_trip(double down, double up, double height) {
  constexpr int steps = 200000;
  double time = 0.0;
  for (const double at_plane : {down, up}) {
    const double dh = height / steps;
    double speed = at_plane;
    for (int i = 0; i < steps; ++i) {  // constant acceleration within a step, exactly
      const double next = std::sqrt(speed * speed + 2.0 * 9.80665 * dh);
      time += 2.0 * dh / (speed + next);
      speed = next;
    }
  }
  return time;
}

TEST(Flight, RoundTripAgainstSteps) {
  EXPECT_NEAR(flight::round_trip(0.4, 0.2, 1e-3), stepped_round_trip(0.4, 0.2, 1e-3), 1e-12);
  EXPECT_NEAR(flight::round_trip(4.6, 4.1, 1.3e-3), stepped_round_trip(4.6, 4.1, 1.3e-3), 1e-12);
}

RC_GTEST_PROP(Flight, ImpliedHeightInverts, ()) {
  const double down = *rc::gen::inRange(1, 5000) * 1e-3;
  const double up = *rc::gen::inRange(1, 5000) * 1e-3;
  const double height = *rc::gen::inRange(10, 20000) * 1e-6;
  const double time = flight::round_trip(down, up, height);
  // The height is a difference of squares; a quarter of the digits may go.
  RC_ASSERT(std::abs(flight::implied_height(down, up, time) / height - 1.0) < 1e-8);
}

TEST(Flight, NoFlightIsSoShort) { EXPECT_LT(flight::implied_height(1.0, 0.2, 0.0), 1e-12); }

}  // namespace
