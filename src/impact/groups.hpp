#pragma once

namespace recoil {

/// One sphere about to hit one surface, in SI units.
struct ImpactConditions {
  double diameter = 0.0;          ///< [m]
  double velocity = 0.0;          ///< incident V [m/s], > 0
  double density = 0.0;           ///< of the sphere [kg/m3]
  double stiffness = 0.0;         ///< K [Pa]
  double adhesion_force = 0.0;    ///< f0 at this diameter [N/m], >= 0
  double hertz_damping = 0.0;     ///< C_H [s/m], >= 0
  double adhesion_damping = 0.0;  ///< C_A [s/m], >= 0
};

/// The three dimensionless groups on which e depends, and nothing else. With A = sqrt(r) K / m and
/// B = 2 pi sqrt(r) f0 / m, lengths in n_c = (V^2 / A)^(2/5) and velocities in V, the equation of
/// motion (eq. 5) becomes
///   x'' = -x^(3/2) (1 + alpha u) + beta x^(1/2) (1 + gamma S),
/// S = -u while the damping of the adhesion acts and 0 otherwise. A mechanism may add a dashpot
/// that works along the contact radius in both phases, -kappa x^(1/2) u (see BulkDashpotLaw).
struct ImpactGroups {
  double alpha = 0.0;  ///< C_H V
  double beta = 0.0;   ///< B A^(-3/5) V^(-4/5) = (V / V_a)^(-4/5)
  double gamma = 0.0;  ///< C_A V
  double kappa = 0.0;  ///< of the dashpot; other than 0 only with ImpactOptions::dashpot
};

/// The scales that turn the dimensionless impact back into SI units.
struct ImpactScales {
  double length = 0.0;    ///< n_c [m]
  double velocity = 0.0;  ///< V [m/s]
  double time = 0.0;      ///< n_c / V [s]
  double force = 0.0;     ///< m V^2 / n_c [N]
  double energy = 0.0;    ///< m V^2 [J]
};

ImpactGroups impact_groups(const ImpactConditions& conditions);
ImpactScales impact_scales(const ImpactConditions& conditions);

/// The velocity at which adhesion and inertia balance, V_a = B^(5/4) A^(-3/4) [m/s];
/// beta = (V / V_a)^(-4/5). Zero without adhesion.
double adhesion_velocity(const ImpactConditions& conditions);

}  // namespace recoil
