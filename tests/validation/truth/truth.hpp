#pragma once

#include "data/system.hpp"
#include "validation/truth/impact_truth.hpp"

namespace recoil {

/// What makes the impacts of spheres of every size, see `TrueContact`.
struct Truth {
  TrueAdhesion law = TrueAdhesion::ring;
  double density = 0.0;             ///< of the sphere [kg/m3]
  double stiffness = 0.0;           ///< K [Pa]
  double adhesion_force = 0.0;      ///< ring: f0 at `reference_diameter` [N/m]; f0 ~ d^(1/3)
  double reference_diameter = 0.0;  ///< ring [m]
  double work = 0.0;                ///< JKR and DMT: W [J/m2]
  double C_H = 0.0;                 ///< [s/m]
  double C_A = 0.0;                 ///< at `reference_diameter` [s/m]
  double C_A_exponent = 0.0;        ///< ring: q, C_A ~ d^q [1]; the paper's model has 0
  bool damped_in_both_phases = false;
};

/// Noiseless restitution e [1] of one sphere of `diameter` [m] at `velocity` [m/s]; 0 when
/// captured.
double true_restitution(const Truth& truth, double diameter, double velocity);

/// What the damping of the adhesion takes, of the energy that one impact loses [1].
double adhesion_share_of_loss(const Truth& truth, double diameter, double velocity);

/// The velocity below which a sphere of `diameter` [m] is captured [m/s], to a relative 1e-9.
/// @throws ComputationError when nothing is captured, or everything is up to 1000 m/s.
double true_capture_velocity(const Truth& truth, double diameter);

/// Eq. 6, 7, 9 to 12 of Li, Dunn & Brach (1999) from the two materials.
struct DerivedContact {
  double reduced_modulus = 0.0;  ///< E* = (3/4) K [Pa]
  double stiffness = 0.0;        ///< eq. 6: K = 4 / (3 pi (k1 + k2)) [Pa]
  double adhesion_energy = 0.0;  ///< W_A = 2 sqrt(gamma1 gamma2), Gilman's gamma where none is
                                 ///< stated (eq. 11) [J/m2]
};
DerivedContact derive_recipe_contact(const Material& particle, const Material& surface);

/// Eq. 12: f0 = (9 W_A^2 K r / (2 pi))^(1/3) [N/m], the same as 9 and 10 together.
double recipe_adhesion_force(double stiffness, double adhesion_energy, double diameter);

/// The ring-adhesion model of two materials by these equations, f0 at `reference_diameter` [m]; not
/// damped yet.
Truth undamped_truth(const Material& particle, const Material& surface, double reference_diameter);

}  // namespace recoil
