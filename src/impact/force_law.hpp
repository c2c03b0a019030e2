#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "impact/impact.hpp"

namespace recoil {

/// The four contact forces of eq. 5 per m V^2 / n_c, at penetration x = q^2 and approach velocity
/// u. They differ in type where they carry different derivatives.
template <class Hertz, class HertzDamping, class Adhesion, class AdhesionDamping>
struct ContactForces {
  Hertz hertz;                       ///< -x^(3/2)
  HertzDamping hertz_damping;        ///< -x^(3/2) alpha u
  Adhesion adhesion;                 ///< +beta x^(1/2), pulls inward
  AdhesionDamping adhesion_damping;  ///< +beta x^(1/2) gamma S, S = -u while it acts, else 0
};
template <class H, class HD, class A, class AD>
ContactForces(H, HD, A, AD) -> ContactForces<H, HD, A, AD>;

using PlainForces = ContactForces<double, double, double, double>;

/// The equation of the model for any number type with + and *: double, a dual number, one impact
/// per lane of a SIMD register, or such lanes with partial derivatives.
/// @param acts 1 while the adhesion damping acts, else 0
template <class Q, class U, class Alpha, class Beta, class Gamma, class Acts>
constexpr auto contact_forces(const Q& q, const U& u, const Alpha& alpha, const Beta& beta,
                              const Gamma& gamma, const Acts& acts) {
  const Q hertz = -(q * q * q);
  const auto adhesion = q * beta;
  return ContactForces{hertz, hertz * (alpha * u), adhesion, -(adhesion * (acts * (gamma * u)))};
}

/// du/dsigma of the regularised field, 2 q times the sum of forces (dt = 2 q dsigma).
template <class Q, class U, class Alpha, class Beta, class Gamma, class Acts>
constexpr auto regularised_acceleration(const Q& q, const U& u, const Alpha& alpha,
                                        const Beta& beta, const Gamma& gamma, const Acts& acts) {
  const auto f = contact_forces(q, u, alpha, beta, gamma, acts);
  const Q twice_q = q + q;
  return twice_q * (f.hertz + f.hertz_damping + f.adhesion + f.adhesion_damping);
}

/// Potential energy (2/5) x^(5/2) - (2/3) beta x^(3/2) [m V^2].
template <class Q, class Beta>
constexpr auto potential_energy(const Q& q, const Beta& beta) {
  const Q q3 = q * q * q;
  const Q hertz = 0.4 * q3 * q * q;
  const Q per_beta = -2.0 / 3.0 * q3;
  return hertz + per_beta * beta;
}

/// Depth of the adhesive well, the potential energy at x = beta: -(4/15) beta^(5/2) [m V^2].
inline double well_depth(double beta) { return -4.0 / 15.0 * beta * beta * std::sqrt(beta); }

/// A sphere on its way out counts as resting at the bottom of the well if its energy above the
/// bottom is less than this part of the depth.
inline constexpr double settled_part = 1e-10;

/// True if the sphere creeps into the well of the ring law without an outer turning point:
/// (C_H + C_A) V_a >= 2, the critical damping of small motions about the bottom (x'' + (alpha +
/// gamma) beta^(3/2) x' + beta^(1/2) (x - beta) = 0, where a dashpot adds kappa beta^(1/2) x').
/// That this holds at every incident velocity was found by integration from V / V_a = 1e-3 to 1e4,
/// and is not proved (tests/impact/outcome_test.cpp compares with the reference).
inline bool is_overdamped(const ImpactGroups& groups) {
  constexpr double critical_damping = 2.0;
  const double fourth_root = std::sqrt(std::sqrt(groups.beta));
  const double damping = (groups.alpha + groups.gamma) * groups.beta + groups.kappa;
  return damping * fourth_root >= critical_damping;
}

/// The beginning, the end and other places of an impact, in the q of its law.
struct LawPath {
  double start = 0.0;        ///< first contact
  double release = 0.0;      ///< end of the contact, where du/dsigma and the potential energy are 0
  double resting = 0.0;      ///< the bottom of the well, where a captured sphere comes to rest
  double deepest = 0.0;      ///< slightly beyond the deepest point of an undamped impact
  double range_slope = 0.0;  ///< d start / d (the group `range`)
  /// True if the law differs on the two sides of q = 0. It is smooth on each side, and the last of
  /// its constants is 1 for q < 0 and otherwise 0.
  bool seam = false;
};

/// A point of an undamped impact in the units of Maugis: energies in pi W r (pi^2 W^2 r /
/// K^2)^(1/3), contact radii in (pi W r^2 / K)^(1/3).
template <class T>
struct LawPlace {
  T energy;  ///< of the bodies and the adhesion
  T square;  ///< a^2
  T stored;  ///< elastic energy of the bodies, without that of the surfaces
};

/// The range in which deepest_contact searches for the deepest point of an undamped impact, in the
/// coordinate of `place_at` of the law.
struct DeepestSearch {
  double start_energy = 0.0;        ///< at the beginning of the impact
  double start_energy_slope = 0.0;  ///< its derivative in lambda
  double from = 0.0, to = 0.0;      ///< they enclose the deepest point
};

/// V*^2 [m2/s2] of a law without loss in an undamped impact: the loss is J times the damping.
inline double small_damping_square(double J, double C_H, double C_A, bool both_phases,
                                   double scale) {
  const double damping = (both_phases ? 2.0 : 1.0) * C_A + 2.0 * C_H;
  return 2.0 * J * damping * scale * scale * scale;
}

/// Common to laws with Hertz's contact radius, x = q^2.
struct HertzRadius {
  /// A dashpot proportional to the contact radius, the force -kappa x^(1/2) u, adds -kappa u times
  /// this to du/dsigma. kappa is in units of `dashpot_unit`, which is proportional to beta to the
  /// power `dashpot_power`.
  template <class Q, class... Values>
  static constexpr auto dashpot_weight(const Q& q, const Values&...) {
    return (q + q) * q;
  }
  static double dashpot_unit(const ImpactGroups&) { return 1.0; }
  static constexpr double dashpot_power = 0.0;

