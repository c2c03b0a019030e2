// Derivatives with respect to what can be measured, against an independent integrator.
#include "impact/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "data/contact.hpp"
#include "impact/impact.hpp"
#include "support/independent_impact.hpp"

namespace recoil {
namespace {

using Complex = std::complex<double>;

/// The physical quantities of an impact as complex numbers, in the order of the struct.
struct Physical {
  Complex d, V, rho, K, f0, C_H, C_A;
};

/// e^2 from the dimensional equation: m n'' = -sqrt(r) K n^(3/2) (1 + C_H v) + 2 pi sqrt(r) f0 ...
Complex restitution_squared(const Physical& p) {
  const Complex r = p.d / 2.0;
  const Complex m = p.rho * 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const Complex hertz = std::sqrt(r) * p.K / m;
  const Complex adhesion = 2.0 * std::numbers::pi * std::sqrt(r) * p.f0 / m;
  const independent::Groups<Complex> groups{
      p.C_H * p.V, adhesion * std::pow(hertz, -0.6) * std::pow(p.V, -0.8), p.C_A * p.V};
  return independent::twice_energy_left(groups, false);
}

TEST(Sensitivity, EveryPhysicalQuantityAgainstTheComplexStep) {
  const Physical at{4.9e-6, 2.0, 1020.0, 1.8e9, 8.0, 0.004, 0.05};
  ImpactConditions c{4.9e-6, 2.0, 1020.0, 1.8e9, 8.0, 0.004, 0.05};
  ImpactOptions options;
  options.gradient = true;
  const ImpactSensitivity s =
      impact_sensitivity(c, simulate_impact_fast(impact_groups(c), options));
  const auto slope = [&](Complex Physical::*quantity) {
    constexpr double relative = 1e-30;
    Physical shifted = at;
    const double step = relative * (at.*quantity).real();
    shifted.*quantity += Complex(0.0, step);
    return restitution_squared(shifted).imag() / step;
  };
  const auto expect = [](double found, double expected) {
    EXPECT_NEAR(found, expected, 1e-6 * std::abs(expected));
  };
  expect(s.diameter, slope(&Physical::d));
  expect(s.velocity, slope(&Physical::V));
  expect(s.density, slope(&Physical::rho));
  expect(s.stiffness, slope(&Physical::K));
  expect(s.adhesion_force, slope(&Physical::f0));
  expect(s.hertz_damping, slope(&Physical::C_H));
  expect(s.adhesion_damping, slope(&Physical::C_A));
}

TEST(Sensitivity, OfTheStiffnessAgainstDifferences) {
  ImpactSystem system;
  system.particle = {"sphere", 1000.0, 3e9, 0.33, {}};
  system.surface = {"surface", 0.0, 70e9, 0.2, {}};
  const StiffnessSensitivity s = stiffness_sensitivity(system);
  const auto difference = [&](double& quantity) {
    const double value = quantity;
    const double step = 1e-4 * value;
    quantity = value + step;
    const double up = derive_contact(system, 1e-6).stiffness;
    quantity = value - step;
    const double down = derive_contact(system, 1e-6).stiffness;
    quantity = value;
    return (up - down) / (2.0 * step);
  };
  const auto expect = [](double found, double expected) {
    EXPECT_NEAR(found, expected, 1e-6 * std::abs(expected));
  };
  expect(s.youngs_particle, difference(system.particle.youngs_modulus));
  expect(s.youngs_surface, difference(system.surface.youngs_modulus));
  expect(s.poisson_particle, difference(system.particle.poisson_ratio));
  expect(s.poisson_surface, difference(system.surface.poisson_ratio));
}

}  // namespace
}  // namespace recoil
