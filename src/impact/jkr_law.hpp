#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "impact/force_law.hpp"

namespace recoil {

/// The contact of Johnson, Kendall & Roberts (1971), Proc. R. Soc. A 324, 301-313, with the two
/// dampings of eq. 5: C_H on the elastic part, C_A on the adhesive part. With the contact radius a,
///   P = K a^3 / r - (6 pi W K a^3)^(1/2),   n = a^2 / r - (8 pi W a / (3 K))^(1/2):
/// The contact forms at n = 0 with a finite radius and breaks at the smallest n, below zero, so
/// that an undamped impact loses the work in between, 7.0922 (W^5 r^4 / E*^2)^(1/3).
///
/// In z = (a / a_p)^(1/2), a_p the radius at which it breaks, and with dt = (dn / dz) dsigma, the
/// equation of motion is a polynomial:
///   dz/dsigma = u,  du/dsigma = -lambda (z^3 - 1) [z^6 (1 + alpha u) - 6 z^3 (1 + gamma S)],
/// from z = 4^(1/3) to the release at z = 1. lambda = 4 6^(-10/3) beta^(5/2), where beta is that of
/// the f0 that eqs 9 and 10 have for this W: both laws depend on the same three groups. q = z - 1.
///
/// e^2 is as accurate as under the ring law, and so is its gradient for beta > 1e-3. Below (V
/// beyond 5000 V_a) the slope in beta is proportional to beta^(-1/4), and the relative difference
/// of the solvers is 1e-4.
struct JkrLaw {
  static constexpr std::string_view equation = "Johnson, Kendall & Roberts (1971), damped";
  static constexpr std::string_view description =
      "Contact of Johnson, Kendall & Roberts (1971) with the work of adhesion {W}; damping {C_H} "
      "on "
      "its elastic part, {C_A} on its adhesive part";
  static constexpr std::string_view elastic_part = "K a^3 / r";
  static constexpr std::string_view adhesive_part =
      "(6 pi W K a^3)^(1/2) (Johnson, Kendall & Roberts 1971)";
  static constexpr std::string_view undamped_loss = "loses 7.0922 (W^5 r^4 / E*^2)^(1/3)";
  static constexpr bool by_force = false, jumps = true, has_range = false;
  static constexpr bool attracts_at_distance = false, has_dashpot = true, exportable = true;
  static constexpr bool quick_to_fit = true;
  /// From integrals of the forces along the path of a sphere at the capture velocity.
  static double capture_square(double C_H, double C_A, bool both_phases, double scale) {
    const double by_C_A = both_phases ? 0.655247 : 0.344548;
    const double loss = by_C_A * C_A + 0.670639 * C_H;
    return (0.128707 + 2.0 * loss * scale) * scale * scale;
  }

  static constexpr unsigned groups = 3;  ///< alpha, lambda, gamma
  static constexpr unsigned constants = 0;
  static constexpr std::array<std::size_t, groups> places = {0, 1, 2};
  static constexpr double tolerance_share = 0.1;  ///< of the fast solver, per step

  static double strength(const ImpactGroups& g) {
    return 4.0 * std::pow(6.0, -10.0 / 3.0) * g.beta * g.beta * std::sqrt(g.beta);
  }
  /// d lambda / d beta
  static double strength_slope(const ImpactGroups& g) {
    return 10.0 * std::pow(6.0, -10.0 / 3.0) * g.beta * std::sqrt(g.beta);
  }
  static std::array<double, groups> groups_of(const ImpactGroups& g) {
    return {g.alpha, strength(g), g.gamma};
  }
  static std::array<double, constants> constants_of(const ImpactGroups&) { return {}; }
  /// It starts at 4^(1/3) - 1 and rests at 6^(1/3) - 1. At the deepest point z^10 < 10 z^7 +
  /// 5 / lambda, so that z^3 < 10 + (5 / lambda)^(3/10) = 10 + 6 (5/4)^(3/10) beta^(-3/4).
  static LawPath path_of(const ImpactGroups& g) {
    const double hertz =
        6.0 * 1.069234599991188 / (std::sqrt(g.beta) * std::sqrt(std::sqrt(g.beta)));
    return {.start = 0.58740105196819947475,
            .resting = 0.81712059283213965889,
            .deepest = std::cbrt(10.0 + hertz) - 1.0};
  }

