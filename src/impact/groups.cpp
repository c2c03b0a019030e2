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
          c.adhesion_damping * c.velocity, 0.0,
          maugis_parameter(c.adhesion_force, c.stiffness, c.separation)};
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

double maugis_parameter_per_force(double stiffness, double separation) {
  // With d = (pi^2 W^2 r / K^2)^(1/3) = 6^(-2/3) n_eq, n_eq = 2 pi f0 / K: lambda = (2 / pi) d /
  // h0, h0 = W / s0.
  static const double stress = 16.0 / (9.0 * std::sqrt(3.0));  // s0 z_0 / W
  static const double per_length = 4.0 * std::pow(6.0, -2.0 / 3.0) * stress;
  return per_length / (stiffness * separation);
}

double maugis_parameter(double adhesion_force, double stiffness, double separation) {
  return maugis_parameter_per_force(stiffness, separation) * adhesion_force;
}

}  // namespace recoil
