// The older capture models against hand-worked cases and integrals of their own laws.
#include "predict/capture_models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using recoil::CaptureContact;
using std::numbers::pi;

/// E* of two solids [Pa].
double reduced(double e1, double nu1, double e2, double nu2) {
  return 1.0 / ((1.0 - nu1 * nu1) / e1 + (1.0 - nu2 * nu2) / e2);
}

/// Ammonium fluorescein, 4.9 um, on silicon with the constants of the literature.
CaptureContact fluorescein_on_silicon() {
  return {4.9e-6, 1350.0, reduced(1.2e9, 0.3, 131e9, 0.28), 0.2};
}

TEST(Jkr, PublishedStickingVelocity) {
  // 0.57 m/s, quoted in Pasha et al. (2014).
  EXPECT_NEAR(recoil::jkr_capture_velocity(fluorescein_on_silicon()), 0.57, 0.005);
}

TEST(Jkr, SystemsOfTableOne) {
  // K and W_A as printed by Li, Dunn & Brach (1999); velocities worked out independently.
  struct Case {
    double diameter, density, stiffness, work, velocity;
  };
  for (const Case& c :
       {Case{4.9e-6, 1350, 1.789e9, 0.336, 0.87}, Case{4.9e-6, 1350, 1.776e9, 0.216, 0.60},
        Case{4.9e-6, 1350, 1.771e9, 0.178, 0.51}, Case{2.58e-6, 1350, 1.789e9, 0.336, 1.48},
        Case{6.89e-6, 1350, 1.789e9, 0.336, 0.65}, Case{1.27e-6, 1050, 3.745e9, 0.235, 1.76}}) {
    EXPECT_NEAR(recoil::jkr_capture_velocity({c.diameter, c.density, 0.75 * c.stiffness, c.work}),
                c.velocity, 0.006)
        << c.diameter << " " << c.work;
  }
  // Steel with the K that its elastic constants give.
  EXPECT_NEAR(recoil::jkr_capture_velocity({49e-6, 7900, 0.75 * 114e9, 2.72}), 0.075, 0.001);
}

TEST(Jkr, EnergiesAreTheIntegralsOfTheForceOverTheApproach) {
  // With w = R = E* = 1: P and delta of the header, summed by the trapezoidal rule.
  const auto load = [](double a) {
    return 4.0 * a * a * a / 3.0 - std::sqrt(8.0 * pi * a * a * a);
  };
  const auto approach = [](double a) { return a * a - std::sqrt(2.0 * pi * a); };
  const auto work = [&](double from, double to) {
    constexpr int steps = 200000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double a = from + (to - from) * i / steps;
      const double b = from + (to - from) * (i + 1) / steps;
      sum += 0.5 * (load(a) + load(b)) * (approach(b) - approach(a));
    }
    return sum;
  };
  const double touch = std::cbrt(2.0 * pi);  // delta = 0
  EXPECT_NEAR(approach(touch), 0.0, 1e-12);
  const double rest = std::cbrt(4.5 * pi);  // P = 0
  EXPECT_NEAR(load(rest), 0.0, 1e-12);
  const double parting = std::cbrt(pi / 8.0);  // least delta
  EXPECT_LT(approach(parting), approach(1.01 * parting));
  EXPECT_LT(approach(parting), approach(0.99 * parting));
  const recoil::JkrEnergies found = recoil::jkr_energies({2.0, 1.0, 1.0, 1.0});
  EXPECT_NEAR(found.incident, work(rest, touch), 1e-8);
  EXPECT_NEAR(found.rebound, work(rest, parting), 1e-8);
  EXPECT_NEAR(found.lost(), 7.0922, 1e-4);
  EXPECT_NEAR(found.incident, 4.60, 0.005);
  EXPECT_NEAR(found.rebound, 11.69, 0.005);
}

TEST(Jkr, FallsWithTheFiveSixthsOfTheDiameter) {
  CaptureContact c = fluorescein_on_silicon();
  const double small = recoil::jkr_capture_velocity(c);
  c.diameter *= 64.0;
  EXPECT_NEAR(recoil::jkr_capture_velocity(c) / small, 1.0 / 32.0, 1e-12);
}

TEST(Dahneke, HandWorkedCase) {
  // (2 / (2 x 0.25)) (3 - 0.25 x 4) = 8
  EXPECT_NEAR(recoil::dahneke_capture_velocity(2.0, 0.5, 4.0, 3.0), std::sqrt(8.0), 1e-14);
  EXPECT_EQ(recoil::dahneke_capture_velocity(2.0, 0.9, 4.0, 3.0), 0.0);  // 3 < 0.81 x 4
}

TEST(Dahneke, WhatComesBackPaysTheBondAtItsVelocity) {
  const double v = recoil::dahneke_capture_velocity(3e-13, 0.83, 4e-15, 9e-15);
  EXPECT_NEAR(0.83 * 0.83 * (0.5 * 3e-13 * v * v + 4e-15), 9e-15, 1e-27);
}