  template <class Q, class U, class Alpha, class Lambda, class Gamma, class Acts>
  static constexpr auto acceleration(const Q& q, const U& u, const Acts& acts, const Alpha& alpha,
                                     const Lambda& lambda, const Gamma& gamma) {
    const Q z = q + 1.0;
    const Q cube = z * z * z;
    const Q rate = q * (q * (q + 3.0) + 3.0) * cube;  // (z^3 - 1) z^3
    const Q push = -(rate * cube);
    const Q pull = 6.0 * rate;
    return lambda * ((push + pull) + push * (alpha * u) + -(pull * (acts * (gamma * u))));
  }
  template <class Q, class U, class Alpha, class Lambda, class Gamma>
  static constexpr auto push(const Q& q, const U& u, const Alpha& alpha, const Lambda& lambda,
                             const Gamma&) {
    const Q z = q + 1.0;
    const Q cube = z * z * z;
    const Q hertz = -((q * (q * (q + 3.0) + 3.0)) * (cube * cube));
    return lambda * (hertz + hertz * (alpha * u));
  }
  template <class Q, class U, class Acts, class Alpha, class Lambda, class Gamma>
  static constexpr auto pull(const Q& q, const U& u, const Acts& acts, const Alpha&,
                             const Lambda& lambda, const Gamma& gamma) {
    const Q z = q + 1.0;
    const Q adhesion = (6.0 * (q * (q * (q + 3.0) + 3.0))) * (z * z * z);
    return lambda * (adhesion + -(adhesion * (acts * (gamma * u))));
  }
  /// Zero at the release. At first contact it is the work that an undamped impact loses.
  template <class Q, class Alpha, class Lambda, class Gamma>
  static constexpr auto potential(const Q& q, const Alpha&, const Lambda& lambda, const Gamma&) {
    const Q polynomial =
        ((((((((0.1 * q + 1.0) * q + 4.5) * q + 11.0) * q + 14.0) * q + 4.2) * q + -12.5) * q +
          -17.0) *
             q +
         -7.5) *
        (q * q);
    return polynomial * lambda;
  }
  static bool admits(const ImpactGroups&) { return true; }
  /// Below this, adhesion changes e by less than 1e-10 at any damping with a rebound.
  static bool vanishes(const ImpactGroups& g) { return g.beta < 1e-14; }
  /// True if small motions about the bottom of the well are overdamped: n'' = -(9/10) b^(2/3) (n -
  /// n_0) - ((alpha + gamma) b^2 + (6/5) kappa b^(2/3)) n', b = beta^(3/4).
  static bool overdamped(const ImpactGroups& g) {
    const double fourth_root = std::sqrt(std::sqrt(g.beta));
    const double damping = (g.alpha + g.gamma) * g.beta + 1.2 * g.kappa;
    return damping * fourth_root >= 2.0 * std::sqrt(0.9);
  }
  static bool holds(const ImpactGroups& g) {
    const double dashpot = g.kappa * dashpot_unit(g);
    return dashpot * dashpot >= 2.0 / 3.0 * strength(g) * (1.0 + path_of(g).deepest);
  }
  static double depth(const ImpactGroups& g) {
    return potential(path_of(g).resting, 0.0, strength(g), 0.0);
  }

  /// The delay of the elastic force by the relaxation time A: the force -A d(K a^3 / r) / dt, which
  /// is -(3/2) A K (r n)^(1/2) n' for a Hertz contact. It grows without limit towards the release,
  /// but dissipates a finite energy.
  template <class Q, class... Values>
  static constexpr auto dashpot_weight(const Q& q, const Values&...) {
    const Q z = q + 1.0;
    const Q square = z * z;
    return square * square * z;
  }
  static double dashpot_unit(const ImpactGroups& g) {
    return 4.0 * std::pow(0.25 * strength(g), 0.6);
  }
  static constexpr double dashpot_power = 1.5;

  /// n [n_c] and the four forces [m V^2 / n_c]; dn / dz is the clock.
  static double penetration(double q, double, double lambda, double) {
    const double z = q + 1.0;
    return std::pow(0.25 * lambda, 0.4) * (z * z * z - 4.0) * z;
  }
  static double clock(double q, double, double lambda, double) {
    return 4.0 * std::pow(0.25 * lambda, 0.4) * q * (q * (q + 3.0) + 3.0);
  }
  static PlainForces forces(double q, double u, double acts, double alpha, double lambda,
                            double gamma) {
    const double cube = (q + 1.0) * (q + 1.0) * (q + 1.0);
    const double unit = std::pow(0.25 * lambda, 0.6);
    const double hertz = -unit * cube * cube;
    const double adhesion = 6.0 * unit * cube;
    return {hertz, hertz * alpha * u, adhesion, -adhesion * acts * gamma * u};
  }
  /// The larger of the elastic and the adhesive energy [m V^2].
  static double largest_energy(double q, double, double lambda, double) {
    const double z = q + 1.0;
    return lambda * std::pow(z, 7) * std::max(0.1 * z * z * z, 1.0);
  }
  /// The radius about q = u = 0 within which potential and kinetic energy are below `energy`.
  static double cusp_radius(const ImpactGroups& g, double energy) {
    return std::sqrt(energy / std::max(7.5 * strength(g), 0.5));
  }

  /// P = a^3 - (6 a^3)^(1/2), n = a^2 - (2/3) (6 a)^(1/2); the coordinate is a. As in
  /// MaugisContact, 3 E = P n - a^2 + M, where M is half of a^2 times the mean squares 2/5 (Hertz)
  /// and 2/3 (flat punch). E - M is half of the stored elastic energy.
  template <class T>
  static LawPlace<T> place_at(const T& a, const T&) {
    using std::sqrt;
    const double root6 = std::sqrt(6.0);
    const T root = sqrt(a);
    const T square = a * a;
    const T hertz = square * a;
    const T pull = root6 * (a * root);
    const T n = square + -((2.0 / 3.0 * root6) * root);
    const T moment = (0.5 * square) * (0.4 * hertz + -(2.0 / 3.0 * pull));
    const T energy = (1.0 / 3.0) * (n * (hertz + -pull) + -square + moment);
    return {energy, square, 2.0 * (energy + -moment)};
  }
  static DeepestSearch deepest_search(double strength, double) {
    const double touch = std::cbrt(8.0 / 3.0);
    return {.start_energy = place_at(touch, 0.0).energy,
            .from = std::cbrt(6.0),
            .to = 4.0 + std::pow(1.25 / strength, 0.2) * 2.0};
  }
};

}  // namespace recoil
