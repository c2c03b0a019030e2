#pragma once

#include <string_view>
#include <vector>

namespace recoil::hidden {

inline constexpr double gravity = 9.81;  ///< [m/s2]

/// One kind of sphere on one surface, and the model that the fitter has of it (Li, Dunn & Brach
/// 1999, equation 5, adhesion damped on rebound). SI units.
struct Base {
  double density = 0.0;             ///< of the sphere [kg/m3]
  double youngs_modulus = 0.0;      ///< of the sphere [Pa]
  double poisson_ratio = 0.0;       ///< of the sphere
  double surface_modulus = 0.0;     ///< Young's modulus of the surface [Pa]
  double surface_ratio = 0.0;       ///< Poisson's ratio of the surface
  double surface_density = 0.0;     ///< [kg/m3]
  double reference_diameter = 0.0;  ///< [m]
  double adhesion_force = 0.0;      ///< f0 there [N/m]; f0 ~ d^(1/3)
  double C_H = 0.0;                 ///< [s/m]
  double C_A = 0.0;                 ///< [s/m]

  double stated_stiffness = 0.0;  ///< K [Pa], where it is not (4/3) E* of the moduli

  double stiffness() const;        ///< K [Pa]
  double adhesion_energy() const;  ///< W_A of Gilman's surface energies [J/m2]
};

/// What else acts in the contact itself. Zero: absent.
struct ContactExtras {
  double yield_pressure = 0.0;     ///< p_Y [Pa]
  double hysteresis_energy = 0.0;  ///< dW [J/m2]
  double crack_energy = 0.0;       ///< w_1 [J/m2] at 1 m/s
  double crack_exponent = 0.5;     ///< k
  double bulk_relaxation = 0.0;    ///< A of Kuwabara & Kono [s]
  double plate_mobility = 0.0;     ///< 1 / Z of a thin plate [s/kg]
  double wave_radiation = 0.0;     ///< times what a half-space radiates
  double hysteretic_share = 0.0;   ///< of the elastic energy, not given back
};

/// A sphere at the moment of contact.
struct Sphere {
  double mass = 0.0;            ///< [kg]
  double radius = 0.0;          ///< of the curvature in contact [m]
  double stiffness = 0.0;       ///< K [Pa]
  double adhesion_force = 0.0;  ///< f0 at this size [N/m]
  double C_H = 0.0;
  double C_A = 0.0;
};

/// A sphere of this diameter [m], hard and dry: without adhesion and damping.
Sphere sphere_of(const Base& base, double diameter);

/// Twice the energy per mass that adhesion without damping gives a sphere on its way to the depth
/// at which it would rest, n = 2 pi f0 / K [m2/s2].
double well_depth(const Sphere& sphere);

struct ContactResult {
  bool rebounded = false;
  double square = 0.0;   ///< v^2 on leaving; below zero: -2/m of the energy that is missing [m2/s2]
  double deepest = 0.0;  ///< [m]
};

/// One contact at `velocity` > 0: m n'' = sum of all forces, integrated in time.
ContactResult contact(const Sphere& sphere, const ContactExtras& extras, const Base& base,
                      double velocity);

/// Loading and unloading of an elastic-plastic sphere, see `ElastoplasticContact`.
struct PlasticResult {
  double square = 0.0;  ///< v^2 at zero approach on the way out; below zero: -2/m of the energy
                        ///< that is missing [m2/s2]
  double radius = 0.0;  ///< R_p [m]
};
/// @param work_of_adhesion [J/m2]; 0: none
PlasticResult plastic_contact(double mass, double radius, double stiffness, double yield_pressure,
                              double velocity, double work_of_adhesion);

/// W [J/m2] of the JKR contact that rests at the radius at which f0 holds the sphere: 2 pi a f0 =
/// K a^3 / R = (6 pi W K a^3)^(1/2).
double work_at_rest(const Sphere& sphere);

// ---- second published laws ---------------------------------------------------------------------

/// The effects for which a second published law can make the data: neither that of the catalogue
/// nor that of `contact`.
const std::vector<std::string_view>& effects_with_other_law();

/// Is that law one of a contact without adhesion? Beside adhesion it is used with Dahneke's (1975)
/// balance of energies, which is not good near capture: a dashpot in a contact that adheres
/// takes 1.3 to 1.9 times as much of spheres of 2.6 to 6.9 um there (and 1.05 times at ten times
/// the capture velocity).
bool is_law_of_dry_contact(std::string_view effect);

/// The largest strength up to which the second law of `effect` is good, in the unit of the effect,
/// for spheres of mass and stiffness like `sphere`'s up to `velocity`; infinite where it always is.
double largest_by_other_law(std::string_view effect, const Sphere& sphere, double velocity);

/// Rebound over incident speed of a yielding sphere, from finite elements (Jackson, Green &
/// Marghitu 2010, Nonlinear Dyn. 60, 217-229, equations 31 to 33): with u = V / V_y,
///   e = 1 - 0.1 ln u ((u - 1) / 59)^0.156                             1 < u <= 60,
///   e = 1 - 0.1 ln 60 - 0.11 ln(u / 60) (u - 60)^(2.36 p_Y / (1.6 E*))   beyond;
/// V_y is where the peak pressure of Hertz is p_Y.
double jackson_restitution(const Sphere& sphere, double yield_pressure, double velocity);

/// Of a sphere whose material follows Kuwabara & Kono, to the second order in its relaxation
/// (Ramirez, Poeschel, Brilliantov & Schwager 1999, Phys. Rev. E 60, 4465-4472):
///   e = 1 - b + (3/5) b^2,  b = 1.15344 (3/2) A (K sqrt(R) / m)^(2/5) V^(1/5);
/// the next term, -0.32 b^3 or so, is a hundredth at b = 0.3.
double ramirez_restitution(const Sphere& sphere, double relaxation, double velocity);

/// Of a sphere on a thin plate of mobility 1 / Z: e = exp(-1.719 lambda), lambda = (m / Z) (K
/// sqrt(R) / m)^(2/5) V^(1/5) being Zener's (1941) inelasticity (Boettcher, Russell & Mueller 2017,
/// Int. J. Solids Struct. 106, 229-239), for lambda < 0.25.
double boettcher_restitution(const Sphere& sphere, double plate_mobility, double velocity);

/// Speed that the film between sphere and wall takes, to leading order with the mean free path as
/// the gap at which the continuum ends (Barnocky & Davis 1988, Phys. Fluids 31, 1324-1329):
///   6 pi mu R^2 / m ln(gap / path) [m/s].
double speed_lost_in_film(double mu, const Sphere& sphere, double gap, double path);

}  // namespace recoil::hidden
