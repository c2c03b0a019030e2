#pragma once

#include <cmath>

#include "impact/impact.hpp"

namespace recoil {

/// The four contact forces of eq. 5 per m V^2 / n_c, at penetration x = q^2 and approach velocity
/// u.
template <class T>
struct ContactForces {
  T hertz;             ///< -x^(3/2)
  T hertz_damping;     ///< -x^(3/2) alpha u
  T adhesion;          ///< +beta x^(1/2), pulls inward
  T adhesion_damping;  ///< +beta x^(1/2) gamma S, S = -u while it acts, 0 otherwise
};

/// The equation of the model, written once. Any scalar with + and * may run it: the solver's
/// double, or a dual number for the sensitivities.
template <class T>
ContactForces<T> contact_forces(const T& q, const T& u, const T& alpha, const T& beta,
                                const T& gamma, bool adhesion_damping_acts) {
  const T hertz = -(q * q * q);
  const T adhesion = beta * q;
  return {hertz, hertz * alpha * u, adhesion,
          adhesion_damping_acts ? T(-(adhesion * gamma * u)) : T(0.0)};
}

/// du/dsigma of the regularised field, 2 q times the sum of forces (dt = 2 q dsigma).
template <class T>
T regularised_acceleration(const T& q, const T& u, const T& alpha, const T& beta, const T& gamma,
                           bool adhesion_damping_acts) {
  const ContactForces<T> f = contact_forces(q, u, alpha, beta, gamma, adhesion_damping_acts);
  return T(2.0) * q * (f.hertz + f.hertz_damping + f.adhesion + f.adhesion_damping);
}

/// Potential energy (2/5) x^(5/2) - (2/3) beta x^(3/2) [m V^2].
template <class T>
T potential_energy(const T& q, const T& beta) {
  const T q3 = q * q * q;
  return T(0.4) * q3 * q * q - T(2.0 / 3.0) * beta * q3;
}

/// Depth of the adhesive well, the potential energy at x = beta: -(4/15) beta^(5/2) [m V^2].
inline double well_depth(double beta) { return -4.0 / 15.0 * beta * beta * std::sqrt(beta); }

/// True when a sphere on its way out has all but settled in the well: what is left above the bottom
/// is a part `settled_part` of its depth, and the creep towards it needs no more following.
inline bool has_settled(double q, double u, double beta) {
  constexpr double settled_part = 1e-10;
  const double depth = well_depth(beta);
  return 0.5 * u * u + potential_energy(q, beta) - depth < -settled_part * depth;
}

/// Above this (C_H + C_A) V_a nothing turns twice and everything settles: the creep is so stiff
/// that following it step by step costs more than it tells. The well is reached to better than 1e-9
/// of its depth (tests/impact/outcome_test.cpp compares).
inline bool creeps_into_the_well(const ImpactGroups& groups) {
  constexpr double stiff_creep = 20.0;
  return (groups.alpha + groups.gamma) * std::pow(groups.beta, 1.25) > stiff_creep;
}

}  // namespace recoil
