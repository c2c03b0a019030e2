#pragma once

#include "data/system.hpp"
#include "impact/impact.hpp"

namespace recoil {

/// d e^2 / d p for every physical quantity p of an impact, the others constant [1 / unit of p].
struct ImpactSensitivity {
  double diameter = 0.0;          ///< with constant f0 [1/m]
  double velocity = 0.0;          ///< [s/m]
  double density = 0.0;           ///< [m3/kg]
  double stiffness = 0.0;         ///< K [1/Pa]
  double adhesion_force = 0.0;    ///< f0 at this diameter [m/N]
  double hertz_damping = 0.0;     ///< C_H [m/s]
  double adhesion_damping = 0.0;  ///< C_A [m/s]
};

/// Converts the gradient in the groups to physical quantities: alpha = C_H V, gamma = C_A V and
/// beta ~ f0 K^(-3/5) rho^(-2/5) D^(-1) V^(-4/5), which follows from A and B of ImpactGroups.
/// @param impact the impact under `conditions`, with its gradient
ImpactSensitivity impact_sensitivity(const ImpactConditions& conditions,
                                     const ImpactResult& impact);

/// d K / d (elastic constant) of eqs 6 and 7, for a K that is derived and not stated.
struct StiffnessSensitivity {
  double youngs_particle = 0.0, youngs_surface = 0.0;    ///< [1]
  double poisson_particle = 0.0, poisson_surface = 0.0;  ///< [Pa]
};
StiffnessSensitivity stiffness_sensitivity(const ImpactSystem& system);

}  // namespace recoil
