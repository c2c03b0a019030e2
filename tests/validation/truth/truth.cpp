#include "validation/truth/truth.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "validation/truth/adhesive_truth.hpp"
#include "validation/truth/ring_adhesion_truth.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

double mass_of(double density, double diameter) {
  return density * pi / 6.0 * diameter * diameter * diameter;
}

RingAdhesionImpact impact_of(const RingAdhesionTruth& truth, double diameter, double velocity) {
  RingAdhesionContact contact;
  contact.stiffness = truth.stiffness;
  contact.adhesion_force =
      truth.adhesion_force * std::cbrt(diameter / truth.reference_diameter);  // eq. 12
  contact.radius = 0.5 * diameter;
  contact.mass = mass_of(truth.density, diameter);
  contact.C_H = truth.C_H;
  contact.C_A = truth.C_A * std::pow(diameter / truth.reference_diameter, truth.C_A_exponent);
  contact.damped_in_both_phases = truth.damped_in_both_phases;
  return ring_adhesion_impact(contact, velocity);
}

double restitution(const RingAdhesionTruth& truth, double diameter, double velocity) {
  return impact_of(truth, diameter, velocity).restitution;
}

double restitution(const AdhesiveTruth& truth, double diameter, double velocity) {
  return adhesive_restitution(
      {truth.jkr, truth.stiffness, truth.work, 0.5 * diameter, mass_of(truth.density, diameter),
       truth.C_H, truth.C_A, truth.damped_in_both_phases},
      velocity);
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
  return std::visit([&](const auto& kind) { return restitution(kind, diameter, velocity); }, truth);
}

double adhesion_share_of_loss(const RingAdhesionTruth& truth, double diameter, double velocity) {
  const RingAdhesionImpact impact = impact_of(truth, diameter, velocity);
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

Truth without_adhesion(Truth truth) {
  if (auto* ring = std::get_if<RingAdhesionTruth>(&truth)) ring->adhesion_force = 0.0;
  if (auto* adhesive = std::get_if<AdhesiveTruth>(&truth)) adhesive->work = 0.0;
  return truth;
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

}  // namespace recoil
