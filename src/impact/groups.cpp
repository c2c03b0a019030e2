#include "impact/groups.hpp"

#include <cmath>
#include <numbers>

#include "data/contact.hpp"

namespace recoil {
namespace {

/// A and B of eq. 5 per unit mass: n'' = -A n^(3/2) + B n^(1/2).
struct ForceCoefficients {
  double A;  // [m^(-1/2) s^-2]
  double B;  // [m^(1/2) s^-2]
};

ForceCoefficients coefficients(const ImpactConditions& c) {
  const double root_radius = std::sqrt(c.diameter / 2.0);
  const double mass = sphere_mass(c.diameter, c.density);
  return {root_radius * c.stiffness / mass,
          2.0 * std::numbers::pi * root_radius * c.adhesion_force / mass};
}

}  // namespace

ImpactGroups impact_groups(const ImpactConditions& c) {
  const auto [A, B] = coefficients(c);
  return {c.hertz_damping * c.velocity, B * std::pow(A, -0.6) * std::pow(c.velocity, -0.8),
          c.adhesion_damping * c.velocity};
}

ImpactScales impact_scales(const ImpactConditions& c) {
  const double length = std::pow(c.velocity * c.velocity / coefficients(c).A, 0.4);
  const double energy = sphere_mass(c.diameter, c.density) * c.velocity * c.velocity;
  return {length, c.velocity, length / c.velocity, energy / length, energy};
}

double adhesion_velocity(const ImpactConditions& c) {
  const auto [A, B] = coefficients(c);
  return std::pow(B, 1.25) * std::pow(A, -0.75);
}

}  // namespace recoil
