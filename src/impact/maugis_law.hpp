#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "impact/force_law.hpp"
#include "impact/maugis_contact.hpp"
#include "impact/maugis_path.hpp"

namespace recoil {

/// The contact of Maugis (1992), MaugisContact, from the first attraction to the last, with the two
/// dampings of eq. 5: C_H on its elastic part a^3, C_A on its adhesive part. It becomes JkrLaw as
/// lambda grows. As lambda vanishes it becomes DmtLaw and the attraction across the gap W / s0
/// before and after, which the others leave out and which costs nothing without damping.
///
/// The adhesive stress sets in where the gap falls to W / s0, at the approach n = -W / s0; V is the
/// velocity there. An undamped impact loses what jumping in and out costs, from 0 to 7.0922 (W^5
/// r^4 / E*^2)^(1/3).
///
/// With q = s / scale and dt = (dn / dq) dsigma,
///   dq/dsigma = u,  du/dsigma = -Lambda (dn/dq) [a^3 (1 + alpha u) - P_a (1 + gamma S)],
/// in the units of Maugis for n, a and P_a. Lambda = 6^(-5/3) beta^(5/2), where beta is that of the
/// f0 that eqs 9 and 10 have for this W. The scale is a unit, held where derivatives in lambda are
/// taken.
struct MaugisLaw {
  static constexpr unsigned groups = 4;  ///< alpha, Lambda, gamma, lambda
  /// Scale; lambda, energy at release and its slope; whether there is a gap (LawPath::seam).
  static constexpr unsigned constants = 5;
  static constexpr std::array<std::size_t, groups> places = {0, 1, 2, 4};
  static constexpr double tolerance_share = 0.1;  ///< of the fast solver, per step

  static double strength(const ImpactGroups& g) {
    return std::pow(6.0, -5.0 / 3.0) * g.beta * g.beta * std::sqrt(g.beta);
  }
  /// d Lambda / d beta
  static double strength_slope(const ImpactGroups& g) {
    return 2.5 * std::pow(6.0, -5.0 / 3.0) * g.beta * std::sqrt(g.beta);
  }
  static std::array<double, groups> groups_of(const ImpactGroups& g) {
    return {g.alpha, strength(g), g.gamma, g.range};
  }
  static std::array<double, constants> constants_of(const ImpactGroups& g) {
    const MaugisPath path = maugis_path(g.range);
    return {path.scale, g.range, path.energy_at_release, path.energy_slope,
            path.start < 0.0 ? 1.0 : 0.0};
  }
  static LawPath path_of(const ImpactGroups& g) {
    const MaugisPath path = maugis_path(g.range);
    return {.start = path.start / path.scale,
            .release = path.release / path.scale,
            .resting = path.resting / path.scale,
            .deepest = deepest_of(g) / path.scale,
            .range_slope = path.start_slope / path.scale,
            .seam = path.release < 0.0};
  }

  template <class Q, class U, class Acts, class Alpha, class Strength, class Gamma, class Lambda,
            class Constant>
  static auto acceleration(const Q& q, const U& u, const Acts& acts, const Alpha& alpha,
                           const Strength& strength, const Gamma& gamma, const Lambda& lambda,
                           const Constant& scale, const Constant&, const Constant&, const Constant&,
                           const Constant& gap) {
    const MaugisContact<Q, Lambda> contact(Q(q * scale), lambda, gap);
    const auto rate = contact.rate() * scale;
    const auto push = -(rate * contact.elastic());
    const auto pull = rate * contact.adhesive();
    return strength * ((push + pull) + push * (alpha * u) + -(pull * (acts * (gamma * u))));
  }
  /// Zero at the release, where the sphere has parted.
  template <class Q, class Alpha, class Strength, class Gamma, class Lambda, class Constant>
  static auto potential(const Q& q, const Alpha&, const Strength& strength, const Gamma&,
                        const Lambda& lambda, const Constant& scale, const Constant& at,
                        const Constant& energy, const Constant& slope, const Constant& gap) {
    const MaugisContact<Q, Lambda> contact(Q(q * scale), lambda, gap);
    return strength * (contact.energy() + -((lambda + -at) * slope + energy));
  }
  /// As under DmtLaw, whether a sphere creeps into the well has to be followed.
  static double depth(const ImpactGroups& g) {
    return strength(g) * maugis_path(g.range).energy_at_rest;
  }

  /// n [n_c], dn / dq and the four forces [m V^2 / n_c].
  static double penetration(double q, double, double strength, double, double lambda, double scale,
                            double, double, double, double gap) {
    return std::pow(strength, 0.4) *
           MaugisContact<double, double>(q * scale, lambda, gap).approach();
  }
  static double clock(double q, double, double strength, double, double lambda, double scale,
                      double, double, double, double gap) {
    return std::pow(strength, 0.4) * scale *
           MaugisContact<double, double>(q * scale, lambda, gap).rate();
  }
  static ContactForces<double, double, double, double> forces(double q, double u, double acts,
                                                              double alpha, double strength,
                                                              double gamma, double lambda,
                                                              double scale, double, double, double,
                                                              double gap) {
    const MaugisContact<double, double> contact(q * scale, lambda, gap);
    const double unit = std::pow(strength, 0.6);
    const double hertz = -unit * contact.elastic();
    const double adhesion = unit * contact.adhesive();
    return {hertz, hertz * alpha * u, adhesion, -adhesion * acts * gamma * u};
  }
  /// The largest energy on the way [m V^2]: of the elastic part, or of the adhesion over the way.
  static double largest_energy(double q, double, double strength, double, double lambda,
                               double scale, double, double, double, double gap) {
    const MaugisContact<double, double> contact(q * scale, lambda, gap);
    const double radius = std::cbrt(contact.elastic());
    return strength *
           std::max(0.4 * std::pow(radius, 5), contact.adhesive() * std::abs(contact.approach()));
  }
  /// Where potential and kinetic energy are below `energy`, about the release and u = 0.
  static double cusp_radius(const ImpactGroups& g, double energy) {
    const MaugisPath path = maugis_path(g.range);
    const double curvature = path.cusp * path.scale * path.scale * strength(g);
    return std::sqrt(energy / std::max(curvature, 0.5));
  }

  /// s where c / a is as close to 1 as it is there: with t = 1 / s small the equation for c says
  /// s^3 = (2/3) lambda a^2 + (2/3) lambda^2 a s. The a is that of JkrLaw.
  static double deepest_of(const ImpactGroups& g) {
    const double hertz =
        6.0 * 1.069234599991188 / (std::sqrt(g.beta) * std::sqrt(std::sqrt(g.beta)));
    const double root = std::cbrt(10.0 + hertz);
    const double radius = 0.5503212081491045 * root * root;
    const double part = 2.0 / 3.0 * g.range * radius;
    return std::sqrt(part * g.range + std::cbrt(part * radius * part * radius));
  }

  /// Below these it is Hertz's contact: V beyond 1e10 V_a, or bodies that attract each other over
  /// a million times the depth to which adhesion alone presses them.
  static constexpr double least_beta = 1e-8;
  static constexpr double least_range = 1e-6;
  static constexpr double largest_range = 1e6;  ///< no solid comes near
};

}  // namespace recoil
