// Many points, interpolated between simulated ones, against the same points in small groups, which
// are simulated one by one.
#include "estimate/velocity_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "estimate/predictor.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

/// Points of two sizes between `slowest` and 40 times that, in no order, and three other sizes.
std::vector<PointConditions> many_points(double slowest) {
  std::uint64_t state = 7;
  const auto uniform = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  };
  std::vector<PointConditions> points;
  for (int i = 0; i < 1200; ++i) {
    const double diameter = i < 3 ? (5.0 + i) * 1e-6 : i % 2 == 0 ? 2.58e-6 : 4.9e-6;
    points.push_back({0, diameter, slowest * std::pow(40.0, uniform()), 0});
  }
  return points;
}

struct Case {
  const char* name;
  double slowest;  // [m/s]
  std::vector<std::string> mechanisms;
  bool law_error;
  double strength = 0.0;  // of the mechanism; 0: its default
};

TEST(VelocityGrid, GivesTheImpactsThatItStandsFor) {
  for (const Case& at : {Case{"rebounds", 5.0, {}, false}, Case{"captures", 0.3, {}, false},
                         Case{"an error of the laws", 1.0, {}, true},
                         Case{"a mechanism", 2.0, {"plastic_yield"}, false},
                         Case{"a spread of sizes", 5.0, {"polydispersity"}, false, 0.1}}) {
    SCOPED_TRACE(at.name);
    FitSpec spec = synthetic::spec(true);
    spec.mechanisms = at.mechanisms;
    for (const Parameter* parameter : parameters_with(spec.mechanisms, spec.adhesion)) {
      if (parameter->mechanism != nullptr) spec.parameters.push_back(default_of(*parameter));
    }
    const std::vector<PointConditions> points = many_points(at.slowest);
    ImpactModel model = make_model(spec, {synthetic::dataset({})});
    if (at.law_error) model = with_law_error(model, {.size = 0.06, .length = 0.8}, points);
    std::vector<double> theta = model.initial();
    if (at.strength > 0.0) theta.back() = at.strength;
    if (at.law_error) std::fill(theta.end() - 3, theta.end(), 0.7);
    PointPredictor together(model, points);
    together.evaluate(theta, true);
    double square = 0.0, slope = 0.0, in_velocity = 0.0, in_diameter = 0.0;
    for (std::size_t first = 0; first < points.size(); first += 400) {
      PointPredictor few(model, {points.begin() + static_cast<std::ptrdiff_t>(first),
                                 points.begin() + static_cast<std::ptrdiff_t>(first) + 400});
      few.evaluate(theta, true);
      for (std::size_t k = 0; k < few.size(); ++k) {
        const std::size_t i = first + k;
        ASSERT_EQ(together.at(i).outcome, few.at(k).outcome) << i;
        const auto further = [](double& most, double a, double b) {
          most = std::max(most, std::abs(a - b) / std::max(1.0, std::abs(b)));
        };
        further(square, together.at(i).restitution_squared, few.at(k).restitution_squared);
        const double V = points[i].velocity, d = points[i].diameter;
        further(in_velocity, V * together.velocity_slope(i), V * few.velocity_slope(k));
        further(in_diameter, d * together.diameter_slope(i), d * few.diameter_slope(k));
        std::vector<double> one(theta.size()), other(theta.size());
        together.gradient_row(i, 1.0, one);
        few.gradient_row(k, 1.0, other);
        for (std::size_t j = 0; j < one.size(); ++j) {
          const double unit = theta[j] == 0.0 ? 1.0 : theta[j];
          further(slope, unit * one[j], unit * other[j]);
        }
      }
    }
    EXPECT_LT(square, 1e-8);
    EXPECT_LT(slope, 1e-6);
    EXPECT_LT(in_velocity, 1e-6);
    EXPECT_LT(in_diameter, 1e-6);
  }
}

TEST(VelocityGrid, IsOnlyForManyPointsOfAFewSizes) {
  std::vector<PointConditions> points = many_points(1.0);
  const std::optional<VelocityGrid> grid = VelocityGrid::for_points(points);
  ASSERT_TRUE(grid);
  EXPECT_LT(grid->nodes().size(), 170u);
  EXPECT_FALSE(VelocityGrid::for_points(std::span(points).first(500)));
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].diameter = (5.0 + 0.001 * static_cast<double>(i)) * 1e-6;
  EXPECT_FALSE(VelocityGrid::for_points(points));
}

}  // namespace
}  // namespace recoil
