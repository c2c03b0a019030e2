#pragma once

#include <string>
#include <vector>

#include "data/system.hpp"

namespace recoil {

/// 1 / R* = 2 / d + 2 / d2 (Johnson 1985, Contact Mechanics, eq. 4.17) [m]; d / 2 where
/// `second_diameter` is 0, a flat.
template <class T>
T relative_radius(const T& diameter, double second_diameter) {
  const T radius = diameter * 0.5;
  return second_diameter > 0.0 ? radius / (1.0 + diameter * (1.0 / second_diameter)) : radius;
}

/// 1 / m* = 1 / m1 + 1 / m2 [kg]; m1 where `second_mass` is 0, a flat.
template <class T>
T reduced_mass(const T& mass, double second_mass) {
  return second_mass > 0.0 ? mass / (1.0 + mass * (1.0 / second_mass)) : mass;
}

/// Everything that the impact model derives from the two materials, in SI units. Equation numbers
/// are those of Li, Dunn & Brach (1999), J. Aerosol Sci. 30, 439-449.
///
/// A value stated by the dataset wins over the derived one; the derived one is kept beside it, and
/// a disagreement becomes a sentence in `contradictions`.
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
  std::vector<std::string> contradictions;  ///< what disagrees, and which value is used

  /// R* where a sphere of `diameter` [m] touches [m].
  double relative_radius(double diameter) const;
  /// m* of the relative motion [kg].
  double reduced_mass(double diameter, double density) const;
  /// f0 at another diameter by f0 ~ R*^(1/3), eq. 12 [N/m].
  double adhesion_force_at(double f0_reference, double diameter) const;
  /// The sphere that moves against a flat as the bodies move against one another: its diameter is
  /// 2 R* [m], and its density gives it the mass m* [kg/m3].
  struct OneSphere {
    double diameter = 0.0, density = 0.0;
  };
  OneSphere as_one_sphere(double diameter, double density) const;
};

/// Do a stated and a derived value differ by more than the rounding of printed digits, 2 %?
bool contradicts(double stated, double derived);

/// Derives the contact of `system` with f0 at `reference_diameter` [m] (the system's own, when it
/// states one).
ContactProperties derive_contact(const ImpactSystem& system, double reference_diameter);

/// Eq. 7: k = (1 - nu^2) / (pi E) [1/Pa].
double compliance(double youngs_modulus, double poisson_ratio);

/// Eq. 6: K = 4 / (3 pi (k1 + k2)) [Pa].
double hertzian_stiffness(double k_particle, double k_surface);

/// Eq. 11, Gilman (1960): gamma = (E / y0) (a0 / pi)^2 [J/m2] with the paper's y0 = 2 Angstrom and
/// a0 = 1.3 Angstrom for every material; an estimate that makes W_A proportional to sqrt(E1 E2).
double gilman_surface_energy(double youngs_modulus);

/// Eq. 10: contact radius at equilibrium, a_eq = (6 pi W_A r^2 / K)^(1/3) [m].
double equilibrium_contact_radius(double adhesion_energy, double radius, double stiffness);

/// Eq. 9 (and 12): f0 = K a_eq^2 / (2 pi r) [N/m].
double adhesion_force_per_length(double stiffness, double equilibrium_radius, double radius);

/// f0 for a work of adhesion: eqs 9 and 10 together, f0 = (6 pi W)^(2/3) (K r)^(1/3) / (2 pi)
/// [N/m].
double adhesion_force_for(double adhesion_energy, double radius, double stiffness);

/// Its inverse: W = (2 pi f0)^(3/2) / (6 pi (K r)^(1/2)) [J/m2].
double adhesion_energy_for(double adhesion_force, double radius, double stiffness);

/// Mass of a sphere [kg].
double sphere_mass(double diameter, double density);

}  // namespace recoil
