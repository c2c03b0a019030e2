#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "diagnosis/unstated_errors.hpp"

namespace recoil {
namespace {

/// Three sizes dropped from five heights, four times each, the rebound read to `step` [m] (0:
/// exactly), and e printed with four digits.
Dataset drops(double step, std::uint64_t draw) {
  RandomStream random(7, RandomPurpose::coverage, draw);
  Dataset data;
  data.system.method = Method::drop_heights;
  for (const double diameter : {3e-3, 6e-3, 12e-3}) {
    const double base = 0.70 + 0.2 * random.uniform();
    for (const double drop : {0.0215, 0.056, 0.146, 0.38, 0.99}) {
      for (int i = 0; i < 4; ++i) {
        const double e = base - 0.05 * std::sqrt(drop) + 0.004 * random.normal();
        double height = e * e * drop;
        if (step > 0.0) height = step * std::round(height / step);
        ImpactPoint point;
        point.diameter = diameter;
        point.incident_velocity = std::sqrt(2.0 * 9.80665 * drop);
        point.restitution = 1e-4 * std::round(1e4 * std::sqrt(height / drop));
        data.points.push_back(point);
      }
    }
  }
  return data;
}

TEST(ReadingStep, IsSeenInHeightsThatLieOnIt) {
  for (std::uint64_t draw = 0; draw < 20; ++draw) {
    EXPECT_DOUBLE_EQ(height_step(drops(5e-3, draw)), 5e-3) << draw;
  }
}

TEST(ReadingStep, IsNotSeenWhereThereIsNone) {
  int seen = 0;
  for (std::uint64_t draw = 0; draw < 300; ++draw) seen += height_step(drops(0.0, draw)) > 0.0;
  EXPECT_LE(seen, 6);
  Dataset timed = drops(5e-3, 0);
  timed.system.method = Method::velocimeter;
  EXPECT_EQ(height_step(timed), 0.0);
  EXPECT_EQ(height_step(Dataset()), 0.0);
}

}  // namespace
}  // namespace recoil
