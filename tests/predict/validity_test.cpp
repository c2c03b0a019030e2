// Where the equations of an impact hold. The numbers were made by a classical Runge-Kutta method of
// fourth order on eq. 5 with fixed steps (5e-4 of the regularised time, q^2 = n / n_c), the release
// found by bisection; K, W, f0 and E* from the elastic constants by eqs. 6 to 12.
#include "predict/validity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/observations.hpp"

namespace {

using recoil::Dataset;
using recoil::FitResult;
using recoil::Validity;
using recoil::ValidityQuantity;

/// Points of e = 0.9 at these (diameter, velocity).
Dataset dataset_of(const recoil::Material& sphere, const recoil::Material& surface,
                   double reference, const std::vector<std::pair<double, double>>& points) {
  Dataset dataset;
  dataset.id = sphere.name;
  dataset.series = {"all"};
  dataset.system.particle = sphere;
  dataset.system.surface = surface;
  dataset.system.reference_diameter = reference;
  for (const auto& [diameter, velocity] : points) {
    recoil::ImpactPoint point;
    point.diameter = diameter;
    point.incident_velocity = velocity;
    point.restitution = 0.9;
    point.restitution_sd = 0.01;
    dataset.points.push_back(point);
  }
  return dataset;
}

FitResult fit_of(const Dataset& dataset, double C_H, double C_A,
                 const std::vector<std::string>& mechanisms = {},
                 recoil::AdhesionLaw adhesion = recoil::AdhesionLaw::ring) {
  recoil::FitSpec spec;
  spec.adhesion = adhesion;
  spec.mechanisms = mechanisms;
  FitResult fitted;
  fitted.model = recoil::make_model(spec, {dataset});
  fitted.theta = fitted.model.initial();
  fitted.theta[fitted.model.slot_C_H[0]] = C_H;
  fitted.theta[fitted.model.slot_C_A[0]] = C_A;
  fitted.data = recoil::gather({dataset});
  fitted.usable = true;
  return fitted;
}

const Validity* find(const std::vector<Validity>& all, ValidityQuantity quantity) {
  for (const Validity& one : all) {
    if (one.quantity == quantity) return &one;
  }
  return nullptr;
}

struct Expected {
  double contact_radius, pressure_modulus, pressure_yield, tabor, transits;
};

void expect_validity(const std::vector<Validity>& all, const Expected& expected) {
  ASSERT_EQ(all.size(), 5U);
  const auto value = [&](ValidityQuantity quantity) { return find(all, quantity)->value; };
  const double close = 1e-7;
  EXPECT_NEAR(value(ValidityQuantity::contact_radius) / expected.contact_radius, 1.0, close);
  EXPECT_NEAR(value(ValidityQuantity::pressure_modulus) / expected.pressure_modulus, 1.0, close);
  EXPECT_NEAR(value(ValidityQuantity::pressure_yield) / expected.pressure_yield, 1.0, close);
  EXPECT_NEAR(value(ValidityQuantity::tabor) / expected.tabor, 1.0, close);
  EXPECT_NEAR(value(ValidityQuantity::wave_transits) / expected.transits, 1.0, close);
}

const recoil::Material kFluorescein = {"ammonium fluorescein", 1350.0, 1.2e9, 0.33, {}};
const recoil::Material kMolybdenum = {"molybdenum", 10220.0, 320e9, 0.31, {}};
const recoil::Material kLatex = {"polystyrene", 1050.0, 2.56e9, 0.35, {}};
const recoil::Material kQuartz = {"quartz", 2200.0, 73e9, 0.17, {}};
const recoil::Material kSteel = {"steel", 7900.0, 193e9, 0.3, {}};
const recoil::Material kSilicon = {"silicon", 2330.0, 131e9, 0.28, {}};

TEST(Validity, ThreePublishedSystems) {
  const Dataset soft = dataset_of(kFluorescein, kMolybdenum, 4.9e-6, {{4.9e-6, 100.0}});
  expect_validity(
      recoil::fit_validity(fit_of(soft, 3e-3, 0.05), {soft}),
      {0.5126227867, 0.3263458018, 437.8082777 / (36.0 * 1.6 / 2.8), 13.37908641, 4.183537338});
  const Dataset latex = dataset_of(kLatex, kQuartz, 1.27e-6, {{1.27e-6, 35.0}});
  expect_validity(
      recoil::fit_validity(fit_of(latex, 1.3e-3, 2.4e-3), {latex}),
      {0.2991697926, 0.1904574053, 534.8782576 / (76.8 * 1.6 / 2.8), 4.100203804, 5.748100942});
  const Dataset steel = dataset_of(kSteel, kSilicon, 49e-6, {{49e-6, 4.43}});
  expect_validity(
      recoil::fit_validity(fit_of(steel, 5e-3, 0.025), {steel}),
      {0.09576715655, 0.06096726540, 5188.641435 / (3930.0 * 1.6 / 2.8), 7.317424476, 14.93809748});
}

TEST(Validity, HertzAloneByHand) {
  // Without adhesion and damping a^2 / R^2 = n / r with n = (5 m V^2 / (4 K r^(1/2)))^(2/5), so
  // (a / R)^5 = (5 pi / 4) rho V^2 / E* at any size, and t_c = 2.943275 n / V (Johnson 1985, 11.4).
  Dataset dataset = dataset_of(kFluorescein, kMolybdenum, 4.9e-6, {{4.9e-6, 100.0}});
  dataset.system.adhesion_energy = 0.0;
  const double modulus =
      1.0 / ((1.0 - 0.33 * 0.33) / 1.2e9 + (1.0 - 0.31 * 0.31) / 320e9);  // 1.34155 GPa
  const double a = std::pow(1.25 * M_PI * 1350.0 * 1e4 / modulus, 0.2);   // 0.5243
  const auto all = recoil::fit_validity(fit_of(dataset, 0.0, 0.0), {dataset});
  EXPECT_NEAR(find(all, ValidityQuantity::contact_radius)->value, a, 1e-8);
  EXPECT_EQ(find(all, ValidityQuantity::tabor), nullptr);  // no adhesion, no such parameter
  const double transits = 2.943275 * a * a / 2.0 / 100.0 * std::sqrt(1.2e9 / 1350.0);
  EXPECT_NEAR(find(all, ValidityQuantity::wave_transits)->value, transits, 1e-5);
}

TEST(Validity, AStatedStrengthReplacesTheEstimate) {
  // The peak pressure of the steel sphere is 5188.641435 MPa, see above.
  Dataset steel = dataset_of(kSteel, kSilicon, 49e-6, {{49e-6, 4.43}});
  steel.system.particle.yield_strength = 0.7e9;
  const auto over_yield = [](const Dataset& dataset) {
    return *find(recoil::fit_validity(fit_of(dataset, 5e-3, 0.025), {dataset}),
                 ValidityQuantity::pressure_yield);
  };
  EXPECT_NEAR(over_yield(steel).value, 5188.641435 / (1.6 * 700.0), 1e-6);  // Johnson
  EXPECT_TRUE(over_yield(steel).yield_stated);
  steel.system.particle.hardness = 2.2e9;
  EXPECT_NEAR(over_yield(steel).value, 5188.641435 / (1.6 * 2200.0 / 2.8), 1e-6);
  // Silicon yields first, if that hardness is not the sphere's.
  steel.system.particle.hardness = 20e9;
  EXPECT_NEAR(over_yield(steel).value, 5188.641435 / (3930.0 * 1.6 / 2.8), 1e-6);
  EXPECT_FALSE(over_yield(steel).yield_stated);
}

/// A dry ball of 304 on 304: p_0 = (2 E* / pi) (a / R), (a / R)^5 = (5 pi / 4) rho V^2 / E*,
/// is 3.34 GPa at 1 m/s. The annealed alloy yields from 1.6 * 205 MPa on (ASTM's minimum).
TEST(Validity, AnAnnealedBallYieldsAtOneMetrePerSecond) {
  const recoil::Material named = {.name = "stainless",
                                  .density = 8000.0,
                                  .youngs_modulus = 193e9,
                                  .poisson_ratio = 0.3,
                                  .surface_energy = {},
                                  .yield_strength = 205e6};
  Dataset ball = dataset_of(named, named, 0.01, {{0.01, 1.0}});
  ball.system.adhesion_energy = 0.0;
  const double modulus = 0.5 * 193e9 / (1.0 - 0.09);
  const double pressure = 2.0 * modulus / M_PI * std::pow(1.25 * M_PI * 8000.0 / modulus, 0.2);
  const auto all = recoil::fit_validity(fit_of(ball, 0.0, 0.0), {ball});
  const Validity* yields = find(all, ValidityQuantity::pressure_yield);
  EXPECT_NEAR(yields->value, pressure / (1.6 * 205e6), 1e-5);
  EXPECT_TRUE(yields->exceeded());
}

TEST(Validity, TheWorstPointOfADatasetIsSaid) {
  const Dataset dataset =
      dataset_of(kFluorescein, kMolybdenum, 4.9e-6,
                 {{4.9e-6, 2.0}, {6.89e-6, 80.0}, {2.58e-6, 30.0}, {4.9e-6, 100.0}, {4.9e-6, 5.2}});
  const auto all = recoil::fit_validity(fit_of(dataset, 3e-3, 0.05), {dataset});
  ASSERT_EQ(all.size(), 5U);
  for (const Validity& one : all) {
    if (one.quantity == ValidityQuantity::tabor) continue;
    EXPECT_EQ(one.velocity, 100.0);
    EXPECT_EQ(one.diameter, 4.9e-6);
  }
  const Validity* tabor = find(all, ValidityQuantity::tabor);
  EXPECT_EQ(tabor->diameter, 2.58e-6);
  // mu ~ R^(1/3)
  EXPECT_NEAR(tabor->value, 13.37908641 * std::cbrt(2.58 / 4.9), 1e-6);
}

TEST(Validity, LimitsArePassedOnTheRightSide) {
  const auto exceeded = [](ValidityQuantity quantity, double value, double limit) {
    return Validity{quantity, value, limit}.exceeded();
  };
  EXPECT_TRUE(exceeded(ValidityQuantity::contact_radius, 0.31, 0.3));
  EXPECT_FALSE(exceeded(ValidityQuantity::contact_radius, 0.29, 0.3));
  EXPECT_TRUE(exceeded(ValidityQuantity::tabor, 4.1, 5.0));
  EXPECT_FALSE(exceeded(ValidityQuantity::tabor, 13.0, 5.0));
  EXPECT_TRUE(exceeded(ValidityQuantity::wave_transits, 4.2, 5.0));
}

TEST(Validity, AModelThatYieldsIsNotHeldAgainstAYieldPressure) {
  const Dataset dataset = dataset_of(kFluorescein, kMolybdenum, 4.9e-6, {{4.9e-6, 100.0}});
  const auto all = recoil::fit_validity(fit_of(dataset, 3e-3, 0.05, {"plastic_yield"}), {dataset});
  EXPECT_EQ(all.size(), 3U);
  EXPECT_EQ(find(all, ValidityQuantity::pressure_yield), nullptr);
  EXPECT_EQ(find(all, ValidityQuantity::wave_transits), nullptr);  // of the flattened sphere only
}

/// The JKR contact that is cut off at 35.3 MPa (Thornton & Ning 1998), 20 m/s, W of Gilman: work of
/// loading by scipy's quad, turning point by brentq.
TEST(Validity, AContactThatYieldsIsWideAndBearsItsYieldPressure) {
  const Dataset dataset = dataset_of(kFluorescein, kMolybdenum, 4.9e-6, {{4.9e-6, 20.0}});
  FitResult fitted = fit_of(dataset, 3e-3, 0.05, {"plastic_yield"});
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    if (fitted.model.slots[j].parameter->name == "yield_pressure") fitted.theta[j] = 35.3e6;
  }
  const auto all = recoil::fit_validity(fitted, {dataset});
  EXPECT_NEAR(find(all, ValidityQuantity::contact_radius)->value, 0.4159922, 1e-6);
  EXPECT_NEAR(find(all, ValidityQuantity::pressure_modulus)->value, 0.0263129, 1e-6);
  EXPECT_NEAR(find(all, ValidityQuantity::tabor)->value, 13.37908641, 1e-6);  // as if it did not
}

/// JKR's contact, undamped, at 1 m/s: a where the work from touch (scipy's quad of P dn/da) is m
/// V^2 / 2; p_0 = 2 E* a / (pi R) - (2 W E* / (pi a))^(1/2).
TEST(Validity, AJkrContactIsWiderThanItsPenetration) {
  const Dataset dataset = dataset_of(kFluorescein, kMolybdenum, 4.9e-6, {{4.9e-6, 1.0}});
  const FitResult fitted = fit_of(dataset, 0.0, 0.0, {}, recoil::AdhesionLaw::jkr);
  const auto all = recoil::fit_validity(fitted, {dataset});
  EXPECT_NEAR(find(all, ValidityQuantity::contact_radius)->value, 0.1414611, 1e-6);
  EXPECT_NEAR(find(all, ValidityQuantity::pressure_modulus)->value, 0.0686225, 1e-6);
}

}  // namespace
