#include "validation/truth/truth.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

TrueImpact impact_of(const Truth& truth, double diameter, double velocity) {
  TrueContact contact;
  contact.law = truth.law;
  contact.stiffness = truth.stiffness;
  contact.adhesion = truth.work;
  contact.radius = 0.5 * diameter;
  contact.mass = truth.density * pi / 6.0 * diameter * diameter * diameter;
  contact.C_H = truth.C_H;
  contact.C_A = truth.C_A;
  contact.damped_in_both_phases = truth.damped_in_both_phases;
  if (truth.law == TrueAdhesion::ring) {
    const double ratio = diameter / truth.reference_diameter;
    contact.adhesion = truth.adhesion_force * std::cbrt(ratio);  // eq. 12
    contact.C_A *= std::pow(ratio, truth.C_A_exponent);
  }
  return true_impact(contact, velocity);
}

/// Eq. 7 [1/Pa].
double compliance_of(const Material& material) {
  return (1.0 - material.poisson_ratio * material.poisson_ratio) / (pi * material.youngs_modulus);
}

/// Eq. 11 (Gilman 1960), with the lengths that the paper gives for every material.
double surface_energy_of(const Material& material) {
  constexpr double lattice = 2.0e-10;  // y0 [m]
  constexpr double reach = 1.3e-10;    // a0 [m]
  return material.surface_energy.value_or(material.youngs_modulus / lattice * (reach / pi) *
                                          (reach / pi));
}

}  // namespace

double true_restitution(const Truth& truth, double diameter, double velocity) {
  return impact_of(truth, diameter, velocity).restitution;
}

double adhesion_share_of_loss(const Truth& truth, double diameter, double velocity) {
  const TrueImpact impact = impact_of(truth, diameter, velocity);
  return impact.adhesion_loss / (1.0 - impact.restitution * impact.restitution);
}

double true_capture_velocity(const Truth& truth, double diameter) {
  const auto rebounds = [&](double v) { return true_restitution(truth, diameter, v) > 0.0; };
  double captured = 1e-3;
  if (rebounds(captured)) throw ComputationError("the truth of the recipe captures nothing");
  double free = 2.0 * captured;
  while (!rebounds(free)) {
    captured = free;
    free *= 2.0;
    if (free > 1000.0) throw ComputationError("the truth of the recipe captures everything");
  }
  while (free - captured > 1e-9 * free) {
    const double middle = 0.5 * (captured + free);
    (rebounds(middle) ? free : captured) = middle;
  }
  return free;
}

DerivedContact derive_recipe_contact(const Material& particle, const Material& surface) {
  DerivedContact contact;
  contact.stiffness = 4.0 / (3.0 * pi * (compliance_of(particle) + compliance_of(surface)));
  contact.reduced_modulus = 0.75 * contact.stiffness;
  contact.adhesion_energy =
      2.0 * std::sqrt(surface_energy_of(particle) * surface_energy_of(surface));
  return contact;
}

double recipe_adhesion_force(double stiffness, double adhesion_energy, double diameter) {
  return std::cbrt(9.0 * adhesion_energy * adhesion_energy * stiffness * diameter / (4.0 * pi));
}

Truth undamped_truth(const Material& particle, const Material& surface, double reference_diameter) {
  const DerivedContact contact = derive_recipe_contact(particle, surface);
  Truth truth;
  truth.density = particle.density;
  truth.stiffness = contact.stiffness;
  truth.reference_diameter = reference_diameter;
  truth.adhesion_force =
      recipe_adhesion_force(contact.stiffness, contact.adhesion_energy, reference_diameter);
  return truth;
}

}  // namespace recoil
