#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "impact/force_law.hpp"

namespace recoil {

/// The contact of Derjaguin, Muller & Toporov (1975), J. Colloid Interface Sci. 53, 314-326, in the
/// form that Maugis (2000) calls DMT-M: Hertz's contact under a constant pull 2 pi W r, with the
/// two dampings of eq. 5. The pull acts while the bodies touch (n > 0), so that nothing is lost
/// without damping. With q = x^(1/2), dt = 2 q dsigma,
///   dq/dsigma = u,   du/dsigma = 2 q [p (1 + gamma S) - q^3 (1 + alpha u)].
/// p = 2 pi W r n_c / (m V^2) = beta^(3/2) / 3, where beta is that of the f0 that eqs 9 and 10 have
/// for this W: all laws depend on the same three groups.
struct DmtLaw : HertzRadius {
  static constexpr std::string_view equation = "Derjaguin, Muller & Toporov (1975), damped";
  static constexpr std::string_view description =
      "Hertz contact under the constant pull 2 pi {W} r of Derjaguin, Muller & Toporov (1975); "
      "damping {C_H} on its elastic part, {C_A} on its adhesive part";
  static constexpr std::string_view elastic_part = "Hertz";
  static constexpr std::string_view adhesive_part =
      "2 pi W r while the bodies touch (Derjaguin, Muller & Toporov 1975, in the form of Maugis "
      "2000)";
  static constexpr std::string_view undamped_loss = "loses nothing";
  static constexpr bool by_force = false, jumps = false, has_range = false;
  static constexpr bool attracts_at_distance = false, has_dashpot = true, exportable = true;
  static constexpr bool quick_to_fit = true;
  static double capture_square(double C_H, double C_A, bool both_phases, double scale) {
    return small_damping_square(0.100802, C_H, C_A, both_phases, scale);
  }

  static constexpr unsigned groups = 3;  ///< alpha, p, gamma
  static constexpr unsigned constants = 0;
  static constexpr std::array<std::size_t, groups> places = {0, 1, 2};
  static constexpr double tolerance_share = 1.0;  ///< of the fast solver, per step

  static double strength(const ImpactGroups& g) { return g.beta * std::sqrt(g.beta) / 3.0; }
  /// d p / d beta
  static double strength_slope(const ImpactGroups& g) { return 0.5 * std::sqrt(g.beta); }
  static std::array<double, groups> groups_of(const ImpactGroups& g) {
    return {g.alpha, strength(g), g.gamma};
  }
  static std::array<double, constants> constants_of(const ImpactGroups&) { return {}; }
  /// At the deepest point q^3 = (5/2) p + (5/4) q^(-2), which is less than with q = (5/4)^(1/5).
  static LawPath path_of(const ImpactGroups& g) {
    const double p = strength(g);
    return {.resting = std::cbrt(p), .deepest = std::cbrt(2.5 * p + 1.143262629818316)};
  }

  template <class Q, class U, class Alpha, class P, class Gamma, class Acts>
  static constexpr auto acceleration(const Q& q, const U& u, const Acts& acts, const Alpha& alpha,
                                     const P& p, const Gamma& gamma) {
    const Q twice_q = q + q;
    const Q push = -(twice_q * (q * q * q));
    const auto pull = twice_q * p;
    return push + push * (alpha * u) + (pull + -(pull * (acts * (gamma * u))));
  }
  template <class Q, class U, class Alpha, class P, class Gamma>
  static constexpr auto push(const Q& q, const U& u, const Alpha& alpha, const P&, const Gamma&) {
    const Q hertz = -2.0 * (q * q * (q * q));
    return hertz + hertz * (alpha * u);
  }
  template <class Q, class U, class Acts, class Alpha, class P, class Gamma>
  static constexpr auto pull(const Q& q, const U& u, const Acts& acts, const Alpha&, const P& p,
                             const Gamma& gamma) {
    const auto adhesion = (q + q) * p;
    return adhesion + -(adhesion * (acts * (gamma * u)));
  }
  template <class Q, class Alpha, class P, class Gamma>
  static constexpr auto potential(const Q& q, const Alpha&, const P& p, const Gamma&) {
    const Q x = q * q;
    const Q hertz = 0.4 * (x * x * q);
    return hertz + (-x) * p;
  }
  static bool admits(const ImpactGroups&) { return true; }
  static bool vanishes(const ImpactGroups&) { return false; }
  static bool holds(const ImpactGroups& g) {
    const double deepest = path_of(g).deepest;
    return strength(g) * g.kappa * g.kappa >= deepest * deepest;
  }
  static double depth(const ImpactGroups& g) { return -0.6 * std::pow(strength(g), 5.0 / 3.0); }

  static PlainForces forces(double q, double u, double acts, double alpha, double p, double gamma) {
    const double hertz = -q * q * q;
    return {hertz, hertz * alpha * u, p, -p * acts * gamma * u};
  }
  static double largest_energy(double q, double, double p, double) {
    return std::max(0.4 * std::pow(q, 5), p * q * q);
  }
  static double cusp_radius(const ImpactGroups& g, double energy) {
    return std::sqrt(energy / std::max(strength(g), 0.5));
  }

  /// P = a^3 - 2, n = a^2; the coordinate is a.
  template <class T>
  static LawPlace<T> place_at(const T& a, const T&) {
    const T square = a * a;
    const T stored = 0.4 * (square * square * a);
    return {stored + -2.0 * square, square, stored};
  }
  static DeepestSearch deepest_search(double strength, double) {
    return {.from = std::cbrt(2.0), .to = 4.0 + std::pow(1.25 / strength, 0.2) * 2.0};
  }
};

}  // namespace recoil