  /// x [n_c] and dx / dq.
  static double penetration(double q, double, double, double) { return q * q; }
  static double clock(double q, double, double, double) { return 2.0 * q; }
};

/// The ring law of Li, Dunn & Brach (1999) for solvers of any number type. The other laws have the
/// same members. After q and u their functions take `groups` numbers, for which the gradient is
/// computed, and `constants` numbers, for which it is not. `strength` is the group that measures
/// the adhesion.
struct RingAdhesionLaw : HertzRadius {
  static constexpr std::string_view equation = "Li, Dunn & Brach (1999), eq. 5";
  static constexpr std::string_view description =
      "Hertz contact with ring adhesion 2 pi {a} {f0} and damping {C_H}, {C_A} (Li, Dunn & Brach "
      "1999, eq. 5)";
  static constexpr std::string_view elastic_part = "Hertz, K r^(1/2) n^(3/2)";
  static constexpr std::string_view adhesive_part =
      "2 pi a f0 along the edge of the contact (Li, Dunn & Brach 1999, eq. 5)";
  static constexpr std::string_view undamped_loss = "loses nothing";
  static constexpr bool by_force = true, jumps = false, has_range = false;
  static constexpr bool attracts_at_distance = false, has_dashpot = true, exportable = true;
  static constexpr bool quick_to_fit = true;
  static double capture_square(double C_H, double C_A, bool both_phases, double scale) {
    return small_damping_square(0.827350, C_H, C_A, both_phases, scale);
  }

  static constexpr unsigned groups = 3;  ///< alpha, beta, gamma
  static constexpr unsigned constants = 0;
  static constexpr std::array<std::size_t, groups> places = {0, 1, 2};  ///< in ImpactResult
  static constexpr double tolerance_share = 1.0;  ///< of the fast solver, per step

  static double strength(const ImpactGroups& g) { return g.beta; }
  static double strength_slope(const ImpactGroups&) { return 1.0; }
  static std::array<double, groups> groups_of(const ImpactGroups& g) {
    return {g.alpha, g.beta, g.gamma};
  }
  static std::array<double, constants> constants_of(const ImpactGroups&) { return {}; }
  /// At the deepest point x = (5/3) beta + (5/4) x^(-3/2), less than with x = (5/4)^(2/5).
  static LawPath path_of(const ImpactGroups& g) {
    return {.resting = std::sqrt(g.beta),
            .deepest = std::sqrt(5.0 / 3.0 * g.beta + 1.0933620739432781)};
  }

  template <class Q, class U, class Alpha, class Beta, class Gamma, class Acts>
  static constexpr auto acceleration(const Q& q, const U& u, const Acts& acts, const Alpha& alpha,
                                     const Beta& beta, const Gamma& gamma) {
    return regularised_acceleration(q, u, alpha, beta, gamma, acts);
  }
  /// The two parts of `acceleration`: the elastic one with C_H, and the adhesive one with C_A.
  template <class Q, class U, class Alpha, class Beta, class Gamma>
  static constexpr auto push(const Q& q, const U& u, const Alpha& alpha, const Beta&,
                             const Gamma&) {
    const Q hertz = -2.0 * (q * q * (q * q));
    return hertz + hertz * (alpha * u);
  }
  template <class Q, class U, class Acts, class Alpha, class Beta, class Gamma>
  static constexpr auto pull(const Q& q, const U& u, const Acts& acts, const Alpha&,
                             const Beta& beta, const Gamma& gamma) {
    const auto adhesion = (2.0 * (q * q)) * beta;
    return adhesion + -(adhesion * (acts * (gamma * u)));
  }
  template <class Q, class Alpha, class Beta, class Gamma>
  static constexpr auto potential(const Q& q, const Alpha&, const Beta& beta, const Gamma&) {
    return potential_energy(q, beta);
  }
  static bool admits(const ImpactGroups&) { return true; }
  static bool vanishes(const ImpactGroups&) { return false; }
  static bool overdamped(const ImpactGroups& g) { return is_overdamped(g); }
  static double depth(const ImpactGroups& g) { return well_depth(g.beta); }
  /// True if a dashpot that never pulls keeps pushing, because a sphere at rest at the deepest
  /// point does not become fast enough: where elastic force and dashpot balance, the adhesion slows
  /// it down more than the line of this balance falls.
  static bool holds(const ImpactGroups& g) {
    return g.beta * g.kappa * g.kappa >= path_of(g).deepest;
  }

  /// The four forces [m V^2 / n_c].
  static PlainForces forces(double q, double u, double acts, double alpha, double beta,
                            double gamma) {
    return contact_forces(q, u, alpha, beta, gamma, acts);
  }
  /// The larger of the elastic and the adhesive energy [m V^2].
  static double largest_energy(double q, double, double beta, double) {
    return std::max(0.4 * std::pow(q, 5), 2.0 / 3.0 * beta * q * q * q);
  }
  /// The radius about the release and u = 0 within which potential energy, (2/3) beta q^3, and
  /// kinetic energy, u ~ q^(3/2), are below `energy`.
  static double cusp_radius(const ImpactGroups& g, double energy) {
    return std::cbrt(energy / std::max(g.beta, 1.0));
  }
};

}  // namespace recoil
