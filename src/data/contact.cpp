#include "data/contact.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/units.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

// Gilman (1960) as used by Li, Dunn & Brach (1999), below eq. 11, who call both lengths
// approximate.
constexpr double gilman_y0 = 2.0e-10;  // equilibrium lattice constant [m]
constexpr double gilman_a0 = 1.3e-10;  // elastic distance of the attractive force [m]

// A larger relative difference of a stated and a derived value is more than rounding [1].
constexpr double contradiction_tolerance = 0.02;

}  // namespace

bool contradicts(double stated, double derived) {
  return std::abs(stated - derived) > contradiction_tolerance * std::abs(derived);
}

double compliance(double youngs_modulus, double poisson_ratio) {
  return (1.0 - poisson_ratio * poisson_ratio) / (pi * youngs_modulus);
}

double hertzian_stiffness(double k_particle, double k_surface) {
  return 4.0 / (3.0 * pi * (k_particle + k_surface));
}

double gilman_surface_energy(double youngs_modulus) {
  return youngs_modulus / gilman_y0 * std::pow(gilman_a0 / pi, 2);
}

double equilibrium_contact_radius(double adhesion_energy, double radius, double stiffness) {
  return std::cbrt(6.0 * pi * adhesion_energy * radius * radius / stiffness);
}

double adhesion_force_per_length(double stiffness, double equilibrium_radius, double radius) {
  return stiffness * equilibrium_radius * equilibrium_radius / (2.0 * pi * radius);
}

double adhesion_force_for(double adhesion_energy, double radius, double stiffness) {
  const double radius_at_rest = equilibrium_contact_radius(adhesion_energy, radius, stiffness);
  return adhesion_force_per_length(stiffness, radius_at_rest, radius);
}

double adhesion_energy_for(double adhesion_force, double radius, double stiffness) {
  return std::pow(2.0 * pi * adhesion_force, 1.5) / (6.0 * pi * std::sqrt(stiffness * radius));
}

double sphere_mass(double diameter, double density) {
  return density * pi / 6.0 * diameter * diameter * diameter;
}

double ContactProperties::relative_radius(double diameter) const {
  return recoil::relative_radius(diameter, surface_diameter);
}

double ContactProperties::reduced_mass(double diameter, double density) const {
  return recoil::reduced_mass(sphere_mass(diameter, density),
                              sphere_mass(surface_diameter, surface_density));
}

double ContactProperties::adhesion_force_at(double f0_reference, double diameter) const {
  return f0_reference * std::cbrt(relative_radius(diameter) / relative_radius(reference_diameter));
}

ContactProperties::OneSphere ContactProperties::as_one_sphere(double diameter,
                                                              double density) const {
  if (surface_diameter == 0.0) return {diameter, density};
  const double equal = 2.0 * relative_radius(diameter);
  return {equal, reduced_mass(diameter, density) / sphere_mass(equal, 1.0)};
}

ContactProperties derive_contact(const ImpactSystem& system, double reference_diameter) {
  ContactProperties contact;
  contact.reference_diameter = system.reference_diameter.value_or(reference_diameter);
  contact.particle_density = system.particle.density;
  contact.surface_diameter = system.surface_diameter.value_or(0.0);
  contact.surface_density = system.surface.density;
  const double radius = contact.relative_radius(contact.reference_diameter);

  contact.k_particle = compliance(system.particle.youngs_modulus, system.particle.poisson_ratio);
  contact.k_surface = compliance(system.surface.youngs_modulus, system.surface.poisson_ratio);
  contact.stiffness_derived = hertzian_stiffness(contact.k_particle, contact.k_surface);
  contact.stiffness = system.stiffness_K.value_or(contact.stiffness_derived);
  if (contradicts(contact.stiffness, contact.stiffness_derived)) {
    contact.contradictions.push_back(fmt::format(
        "stiffness_K = {:.4g} GPa is stated, but the elastic constants give K = {:.4g} GPa (a "
        "factor of {:.3g}); the stated K = {:.4g} GPa is used",
        contact.stiffness / units::GPa, contact.stiffness_derived / units::GPa,
        contact.stiffness / contact.stiffness_derived, contact.stiffness / units::GPa));
  }

  contact.gamma_particle = system.particle.surface_energy.value_or(
      gilman_surface_energy(system.particle.youngs_modulus));
  contact.gamma_surface =
      system.surface.surface_energy.value_or(gilman_surface_energy(system.surface.youngs_modulus));
  contact.adhesion_energy_derived = 2.0 * std::sqrt(contact.gamma_particle * contact.gamma_surface);
  contact.adhesion_energy = system.adhesion_energy.value_or(contact.adhesion_energy_derived);
  if (contact.adhesion_energy > 0.0 &&
      contradicts(contact.adhesion_energy, contact.adhesion_energy_derived)) {
    contact.contradictions.push_back(fmt::format(
        "adhesion_energy = {:.4g} J/m2 is stated, but the two surface energies give W_A = {:.4g} "
        "J/m2; the stated W_A is used",
        contact.adhesion_energy, contact.adhesion_energy_derived));
  }

  contact.equilibrium_radius =
      equilibrium_contact_radius(contact.adhesion_energy, radius, contact.stiffness);
  contact.adhesion_force_derived =
      adhesion_force_per_length(contact.stiffness, contact.equilibrium_radius, radius);
  contact.adhesion_force_materials =
      adhesion_force_for(contact.adhesion_energy, radius, contact.stiffness_derived);
  contact.adhesion_force = system.adhesion_force_f0.value_or(contact.adhesion_force_derived);
  if (contradicts(contact.adhesion_force, contact.adhesion_force_derived)) {
    contact.contradictions.push_back(fmt::format(
        "adhesion_force_f0 = {:.4g} N/m is stated, but eq. 12 gives f0 = {:.4g} N/m with the K "
        "that is used and {:.4g} N/m with the K of the elastic constants; the stated f0 = {:.4g} "
        "N/m is used",
        contact.adhesion_force, contact.adhesion_force_derived, contact.adhesion_force_materials,
        contact.adhesion_force));
  }
  return contact;
}

}  // namespace recoil