TEST(Wall, HandWorkedCase) {
  EXPECT_NEAR(recoil::wall_capture_velocity(2.0, 0.5, -1.0), 2.0, 1e-14);  // sqrt(2 / (2 x 0.25))
  EXPECT_EQ(recoil::wall_capture_velocity(2.0, 0.5, 1.0), 0.0);
}

TEST(Wall, AndDahnekeAreJkrForAnElasticContact) {
  const CaptureContact c = fluorescein_on_silicon();
  const recoil::JkrEnergies bond = recoil::jkr_energies(c);
  const double jkr = recoil::jkr_capture_velocity(c);
  EXPECT_NEAR(recoil::wall_capture_velocity(c.mass(), 1.0, -bond.lost()), jkr, 1e-12);
  EXPECT_NEAR(recoil::dahneke_capture_velocity(c.mass(), 1.0, bond.incident, bond.rebound), jkr,
              1e-12);
}

TEST(Jkr, IsTheElasticVelocityOfThorntonAndNing) {
  // Their equation, with its factor in three digits: 1.84 ((w / R)^5 / (rho^3 E*^2))^(1/6).
  const CaptureContact c = fluorescein_on_silicon();
  const double published =
      1.84 * std::pow(std::pow(c.adhesion_energy / c.radius(), 5.0) /
                          (std::pow(c.density, 3.0) * std::pow(c.reduced_modulus, 2.0)),
                      1.0 / 6.0);
  EXPECT_NEAR(published / recoil::jkr_capture_velocity(c), 1.0, 1e-3);
}

/// The same law in other hands: the pressure is summed over rings of the contact, the work by the
/// trapezoidal rule, the contact that just comes free found by bisection.
double sticking_by_rings(const CaptureContact& c, double yield_pressure) {
  const double R = c.radius(), E = c.reduced_modulus, W = c.adhesion_energy;
  const auto approach = [&](double a, double radius) {
    return a * a / radius - std::sqrt(2.0 * pi * W * a / E);
  };
  const auto force = [&](double a) {
    // With t = s the tensile part is finite: p 2 pi r dr = p 2 pi a^2 t dt.
    constexpr int rings = 400;
    double sum = 0.0;
    for (int i = 0; i < rings; ++i) {
      const double t = (i + 0.5) / rings;
      const double p = 2.0 * E * a / (pi * R) * t - std::sqrt(2.0 * W * E / (pi * a)) / t;
      sum += std::min(p, yield_pressure) * t / rings;
    }
    return 2.0 * pi * a * a * sum;
  };
  const auto work = [&](double from, double to, double radius, const auto& push) {
    constexpr int steps = 4000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double a = from + (to - from) * i / steps;
      const double b = from + (to - from) * (i + 1) / steps;
      sum += push(0.5 * (a + b)) * (approach(b, radius) - approach(a, radius));
    }
    return sum;
  };
  const double touch = std::cbrt(2.0 * pi * W * R * R / E);
  const auto given_back = [&](double a) {
    const double adhesive = std::sqrt(8.0 * pi * W * E * a * a * a);
    const double flattened = 4.0 * E * a * a * a / (3.0 * (force(a) + adhesive));
    const double parts = std::cbrt(pi * W * flattened * flattened / (8.0 * E));
    return work(parts, a, flattened, [&](double r) {
      return 4.0 * E * r * r * r / (3.0 * flattened) - std::sqrt(8.0 * pi * W * E * r * r * r);
    });
  };
  double low = touch;
  while (given_back(1.02 * low) < 0.0) low *= 1.02;
  double high = 1.02 * low;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (given_back(middle) < 0.0 ? low : high) = middle;
  }
  return std::sqrt(2.0 * work(touch, high, R, force) / c.mass());
}

TEST(ThorntonNing, StickingWithYieldAndAdhesionAtWork) {
  // Ammonium fluorescein of 4.9 um on silicon with w = 0.2 J/m2; the literature quotes about 1.6
  // m/s for 35.3 MPa (Pasha et al. 2014, doi 10.1007/s10035-013-0476-y).
  const CaptureContact c = fluorescein_on_silicon();
  for (const double p : {35.3e6, 50e6, 200e6}) {
    EXPECT_NEAR(recoil::thornton_ning_plastic_velocity(c, p) / sticking_by_rings(c, p), 1.0, 2e-3)
        << p;
  }
  EXPECT_NEAR(recoil::thornton_ning_plastic_velocity(c, 35.3e6), 1.455, 0.005);
  EXPECT_NEAR(recoil::thornton_ning_plastic_velocity(c, 50e6), 0.850, 0.003);
}

TEST(ThorntonNing, AHardSphereSticksByJkrAndNothingSticksWithoutAdhesion) {
  const CaptureContact c = fluorescein_on_silicon();
  EXPECT_NEAR(recoil::thornton_ning_plastic_velocity(c, 1e10) / recoil::jkr_capture_velocity(c),
              1.0, 1e-6);
  EXPECT_EQ(recoil::thornton_ning_plastic_velocity({4.9e-6, 1350, 1.3e9, 0.0}, 35.3e6), 0.0);
}

}  // namespace
