// The truth of yield and adhesion against its known limits, and against integrals done numerically.
#include "validation/truth/elastoplastic_truth.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "validation/truth/truth.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

constexpr double never = std::numeric_limits<double>::infinity();

ElastoplasticContact fluorescein() {
  ElastoplasticContact contact;
  contact.reduced_modulus = 1.334e9;
  contact.radius = 2.45e-6;
  contact.mass = 1350.0 * 4.0 / 3.0 * pi * std::pow(contact.radius, 3);
  contact.yield_pressure = never;
  return contact;
}

/// V_Y = (pi / (2 E))^2 (8 pi r^3 / (15 m))^(1/2) p_Y^(5/2), Johnson (1985), section 11.5.
double yield_velocity(const ElastoplasticContact& c) {
  return std::pow(pi / (2.0 * c.reduced_modulus), 2) *
         std::sqrt(8.0 * pi * std::pow(c.radius, 3) / (15.0 * c.mass)) *
         std::pow(c.yield_pressure, 2.5);
}

/// Thornton & Ning (1998), their closed form without adhesion, s = V_Y / V <= 1.
double thornton_ning(double s) {
  return std::sqrt(6.0 * std::sqrt(3.0) / 5.0 * (1.0 - s * s / 6.0)) *
         std::pow(s / (s + 2.0 * std::sqrt(1.2 - 0.2 * s * s)), 0.25);
}

TEST(ElastoplasticTruth, WithoutAdhesionIsThorntonAndNing) {
  ElastoplasticContact contact = fluorescein();
  contact.yield_pressure = 100e6;
  const double V_Y = yield_velocity(contact);
  EXPECT_NEAR(elastoplastic_impact(contact, 0.9 * V_Y).restitution, 1.0, 1e-12);
  EXPECT_NEAR(elastoplastic_impact(contact, V_Y).restitution, 1.0, 1e-6);
  for (const double s : {0.99, 0.7, 0.3, 0.1, 0.01}) {
    EXPECT_NEAR(elastoplastic_impact(contact, V_Y / s).restitution, thornton_ning(s), 1e-11) << s;
  }
  const double far = 1e-6;
  EXPECT_NEAR(elastoplastic_impact(contact, V_Y / far).restitution / std::pow(far, 0.25), 1.185,
              1e-3);
}

/// Work that a JKR contact takes from alpha = 0 to where it tears, by the midpoint rule over
/// P(a) d alpha(a), in units of (w^5 R^4 / E^2)^(1/3): E = R = w = 1.
double jkr_parting_work() {
  const double from = std::cbrt(2.0 * pi);
  const double to = std::cbrt(pi / 8.0);
  constexpr int steps = 200000;
  double work = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double h = (to - from) / steps;
    const double a = from + (i + 0.5) * h;
    const double load = 4.0 * a * a * a / 3.0 - std::sqrt(8.0 * pi) * std::pow(a, 1.5);
    const double slope = 2.0 * a - 0.5 * std::sqrt(2.0 * pi / a);
    work += load * slope * h;
  }
  return work;
}

TEST(ElastoplasticTruth, WithoutYieldIsJkr) {
  ElastoplasticContact contact = fluorescein();
  contact.adhesion_energy = 0.2;
  const double parting =
      jkr_parting_work() *
      std::cbrt(std::pow(0.2, 5) * std::pow(contact.radius, 4) / std::pow(1.334e9, 2));
  const double V_s = std::sqrt(2.0 * parting / contact.mass);
  EXPECT_NEAR(V_s, 0.57, 0.01);  // the literature's value for this system
  EXPECT_FALSE(elastoplastic_impact(contact, 0.9999 * V_s).rebounded);
  for (const double ratio : {1.001, 1.5, 4.0, 20.0}) {
    EXPECT_NEAR(elastoplastic_impact(contact, ratio * V_s).restitution,
                std::sqrt(1.0 - 1.0 / (ratio * ratio)), 1e-4)
        << ratio;
  }
}

TEST(ElastoplasticTruth, HysteresisTakesTheContactArea) {
  ElastoplasticContact contact = fluorescein();
  contact.hysteresis = 0.01;
  const double v = 3.0;
  const double energy = 0.5 * contact.mass * v * v;
  const double depth =
      std::pow(15.0 * energy / (8.0 * contact.reduced_modulus * std::sqrt(contact.radius)), 0.4);
  const double expected = 0.01 * pi * contact.radius * depth / energy;
  EXPECT_NEAR(1.0 - elastoplastic_impact(contact, v).restitution_squared, expected, 1e-12);
}

TEST(ElastoplasticTruth, FlatteningMakesAdhesionStronger) {
  ElastoplasticContact contact = fluorescein();
  contact.adhesion_energy = 0.2;
  const double v = 1.2;
  const double elastic_loss = 1.0 - elastoplastic_impact(contact, v).restitution_squared;
  contact.yield_pressure = 35.3e6;
  const ElastoplasticImpact yielded = elastoplastic_impact(contact, v);
  const double adhesive_loss = 1.0 - yielded.restitution_squared - yielded.plastic_share;
  EXPECT_GT(yielded.unloading_radius, 1.2 * contact.radius);
  EXPECT_NEAR(adhesive_loss / elastic_loss,
              std::pow(yielded.unloading_radius / contact.radius, 4.0 / 3.0), 1e-9);
}

RC_GTEST_PROP(ElastoplasticTruth, NeverGivesMoreThanItGot, ()) {
  const auto between = [](double low, double high) {
    return low * std::pow(high / low, *rc::gen::inRange(0, 10001) / 10000.0);
  };
  ElastoplasticContact contact = fluorescein();
  contact.yield_pressure = between(1e6, 1e9);
  contact.adhesion_energy = between(1e-4, 2.0);
  contact.hysteresis = between(1e-4, 2.0);
  const double v = between(0.01, 200.0);
  const ElastoplasticImpact impact = elastoplastic_impact(contact, v);
  RC_ASSERT(impact.restitution_squared < 1.0);
  RC_ASSERT(impact.rebounded == (impact.restitution_squared > 0.0));
  RC_ASSERT(impact.plastic_share >= -1e-12);
  RC_ASSERT(impact.unloading_radius >= contact.radius * (1.0 - 1e-12));
}

}  // namespace
}  // namespace recoil
