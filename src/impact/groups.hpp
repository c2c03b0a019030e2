#pragma once

namespace recoil {

/// Equilibrium distance z_0 of two surfaces [m], for laws that depend on the range of the forces:
/// 0.4 nm by Johnson & Greenwood (1997), J. Colloid Interface Sci. 192, 326-333, between the
/// spacings of atoms (0.2 to 0.3 nm) and of molecules (0.5 nm) in solids.
inline constexpr double equilibrium_separation = 0.4e-9;

/// The conditions of one impact, in SI units.
struct ImpactConditions {
  double diameter = 0.0;                       ///< of two spheres: see `as_one_sphere` [m]
  double velocity = 0.0;                       ///< incident V [m/s], > 0
  double density = 0.0;                        ///< of the sphere [kg/m3]
  double stiffness = 0.0;                      ///< K [Pa]
  double adhesion_force = 0.0;                 ///< f0 at this diameter [N/m], >= 0
  double hertz_damping = 0.0;                  ///< C_H [s/m], >= 0
  double adhesion_damping = 0.0;               ///< C_A [s/m], >= 0
  double separation = equilibrium_separation;  ///< z_0 of `maugis` [m], > 0
};

/// The dimensionless groups on which e depends. With A = sqrt(r) K / m, B = 2 pi sqrt(r) f0 / m,
/// lengths in n_c = (V^2 / A)^(2/5) and velocities in V, the equation of motion (eq. 5) becomes
///   x'' = -x^(3/2) (1 + alpha u) + beta x^(1/2) (1 + gamma S),
/// S = -u while the adhesion damping acts and otherwise 0. A mechanism may add a dashpot in both
/// phases, -kappa x^(1/2) u (see WithDashpot).
struct ImpactGroups {
  double alpha = 0.0;  ///< C_H V
  double beta = 0.0;   ///< B A^(-3/5) V^(-4/5) = (V / V_a)^(-4/5)
  double gamma = 0.0;  ///< C_A V
  double kappa = 0.0;  ///< of the dashpot; 0 without ImpactOptions::dashpot
  double range = 0.0;  ///< Maugis's lambda, `maugis_parameter`; only MaugisLaw depends on it
};

/// The scales that convert a dimensionless impact to SI units.
struct ImpactScales {
  double length = 0.0;    ///< n_c [m]
  double velocity = 0.0;  ///< V [m/s]
  double time = 0.0;      ///< n_c / V [s]
  double force = 0.0;     ///< m V^2 / n_c [N]
  double energy = 0.0;    ///< m V^2 [J]
};

ImpactGroups impact_groups(const ImpactConditions& conditions);
ImpactScales impact_scales(const ImpactConditions& conditions);

/// The velocity V_a = B^(5/4) A^(-3/4) [m/s] at which adhesion and inertia are of equal size;
/// beta = (V / V_a)^(-4/5). Zero without adhesion.
double adhesion_velocity(const ImpactConditions& conditions);

/// lambda = 2 s0 (r / (pi W K^2))^(1/3) of Maugis (1992). The adhesive stress s0 is the maximum of
/// a Lennard-Jones force with the same W, s0 = 1.0264 W / z_0 = 16 W / (9 sqrt(3) z_0). With eqs 9
/// and 10 for W, lambda is 1.2434 f0 / (K z_0). It is 1.157 times Tabor's parameter (r W^2 / (E*^2
/// z_0^3))^(1/3).
double maugis_parameter(double adhesion_force, double stiffness, double separation);

/// d lambda / d f0 [m/N]; lambda is proportional to f0.
double maugis_parameter_per_force(double stiffness, double separation);

}  // namespace recoil
