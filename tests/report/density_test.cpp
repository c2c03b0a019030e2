// Densities of clouds against the normal law, and the words about pairs of points.
#include "report/density.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"

namespace recoil {
namespace {

struct Cloud {
  std::vector<double> x, y;
};

Cloud normal_cloud(std::size_t count) {
  Cloud cloud;
  RandomStream random(3, RandomPurpose::coverage, 0);
  for (std::size_t i = 0; i < count; ++i) {
    cloud.x.push_back(10.0 + 2.0 * random.normal());
    cloud.y.push_back(-1.0 + 0.1 * random.normal());
  }
  return cloud;
}

TEST(Density, OfANormalCloudFallsLikeTheNormalLaw) {
  const Cloud cloud = normal_cloud(20000);
  const DensityGrid grid = density(cloud.x, cloud.y, {2.0, 18.0}, {-1.4, -0.6});
  // The kernels add their variance: sd^2 (1 + n^(-1/3)).
  const double wider = 1.0 + std::pow(20000.0, -1.0 / 3.0);
  for (const double z : {0.5, 1.0, 1.5}) {
    const double expected = std::exp(-0.5 * z * z / wider);
    EXPECT_NEAR(grid.at(10.0 + 2.0 * z, -1.0), expected, 0.05) << z;
    EXPECT_NEAR(grid.at(10.0, -1.0 - 0.1 * z), expected, 0.05) << z;
  }
  EXPECT_EQ(grid.at(1.9, -1.0), 0.0);
}

TEST(Density, LevelHoldsTheShareThatWasAskedFor) {
  const Cloud cloud = normal_cloud(4000);
  const DensityGrid grid = density(cloud.x, cloud.y, {0.0, 20.0}, {-1.5, -0.5});
  for (const double share : {0.5, 0.95}) {
    const double level = density_level(grid, cloud.x, cloud.y, share);
    int inside = 0;
    for (std::size_t i = 0; i < cloud.x.size(); ++i) {
      inside += grid.at(cloud.x[i], cloud.y[i]) >= level ? 1 : 0;
    }
    EXPECT_NEAR(inside / 4000.0, share, 0.002);
    // A two-dimensional normal law holds a share p above 1 - p of its peak.
    EXPECT_NEAR(level, 1.0 - share, 0.06);
  }
}

TEST(Density, WithoutSpreadThereIsNone) {
  const std::vector<double> same(50, 1.0);
  const DensityGrid grid = density(same, same, {0.0, 2.0}, {0.0, 2.0});
  EXPECT_TRUE(grid.rows.empty());
  EXPECT_FALSE(contour_around(same, same, {0.0, 2.0}, {0.0, 2.0}, 0.5, {}).has_value());
}

TEST(Bars, HoldEveryValueOnceSideBySide) {
  const std::vector<double> values = normal_cloud(1000).x;
  const Bars bars = bars_of(values, {6.0, 14.0});  // two standard deviations to either side
  const plot::Boxes& boxes = bars.boxes;
  double held = 0.0, covered = 0.0;
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    EXPECT_LT(boxes.left[b], boxes.right[b]);
    EXPECT_LE(b == 0 ? 6.0 : boxes.right[b - 1], boxes.left[b]);
    EXPECT_EQ(boxes.bottom[b], 0.0);
    EXPECT_LE(boxes.top[b], bars.highest);
    held += boxes.top[b];
    covered += boxes.right[b] - boxes.left[b];
  }
  EXPECT_LE(boxes.right.back(), 14.0);
  EXPECT_GT(covered, 0.9 * 8.0);
  EXPECT_EQ(held + static_cast<double>(bars.outside), 1000.0);
  EXPECT_NEAR(held / 1000.0, 0.9545, 0.02);
}

}  // namespace
}  // namespace recoil
