// Mechanisms between two spheres: their relative motion is that of one sphere of radius R* and mass
// m* on a flat.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "one_point.hpp"
#include "validation/truth/elastoplastic_truth.hpp"
#include "validation/truth/impact_truth.hpp"

namespace recoil {
namespace {

using one_point::around;
using one_point::kBase;
using one_point::square;

constexpr double kPi = std::numbers::pi;

double mass_of(double density, double d) { return density * kPi / 6.0 * d * d * d; }

/// Fluorescein against a sphere of molybdenum of this density.
ImpactSystem pair(double second, double reference) {
  ImpactSystem system = one_point::fluorescein();
  system.stiffness_K = 1.789e9;
  system.adhesion_energy = 0.3;
  system.surface.density = 2500.0;
  system.surface_diameter = second;
  system.reference_diameter = reference;
  return system;
}

/// R* and m* of a sphere of the diameter d and the second one.
struct Relative {
  double radius, mass;
};
Relative relative(double d, double second) {
  return {d * second / (2.0 * (d + second)),
          1.0 / (1.0 / mass_of(1350.0, d) + 1.0 / mass_of(2500.0, second))};
}

/// The sphere on a flat that moves as they do, with the f0 of the other reference diameter.
ImpactSystem one_on_a_flat(const Relative& at, double second, double reference) {
  ImpactSystem system = pair(second, reference);
  system.surface_diameter.reset();
  system.particle.density = at.mass / (4.0 / 3.0 * kPi * std::pow(at.radius, 3));
  system.reference_diameter = 2.0 * relative(reference, second).radius;
  return system;
}

TEST(TwoSpheresMechanisms, ActAsOnOneSphereOnAFlat) {
  for (const double second : {4.9e-6, 2e-6, 30e-6}) {
    for (const double d : {4.9e-6, 3e-6}) {
      const Relative at = relative(d, second);
      const Surroundings two = around(pair(second, 4.9e-6));
      const Surroundings one = around(one_on_a_flat(at, second, 4.9e-6));
      int tried = 0;
      for (const Mechanism& m : mechanism_catalogue()) {
        const bool changes_size = m.info.id == "size_calibration" || m.info.id == "polydispersity";
        if (m.info.needs_flat || changes_size) continue;
        std::vector<double> own;
        for (const Parameter& p : m.info.parameters) own.push_back(p.initial);
        if (m.info.id == "plastic_yield") own = {1.2e8, 0.1, 0.7, 0.3};
        if (m.info.id == "size_law") own = {0.6};
        const std::vector<std::string> id = {std::string(m.info.id)};
        for (const double v : {6.0, 30.0}) {
          EXPECT_NEAR(square(two, id, own, d, v, kBase),
                      square(one, id, own, 2.0 * at.radius, v, kBase), 1e-10)
              << m.info.id << ' ' << second << ' ' << v;
        }
        ++tried;
      }
      EXPECT_GE(tried, 14);
    }
  }
}

TrueContact true_contact(double d, double second) {
  const Relative at = relative(d, second);
  TrueContact contact;
  contact.stiffness = 1.789e9;
  contact.radius = at.radius;
  contact.mass = at.mass;
  contact.adhesion = kBase.f0 * std::cbrt(at.radius / relative(4.9e-6, second).radius);
  contact.C_H = kBase.C_H;
  contact.C_A = kBase.C_A;
  return contact;
}

TEST(TwoSpheresMechanisms, ChangeTheSizeOfTheFirst) {
  const double second = 7e-6, d = 4.9e-6, V = 20.0;
  const Surroundings two = around(pair(second, d));
  const double e = true_impact(true_contact(1.08 * d, second), V).restitution;
  EXPECT_NEAR(square(two, {"size_calibration"}, {0.08}, d, V, kBase), e * e, 1e-7);
  // The mean e over diameters whose logarithm is normal, cut at 2.62 of its width, and has the
  // standard deviation s then; their mean is d.
  const double s = 0.3, cut = 2.62;
  const int n = 400;
  double weights = 0.0, squares = 0.0, sizes = 0.0, sum = 0.0;
  for (int pass = 0; pass < 3; ++pass) {
    for (int i = 0; i < n; ++i) {
      const double z = cut * (2.0 * (i + 0.5) / n - 1.0);
      const double weight = std::exp(-0.5 * z * z);
      const double factor = pass == 0 ? 1.0 : std::exp(s * z / std::sqrt(squares / weights));
      if (pass == 0) {
        weights += weight;
        squares += weight * z * z;
      } else if (pass == 1) {
        sizes += weight * factor;
      } else {
        const double size = d * factor * weights / sizes;
        sum += weight * true_impact(true_contact(size, second), V).restitution;
      }
    }
  }
  EXPECT_NEAR(std::sqrt(square(two, {"polydispersity"}, {s}, d, V, kBase)), sum / weights, 3e-4);
}

TEST(TwoSpheresMechanisms, YieldAtTheirReducedMass) {
  // Steel balls of 20 mm (200 GPa, 0.3, 7800 kg/m3) that yield at 2 GPa, 5 m/s.
  ImpactSystem system;
  system.particle = system.surface = {"steel", 7800.0, 200e9, 0.3, {}};
  system.adhesion_energy = 0.0;
  system.reference_diameter = 20e-3;
  for (const double second : {5e-3, 20e-3, 1.0}) {
    system.surface_diameter = second;
    const ElastoplasticContact contact = {
        .reduced_modulus = 0.5 * 200e9 / (1.0 - 0.3 * 0.3),
        .radius = 20e-3 * second / (2.0 * (20e-3 + second)),
        .mass = 1.0 / (1.0 / mass_of(7800.0, 20e-3) + 1.0 / mass_of(7800.0, second)),
        .yield_pressure = 2e9};
    EXPECT_NEAR(square(around(system), {"plastic_yield"}, {2e9, 0.0, 0.0, 0.0}, 20e-3, 5.0),
                elastoplastic_impact(contact, 5.0).restitution_squared, 1e-8);
  }
}

}  // namespace
}  // namespace recoil
