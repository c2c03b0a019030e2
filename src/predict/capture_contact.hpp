#pragma once

#include "data/contact.hpp"

namespace recoil {

/// What the older capture models ask of one sphere on one surface, in SI units.
struct CaptureContact {
  double diameter = 0.0;         ///< [m]
  double density = 0.0;          ///< of the sphere [kg/m3]
  double reduced_modulus = 0.0;  ///< E* = (3/4) K [Pa]
  double adhesion_energy = 0.0;  ///< w = W_A, the work of adhesion [J/m2]

  double radius() const { return diameter / 2.0; }
  double mass() const { return sphere_mass(diameter, density); }  ///< [kg]
};

/// The contact of a dataset, with the K that its fit uses, at another diameter [m].
CaptureContact capture_contact(const ContactProperties& contact, double diameter);

}  // namespace recoil
