// The generator's physics against closed forms.
#include "validation/synthetic/sphere.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/synthetic/effects.hpp"
#include "validation/truth/elastoplastic_truth.hpp"

namespace {

using namespace recoil::hidden;
using std::numbers::pi;

/// An ammonium fluorescein sphere of 4.9 um.
Base fluorescein() {
  Base base;
  base.density = 1350.0;
  base.youngs_modulus = 1.2e9;
  base.poisson_ratio = 0.33;
  base.surface_modulus = 320e9;
  base.surface_ratio = 0.31;
  base.surface_density = 10280.0;
  base.reference_diameter = 4.9e-6;
  return base;
}

Sphere sticky_sphere(const Base& base, double diameter) {
  Sphere s;
  s.mass = base.density * pi / 6.0 * std::pow(diameter, 3);
  s.radius = 0.5 * diameter;
  s.stiffness = base.stiffness();
  s.adhesion_force = base.adhesion_force;
  s.C_H = base.C_H;
  s.C_A = base.C_A;
  return s;
}

double restitution(const Base& base, const ContactExtras& extras, double velocity) {
  return std::sqrt(contact(sticky_sphere(base, 4.9e-6), extras, base, velocity).square) / velocity;
}

TEST(HiddenSphere, StiffnessIsThatOfTable1) {
  EXPECT_NEAR(fluorescein().stiffness(), 1.789e9, 0.001e9);
}

// C_H V (1 + e) = ln[(1 + C_H V) / (1 - e C_H V)], the exact law without adhesion.
TEST(HiddenSphere, WithoutAdhesionTheExactLawOfHuntAndCrossley) {
  Base base = fluorescein();
  for (double x : {0.1, 1.0, 3.0}) {
    base.C_H = x / 10.0;
    const double e = restitution(base, {}, 10.0);
    EXPECT_NEAR(x * (1.0 + e), std::log((1.0 + x) / (1.0 - e * x)), 1e-7) << x;
  }
}

TEST(HiddenSphere, WithoutDampingNothingIsLost) {
  Base base = fluorescein();
  base.adhesion_force = 8.9;
  for (double v : {0.1, 2.0, 50.0}) EXPECT_NEAR(restitution(base, {}, v), 1.0, 1e-6) << v;
}

// V*^2 = 2 J (C_A + 2 C_H) V_a^3, J = 0.827350, for weak damping.
TEST(HiddenSphere, CaptureFollowsTheLawOfWeakDamping) {
  Base base = fluorescein();
  base.adhesion_force = 8.9;
  const Sphere s = sticky_sphere(base, 4.9e-6);
  const double a = std::sqrt(s.radius) * s.stiffness / s.mass;
  const double b = 2.0 * pi * std::sqrt(s.radius) * s.adhesion_force / s.mass;
  const double unit = std::pow(b, 1.25) * std::pow(a, -0.75);
  base.C_A = 1e-3 / unit;
  base.C_H = 0.5e-3 / unit;
  const double expected = std::sqrt(2.0 * 0.827350 * 2e-3) * unit;
  const auto back = [&](double v) {
    return contact(sticky_sphere(base, 4.9e-6), {}, base, v).rebounded;
  };
  EXPECT_FALSE(back(0.99 * expected));
  EXPECT_TRUE(back(1.01 * expected));
}

// e = (6 sqrt(3)/5)^(1/2) (1 - s/6)^(1/2) (y / (y + 2 sqrt(6/5 - s/5)))^(1/4), s = y^2, y = V_Y /
// V.
TEST(HiddenSphere, YieldingIsThatOfThorntonAndNing) {
  const Base base = fluorescein();
  const Sphere s = sticky_sphere(base, 4.9e-6);
  const double p = 1e8;
  const double E = 0.75 * s.stiffness;
  const double yield =
      pi * pi / std::sqrt(40.0) * std::sqrt(std::pow(p, 5) / (std::pow(E, 4) * 1350.0));
  for (double v : {3.0, 10.0, 100.0}) {
    const double y = yield / v;
    const double e = std::sqrt(1.2 * std::sqrt(3.0) * (1.0 - y * y / 6.0)) *
                     std::pow(y / (y + 2.0 * std::sqrt(1.2 - 0.2 * y * y)), 0.25);
    const PlasticResult plastic = plastic_contact(s.mass, s.radius, s.stiffness, p, v, 0.0);
    EXPECT_NEAR(std::sqrt(plastic.square) / v, e, 1e-6) << v;
    EXPECT_GT(plastic.radius, s.radius);
  }
  EXPECT_EQ(plastic_contact(s.mass, s.radius, s.stiffness, p, 0.9 * yield, 0.0).square,
            0.81 * yield * yield);
}

// What is given back at zero approach less JKR's 7.0922 (W^5 R_p^4 / E*^2)^(1/3) vanishes at the
// capture velocity of the full law: 1.4550, 0.8503, 4.3050 and 11.188 m/s by a program of its own
// (Gauss-Legendre in a^(1/2), 2000 radii searched).
TEST(HiddenSphere, AdhesionHelpsToYield) {
  const auto kept = [](double d, double density, double E, double W, double p, double v) {
    const double m = density * pi / 6.0 * d * d * d;
    const PlasticResult plastic = plastic_contact(m, 0.5 * d, 4.0 / 3.0 * E, p, v, W);
    return plastic.square -
           2.0 / m * 7.0922 * std::cbrt(std::pow(W, 5) * std::pow(plastic.radius, 4) / (E * E));
  };
  struct Known {
    double d, density, E, W, p, capture;
  };
  for (const Known& k : {Known{4.9e-6, 1350.0, 1.3065602623e9, 0.2, 35.3e6, 1.4550},
                         {4.9e-6, 1350.0, 1.3065602623e9, 0.2, 50e6, 0.8503},
                         {1.27e-6, 1050.0, 2.8083878229e9, 0.235, 100e6, 4.3050},
                         {1.27e-6, 1050.0, 2.8083878229e9, 0.235, 60e6, 11.188}}) {
    EXPECT_LT(kept(k.d, k.density, k.E, k.W, k.p, 0.999 * k.capture), 0.0) << k.p;
    EXPECT_GT(kept(k.d, k.density, k.E, k.W, k.p, 1.001 * k.capture), 0.0) << k.p;
  }
  // Hardly any adhesion is none.
  const Sphere s = sticky_sphere(fluorescein(), 4.9e-6);
  EXPECT_NEAR(plastic_contact(s.mass, s.radius, s.stiffness, 1e8, 10.0, 1e-9).square /
                  plastic_contact(s.mass, s.radius, s.stiffness, 1e8, 10.0, 0.0).square,
              1.0, 1e-4);
}

// Where an effect is weak its two published laws agree, and at the largest strength of the second
// they still do to some per cent.
TEST(HiddenSphere, OtherLawsAgreeWhereTheyAreWeak) {
  const Base base = fluorescein();
  const Sphere s = sticky_sphere(base, 4.9e-6);
  const double v = 10.0;
  const auto lost = [&](const ContactExtras& extras) {
    return 1.0 - std::sqrt(contact(s, extras, base, v).square) / v;
  };
  ContactExtras bulk;
  bulk.bulk_relaxation = 1e-11;
  EXPECT_NEAR(lost(bulk) / (1.0 - ramirez_restitution(s, bulk.bulk_relaxation, v)), 1.0, 0.02);
  bulk.bulk_relaxation = largest_by_other_law("bulk_viscoelastic", s, v);
  EXPECT_NEAR(ramirez_restitution(s, bulk.bulk_relaxation, v), 1.0 - 0.3 + 0.6 * 0.09, 1e-9);
  EXPECT_NEAR(lost(bulk) / (1.0 - ramirez_restitution(s, bulk.bulk_relaxation, v)), 1.0, 0.06);
  ContactExtras plate;
  const double rate = std::pow(s.stiffness * std::sqrt(s.radius) / s.mass, 0.4) * std::pow(v, 0.2);
  plate.plate_mobility = 0.01 / (s.mass * rate);
  EXPECT_NEAR(lost(plate) / (1.0 - boettcher_restitution(s, plate.plate_mobility, v)), 1.0, 0.02);
  plate.plate_mobility = largest_by_other_law("plate_flexure", s, v);
  EXPECT_NEAR(lost(plate) / (1.0 - boettcher_restitution(s, plate.plate_mobility, v)), 1.0, 0.06);
  EXPECT_TRUE(std::isinf(largest_by_other_law("plastic_yield", s, v)));
}

// e = 1 at V_y, continuous at 60 V_y, and above Thornton's: in finite elements the plastic zone
// grows below the surface first.
TEST(HiddenSphere, JacksonsYieldingIsContinuous) {
  const Base base = fluorescein();
  const Sphere s = sticky_sphere(base, 4.9e-6);
  const double p = 1e8;
  const double yield = pi * pi / std::sqrt(40.0) *
                       std::sqrt(std::pow(p, 5) / (std::pow(0.75 * s.stiffness, 4) * 1350.0));
  EXPECT_EQ(jackson_restitution(s, p, 0.999 * yield), 1.0);
  EXPECT_NEAR(jackson_restitution(s, p, 1.0001 * yield), 1.0, 1e-4);
  EXPECT_NEAR(jackson_restitution(s, p, 59.9999 * yield), 1.0 - 0.1 * std::log(60.0), 1e-4);
  EXPECT_NEAR(jackson_restitution(s, p, 60.0001 * yield), 1.0 - 0.1 * std::log(60.0), 1e-4);
  for (double ratio : {2.0, 10.0}) {
    const double other =
        std::sqrt(plastic_contact(s.mass, s.radius, s.stiffness, p, ratio * yield, 0.0).square) /
        (ratio * yield);
    const double more = jackson_restitution(s, p, ratio * yield) - other;
    EXPECT_GT(more, 0.0) << ratio;
    EXPECT_LT(more, 0.2) << ratio;
  }
}

// 7.09 (W^5 R^4 / E*^2)^(1/3), Thornton & Ning (1998).
TEST(HiddenSphere, JkrLosesTheWorkOfThorntonAndNing) {
  const double R = 3e-6;
  const double K = 2e9;
  const double E = 0.75 * K;
  for (double w : {0.01, 0.4}) {
    const double unit = std::cbrt(std::pow(w, 5) * std::pow(R, 4) / (E * E));
    EXPECT_NEAR(recoil::jkr_parting_work(w, R, 0.75 * K) / unit, 7.0922, 1e-3);
  }
}

// Without adhesion and other damping the loss is dW times the largest contact area of Hertz.
TEST(HiddenSphere, AreaHysteresisTakesItsEnergyPerArea) {
  const Base base = fluorescein();
  const Sphere s = sticky_sphere(base, 4.9e-6);
  const double v = 5.0;
  const double depth = std::pow(1.25 * s.mass * v * v / (std::sqrt(s.radius) * s.stiffness), 0.4);
  ContactExtras extras;
  extras.hysteresis_energy = 0.02;
  const double lost = v * v - contact(s, extras, base, v).square;
  EXPECT_NEAR(lost, 2.0 * pi * s.radius * depth * 0.02 / s.mass, 1e-6 * lost);
}

// Weak: pi R n_m w (2/5) B((2-k)/5, 1+k/2) v_m^k, v_m = V sqrt(R / n_m) / 2.
TEST(HiddenSphere, TheCrackLosesWhatItsSpeedCosts) {
  const Base base = fluorescein();
  const Sphere s = sticky_sphere(base, 4.9e-6);
  const double v = 10.0;
  const double depth = std::pow(1.25 * s.mass * v * v / (std::sqrt(s.radius) * s.stiffness), 0.4);
  ContactExtras extras;
  extras.crack_energy = 1e-3;
  const double k = extras.crack_exponent;
  const double lost = v * v - contact(s, extras, base, v).square;
  const double edge = 0.5 * v * std::sqrt(s.radius / depth);
  const double expected = pi * s.radius * depth * extras.crack_energy * std::pow(edge, k) * 0.4 *
                          std::beta((2.0 - k) / 5.0, 1.0 + 0.5 * k);
  EXPECT_NEAR(lost, 2.0 * expected / s.mass, 0.01 * lost);
}

// 1 - e = 1.15345 b - 0.7983 b^2, b = (3/2) A k^(2/5) V^(1/5), k = K sqrt(R) / m.
TEST(HiddenSphere, BulkLossIsThatOfKuwabaraAndKono) {
  const Base base = fluorescein();
  const Sphere s = sticky_sphere(base, 4.9e-6);
  ContactExtras extras;
  extras.bulk_relaxation = 1e-10;
  for (double v : {1.0, 50.0}) {
    const double b = 1.5 * extras.bulk_relaxation *
                     std::pow(s.stiffness * std::sqrt(s.radius) / s.mass, 0.4) * std::pow(v, 0.2);
    EXPECT_NEAR(1.0 - restitution(base, extras, v), 1.15345 * b - 0.7983 * b * b, b * b * b) << v;
  }
}

// A target that gives way at the rate F / Z is to first order a dashpot of the relaxation m / Z.
TEST(HiddenSphere, AThinPlateIsADashpotOfTheMass) {
  const Base base = fluorescein();
  const Sphere s = sticky_sphere(base, 4.9e-6);
  ContactExtras plate;
  plate.plate_mobility = 200.0;
  ContactExtras bulk;
  bulk.bulk_relaxation = s.mass * plate.plate_mobility;
  const double a = 1.0 - restitution(base, plate, 10.0);
  const double b = 1.0 - restitution(base, bulk, 10.0);
  EXPECT_GT(a, 1e-3);
  EXPECT_NEAR(a, b, 0.02 * b);
}

// Integral of F'^2 over a Hertzian impact: (9/4) (K sqrt(R))^2 B / ... by the beta function.
TEST(HiddenSphere, WavesCarryAwayTheSquareOfTheRate) {
  const Base base = fluorescein();
  const Sphere s = sticky_sphere(base, 4.9e-6);
  const double v = 20.0;
  ContactExtras extras;
  extras.wave_radiation = 1.0;
  const double lost = v * v - contact(s, extras, base, v).square;
  // F' = 1.5 k sqrt(n) n', n' = v sqrt(1 - (n/n_m)^(5/2)); twice the integral over n from 0 to n_m.
  const double k = s.stiffness * std::sqrt(s.radius);
  const double depth = std::pow(1.25 * s.mass * v * v / k, 0.4);
  const double integral = 2.0 * 2.25 * k * k * v * depth * depth * 0.4 * std::beta(0.8, 1.5);
  const double mu = base.surface_modulus / (2.0 * (1.0 + base.surface_ratio));
  const double D = 0.931 / (2.0 * pi * mu * std::sqrt(mu / base.surface_density));
  EXPECT_NEAR(lost, 2.0 * D * integral / s.mass, 1e-5 * lost);
}

/// A base that loses something without adhesion: e is 0.9 or so.
Base lossy() {
  Base base = fluorescein();
  base.C_H = 0.02;
  return base;
}

double squared(const Effects& effects, double v) {
  return square_of_restitution(lossy(), effects, v, 4.9e-6);
}

TEST(HiddenEffects, ConstantEnergiesFallAsTheSquareOfTheVelocity) {
  Effects jkr, bridge, asperity;
  jkr.jkr_work = 0.05;
  bridge.bridge_length = 1e-9;
  asperity.asperity_energy = 1e-15;
  for (const Effects& effect : {jkr, bridge, asperity}) {
    const double slow = squared({}, 2.0) - squared(effect, 2.0);
    const double fast = squared({}, 8.0) - squared(effect, 8.0);
    EXPECT_GT(slow, 1e-3);
    EXPECT_NEAR(slow / fast, 16.0, 1e-3);
  }
}

// e = sqrt(1 - (V_s / V)^2) when nothing else costs energy.
TEST(HiddenEffects, JkrAloneIsTheClassicalLaw) {
  const Base base = fluorescein();
  Effects effects;
  effects.jkr_work = 0.2;
  const double mass = base.density * pi / 6.0 * std::pow(4.9e-6, 3);
  const double E = 0.75 * base.stiffness();
  const double sticking =
      std::sqrt(2.0 * 7.0922 * std::cbrt(std::pow(0.2, 5) * std::pow(2.45e-6, 4) / (E * E)) / mass);
  for (double v : {1.1 * sticking, 3.0 * sticking}) {
    const double square = square_of_restitution(base, effects, v, 4.9e-6);
    EXPECT_NEAR(square, 1.0 - sticking * sticking / (v * v), 1e-4);
  }
  EXPECT_LT(square_of_restitution(base, effects, 0.99 * sticking, 4.9e-6), 0.0);
}

// v_out^2 = e_0(V')^2 V'^2 - c with V'^2 = V^2 + c: c = 2 g h of the fall, and 2 U / m =
// (3/2) eps0 E^2 / rho of a charge with the field E.
TEST(HiddenEffects, AHighPlaneAndAChargeTakeTheSameFromAllVelocities) {
  Effects plane, charge;
  plane.plane_height = 5e-3;
  charge.surface_field = 3e6;
  const auto expect_cost = [&](const Effects& effect, double c, double share) {
    for (double v : {1.0, 3.0}) {
      const double arrived = std::sqrt(v * v + c);
      const double square = squared({}, arrived) * arrived * arrived - c;
      EXPECT_NEAR(squared(effect, v) * v * v, square, share * c) << v;
    }
  };
  expect_cost(plane, 2.0 * 9.81 * 5e-3, 1e-3);
  expect_cost(charge, 1.5 * 8.854e-12 * 9e12 / 1350.0, 5e-3);  // the plane is 1 mm away
}

// Hertz alone, and a part of what it stores kept back.
TEST(HiddenEffects, HysteresisKeepsAConstantPart) {
  ContactExtras extras;
  extras.hysteretic_share = 0.19;
  for (double v : {0.1, 1.0, 50.0}) {
    EXPECT_NEAR(restitution(fluorescein(), extras, v), 0.9, 1e-6) << v;
  }
}

// 2 U / m with U = A r / 6 z0.
TEST(HiddenEffects, AttractionBeforeContactIsAWell) {
  Effects effects;
  effects.hamaker_constant = 4e-19;
  const double mass = 1350.0 * pi / 6.0 * std::pow(4.9e-6, 3);
  const double c = 2.0 * 4e-19 * 2.45e-6 / (6.0 * 0.4e-9) / mass;
  for (double v : {0.5, 2.0}) {
    const double arrived = std::sqrt(v * v + c);
    EXPECT_NEAR(squared(effects, v) * v * v, squared({}, arrived) * arrived * arrived - c,
                1e-4 * c);
  }
}

TEST(HiddenEffects, AHeightReadTooLargeAddsToTheRebound) {
  Effects effects;
  effects.height_error = 1e-3;
  EXPECT_NEAR(squared(effects, 1.5), squared({}, 1.5) + 2.0 * 9.81 * 1e-3 / 2.25, 1e-9);
}

// A ball of 2.7 g and 40 mm with C_d = 0.44 that returns e = 0.9 rises from 1 m as if e were 0.813
// (closed form of a quadratic drag); at Re < 1000, where it is slow, C_d is larger.
TEST(HiddenEffects, AirSlowsADroppedBallTwice) {
  Base base = fluorescein();
  base.density = 2.7e-3 / (pi / 6.0 * std::pow(40e-3, 3));
  Effects effects;
  effects.flight_pressure = 101325.0;
  effects.contact.hysteretic_share = 0.19;
  const double v = std::sqrt(2.0 * 9.81);
  EXPECT_NEAR(std::sqrt(square_of_restitution(base, effects, v, 40e-3)), 0.813, 0.002);
}

// Read by times of flight, air takes the same of e to first order in the drag as by heights: with a
// drag k v^2, 1 - k V^2 / 4g of the velocity before and of that after an impact, either way.
TEST(HiddenEffects, AirTakesAsMuchByTimesOfFlightAsByHeights) {
  Base base = fluorescein();
  base.density = 2.7e-3 / (pi / 6.0 * std::pow(40e-3, 3));
  const auto e = [&](double pressure, bool timed) {
    Effects effects;
    effects.flight_pressure = pressure;
    effects.flights_timed = timed;
    effects.contact.hysteretic_share = 0.19;
    return std::sqrt(square_of_restitution(base, effects, 3.0, 40e-3));
  };
  const double without = e(0.0, false);
  for (const double pressure : {1e4, 3e4, 1e5}) {
    const double by_heights = without - e(pressure, false);
    const double by_times = without - e(pressure, true);
    EXPECT_GT(by_heights, 0.02 * pressure / 1e5);
    EXPECT_NEAR(by_times / by_heights, 1.0, 1e-3) << pressure;
  }
}

// Each way costs (9 mu / (2 rho r)) times a sum that hardly depends on the velocity: 1 - e ~ 1/V.
TEST(HiddenEffects, GasSlowsBothWaysByAFixedSpeed) {
  Effects gas;
  gas.gas_pressure = 1e5;
  const auto lost = [&](double v) {
    return (std::sqrt(squared({}, v)) - std::sqrt(squared(gas, v))) * v;
  };
  const double slow = lost(3.0);
  EXPECT_GT(slow, 0.1);
  EXPECT_LT(slow, 1.0);
  EXPECT_NEAR(lost(6.0) / slow, 1.0, 0.15);  // inertia, and the contact at another velocity
}

TEST(HiddenEffects, AnOffsetVelocityActsOnBothReadings) {
  Effects effects;
  effects.velocity_error = 0.1;
  const double e0 = std::sqrt(squared({}, 1.9));
  EXPECT_NEAR(std::sqrt(squared(effects, 2.0)), (e0 * 1.9 + 0.1) / 2.0, 1e-9);
}

TEST(HiddenEffects, WhatIsSeenOfAPoint) {
  const Scatter scatter{0.1, 0.0, 0.0};
  const double e0 = std::sqrt(squared({}, 2.0));
  const auto shown = [&](const Effects& effects) {
    return expected_point(lossy(), effects, scatter, 2.0, 4.9e-6, 0);
  };
  EXPECT_NEAR(shown({}).restitution, e0, 1e-12);
  EXPECT_NEAR(shown({}).event_sd, 0.1 * e0, 1e-12);
  Effects chance;
  chance.outlier_share = 0.2;
  EXPECT_NEAR(shown(chance).restitution, 0.8 * e0 + 0.1, 1e-12);
  Effects slow;  // the mean of a normal variable cut in its middle: e_0 + sd sqrt(2 / pi)
  slow.slowest_rebound = 2.0 * e0;
  EXPECT_NEAR(shown(slow).restitution, e0 * (1.0 + 0.1 * std::sqrt(2.0 / pi)), 1e-9);
  Effects batch;
  batch.series_offset = {0.03};
  EXPECT_NEAR(shown(batch).restitution, e0 + 0.03, 1e-12);
}

// Near capture only the good rebounders are seen.
TEST(HiddenEffects, SurvivorsReboundBetterThanTheTypicalSphere) {
  Base base = fluorescein();
  base.adhesion_force = 8.9;
  base.C_A = 0.05;
  const Scatter scatter;
  const double typical = std::sqrt(square_of_restitution(base, {}, 1.5, 4.9e-6));
  Effects spread;
  spread.adhesion_spread = 0.4;
  EXPECT_GT(expected_point(base, spread, scatter, 1.5, 4.9e-6, 0).restitution, typical + 0.05);
  Effects sizes;
  sizes.size_spread = 0.3;
  EXPECT_GT(expected_point(base, sizes, scatter, 1.5, 4.9e-6, 0).restitution, typical + 0.05);
}

}  // namespace
