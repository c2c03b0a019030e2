// Two free spheres: the equation of the paper in their relative motion, with R* and m* in place of
// the radius and the mass of the one, against the simulator of the truths.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/fit.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/predictor.hpp"
#include "estimate/two_point.hpp"
#include "support/synthetic.hpp"
#include "validation/truth/impact_truth.hpp"

namespace recoil {
namespace {

constexpr double second_diameter = 3e-6, second_density = 10220.0;

/// The system of tests/support/synthetic.hpp, whose surface is a sphere.
Dataset two_spheres() {
  Dataset data = synthetic::dataset({});
  data.system.surface.density = second_density;
  data.system.surface_diameter = second_diameter;
  return data;
}

double mass_of(double density, double size) {
  return density * std::numbers::pi / 6.0 * std::pow(size, 3);
}

double true_restitution_of_two(double size, double velocity) {
  const double reference = 4.9e-6 * second_diameter / (2.0 * (4.9e-6 + second_diameter));
  TrueContact contact;
  contact.stiffness = 1.789e9;
  contact.radius = size * second_diameter / (2.0 * (size + second_diameter));
  contact.adhesion = 8.9 * std::cbrt(contact.radius / reference);
  contact.mass =
      1.0 / (1.0 / mass_of(1350.0, size) + 1.0 / mass_of(second_density, second_diameter));
  contact.C_H = 3e-3;
  contact.C_A = 0.03;
  return true_impact(contact, velocity).restitution;
}

std::vector<double> truth_of(const ImpactModel& model) {
  std::vector<double> theta = model.initial();
  theta[model.slot_C_H[0]] = 3e-3;
  theta[model.slot_C_A[0]] = 0.03;
  return theta;
}

TEST(TwoSpheres, MoveWithTheReducedMassOnTheRelativeRadius) {
  const ImpactModel model = make_model(synthetic::spec(), {two_spheres()});
  const std::vector<double> theta = truth_of(model);
  for (const double size : {2.58e-6, 4.9e-6, 8e-6}) {
    for (const double velocity : {5.0, 20.0, 80.0}) {
      const double e = true_restitution_of_two(size, velocity);
      ASSERT_GT(e, 0.0);
      EXPECT_NEAR(predict(model, theta, 0, size, velocity, false).restitution_squared, e * e, 1e-8);
    }
    const double V = capture_velocity(model, theta, 0, size).value;
    EXPECT_EQ(true_restitution_of_two(size, 0.9999 * V), 0.0);
    EXPECT_GT(true_restitution_of_two(size, 1.0001 * V), 0.0);
  }
}

TEST(TwoSpheres, SlopeInTheDiameterIsThatOfTheCurve) {
  const ImpactModel model = make_model(synthetic::spec(), {two_spheres()});
  const std::vector<double> theta = truth_of(model);
  const double size = 4e-6, velocity = 6.0, step = 1e-4 * size;
  PointPredictor predictor(model, {{0, size, velocity}});
  predictor.evaluate(theta, true);
  const auto square = [&](double d) { return std::pow(true_restitution_of_two(d, velocity), 2); };
  const double slope = (square(size + step) - square(size - step)) / (2.0 * step);
  EXPECT_NEAR(predictor.diameter_slope(0) / slope, 1.0, 1e-5);
}

TEST(TwoSpheres, MechanismsMoveThemInTheSameWay) {
  FitSpec spec = synthetic::spec();
  spec.mechanisms = {"plastic_yield"};
  const ImpactModel model = make_model(spec, {two_spheres()});
  std::vector<double> theta = truth_of(model);
  for (std::size_t j = 0; j < theta.size(); ++j) {  // nothing yields
    if (model.slots[j].parameter->name == "yield_pressure") theta[j] = 1e12;
  }
  const double e = true_restitution_of_two(3.2e-6, 12.0);
  EXPECT_NEAR(predict(model, theta, 0, 3.2e-6, 12.0, false).restitution_squared, e * e, 1e-8);
  spec.mechanisms = {"gas_film"};
  EXPECT_THROW(make_model(spec, {two_spheres()}), InputError);
}

Dataset points_of_two_spheres() {
  Dataset data = two_spheres();
  for (ImpactPoint& point : data.points) {
    point.restitution = true_restitution_of_two(point.diameter, point.incident_velocity);
    point.captured = point.restitution == 0.0 ? 1 : 0;
    point.restitution_sd = 1e-4;  // the residual allows for a bias of its square
  }
  return data;
}

TEST(TwoSpheres, TwoPointsFindWhatMadeThePoints) {
  const Dataset data = points_of_two_spheres();
  const ImpactModel model = make_model(synthetic::spec(), {data});
  const TwoPointResult found = two_point(model, gather({data}), 0, 4.9e-6);
  ASSERT_EQ(found.status, TwoPointStatus::converged);
  EXPECT_NEAR(found.theta[model.slot_C_H[0]], 3e-3, 1e-7);
  EXPECT_NEAR(found.theta[model.slot_C_A[0]], 0.03, 1e-6);
}

TEST(TwoSpheres, FitFindsWhatMadeThePoints) {
  const Dataset data = points_of_two_spheres();
  const FitResult fitted = fit(make_model(synthetic::spec(), {data}), gather({data}));
  ASSERT_TRUE(fitted.usable);
  EXPECT_NEAR(fitted.theta[fitted.model.slot_C_H[0]], 3e-3, 1e-7);
  EXPECT_NEAR(fitted.theta[fitted.model.slot_C_A[0]], 0.03, 1e-6);
}

}  // namespace
}  // namespace recoil
