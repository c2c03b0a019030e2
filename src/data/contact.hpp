#pragma once

#include <string>
#include <vector>

#include "data/system.hpp"

namespace recoil {

/// Relative radius R* [m] of two spheres, 1 / R* = 2 / d + 2 / d2 (Johnson 1985, Contact Mechanics,
/// eq. 4.17). With a flat (`second_diameter` 0) it is d / 2.
template <class T>
T relative_radius(const T& diameter, double second_diameter) {
  const T radius = diameter * 0.5;
  return second_diameter > 0.0 ? radius / (1.0 + diameter * (1.0 / second_diameter)) : radius;
}

/// Reduced mass m* [kg] of two spheres, 1 / m* = 1 / m1 + 1 / m2. With a flat (`second_mass` 0) it
/// is m1.
template <class T>
T reduced_mass(const T& mass, double second_mass) {
  return second_mass > 0.0 ? mass / (1.0 + mass * (1.0 / second_mass)) : mass;
}

/// Everything that the impact model derives from the two materials, in SI units. Equation numbers
/// are those of Li, Dunn & Brach (1999), J. Aerosol Sci. 30, 439-449.
///
/// A value that the dataset states is used instead of the derived one. The derived one is kept,
/// too, and `contradictions` has a sentence for every disagreement. One member for each quantity of
/// these equations.
struct ContactProperties {
  double k_particle = 0.0;               ///< eq. 7: k = (1 - nu^2) / (pi E) [1/Pa]
  double k_surface = 0.0;                ///< eq. 7 [1/Pa]
  double gamma_particle = 0.0;           ///< surface energy, stated or eq. 11 [J/m2]
  double gamma_surface = 0.0;            ///< [J/m2]
  double stiffness_derived = 0.0;        ///< eq. 6: K = 4 / (3 pi (k1 + k2)) = (4/3) E* [Pa]
  double stiffness = 0.0;                ///< the K that is used [Pa]
  double adhesion_energy_derived = 0.0;  ///< W_A = 2 sqrt(gamma1 gamma2) [J/m2]
  double adhesion_energy = 0.0;          ///< the W_A that is used [J/m2]
  double equilibrium_radius = 0.0;       ///< eq. 10: a_eq = (6 pi W_A r^2 / K)^(1/3) [m]
  double adhesion_force_derived = 0.0;   ///< eq. 9: f0 = K a_eq^2 / (2 pi r), with the K used [N/m]
  double adhesion_force_materials = 0.0;  ///< the same with `stiffness_derived` [N/m]
  double adhesion_force = 0.0;            ///< the f0 that is used, at the reference diameter [N/m]
  double reference_diameter = 0.0;        ///< [m]
  double particle_density = 0.0;          ///< [kg/m3]
  double surface_diameter = 0.0;          ///< of a second, free sphere [m]; 0: a flat
  double surface_density = 0.0;           ///< of that sphere [kg/m3]
  std::vector<std::string> contradictions;  ///< sentences: what disagrees, which value is used

  /// R* for a sphere of `diameter` [m] on this surface [m].
  double relative_radius(double diameter) const;
  /// m* of such a sphere and this surface [kg].
  double reduced_mass(double diameter, double density) const;
  /// f0 at another diameter by f0 ~ R*^(1/3), eq. 12 [N/m].
  double adhesion_force_at(double f0_reference, double diameter) const;
  /// The sphere whose impact on a flat is equivalent to the impact of the two bodies: its diameter
  /// is 2 R* [m], and its density [kg/m3] gives it the mass m*.
  struct OneSphere {
    double diameter = 0.0, density = 0.0;
  };
  OneSphere as_one_sphere(double diameter, double density) const;
};

/// True if a stated and a derived value differ by more than rounding of printed digits, 2 %.
bool contradicts(double stated, double derived);

/// Derives the contact of `system`.
/// @param reference_diameter of f0 [m], unless the system states one
ContactProperties derive_contact(const ImpactSystem& system, double reference_diameter);

/// Eq. 7: k = (1 - nu^2) / (pi E) [1/Pa].
double compliance(double youngs_modulus, double poisson_ratio);

/// Eq. 6: K = 4 / (3 pi (k1 + k2)) [Pa].
double hertzian_stiffness(double k_particle, double k_surface);

/// Eq. 11, Gilman (1960): an estimate of the surface energy, gamma = (E / y0) (a0 / pi)^2 [J/m2],
/// with the paper's y0 = 2 Angstrom and a0 = 1.3 Angstrom for every material.
double gilman_surface_energy(double youngs_modulus);

/// Eq. 10: contact radius at equilibrium, a_eq = (6 pi W_A r^2 / K)^(1/3) [m].
double equilibrium_contact_radius(double adhesion_energy, double radius, double stiffness);

/// Eq. 9 (and 12): f0 = K a_eq^2 / (2 pi r) [N/m].
double adhesion_force_per_length(double stiffness, double equilibrium_radius, double radius);

/// f0 for a work of adhesion: eqs 9 and 10 together, f0 = (6 pi W)^(2/3) (K r)^(1/3) / (2 pi)
/// [N/m].
double adhesion_force_for(double adhesion_energy, double radius, double stiffness);

/// The inverse of `adhesion_force_for`: W = (2 pi f0)^(3/2) / (6 pi (K r)^(1/2)) [J/m2].
double adhesion_energy_for(double adhesion_force, double radius, double stiffness);

/// Mass of a sphere [kg].
double sphere_mass(double diameter, double density);

}  // namespace recoil
