#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "impact/force_law.hpp"
#include "impact/jkr_law.hpp"
#include "impact/partial.hpp"

namespace recoil {

/// arctan(t) / t as a function of t^2, for t in [0, 1]: the minimax polynomial of degree 19 in t^2
/// (Remez exchange), with an error of 3e-17. It is evaluated as four sums in powers of t^8, which
/// are independent of each other.
template <class Q>
[[gnu::always_inline]] inline Q arctan_over(const Q& square) {
  constexpr double c[20] = {1.0,
                            -0.33333333333331316,
                            0.19999999999720938,
                            -0.14285714270371788,
                            0.11111110663985445,
                            -0.09090901102984922,
                            0.07692212254613758,
                            -0.06665859099393605,
                            0.05877315519979732,
                            -0.05239307370436687,
                            0.04674275298562729,
                            -0.04093574398934305,
                            0.034087035519187577,
                            -0.02585583664254346,
                            0.017010501749980395,
                            -0.00921115737629808,
                            0.0038715141902684845,
                            -0.001170205983095168,
                            0.00022448946596079363,
                            -2.0419140112014895e-05};
  const Q x2 = square * square;
  const Q x4 = x2 * x2;
  const auto every_fourth = [&](int i) {
    return (((c[i + 16] * x4 + c[i + 12]) * x4 + c[i + 8]) * x4 + c[i + 4]) * x4 + c[i];
  };
  return (every_fourth(0) + every_fourth(1) * square) +
         (every_fourth(2) + every_fourth(3) * square) * x2;
}

/// The contact of Maugis (1992), J. Colloid Interface Sci. 150, 243-269: a constant adhesive stress
/// s0 out to the radius c around the contact of radius a, in his units: radii in
/// (pi W r^2 / K)^(1/3), the approach in (pi^2 W^2 r / K^2)^(1/3), forces in pi W r. With m = c /
/// a,
///   1 = (lambda a^2 / 2) [(m^2 - 2) arcsec m + (m^2 - 1)^(1/2)]
///       + (4 lambda^2 a / 3) [(m^2 - 1)^(1/2) arcsec m - m + 1],
///   P = a^3 - lambda a^2 [(m^2 - 1)^(1/2) + m^2 arcsec m],
///   n = a^2 - (4/3) lambda a (m^2 - 1)^(1/2).
/// The first is a quadratic equation for c at given m. The coordinate is s = (m^2 - 1)^(-1/2), so
/// that s = 0 is the first contact (a = 0). Before it, the stress acts across a gap (Kim, McMeeking
/// & Johnson 1998, J. Adhesion Sci. Technol. 12, 393-404):
///   P = -(pi / 2) lambda c^2,   n = c^2 / 2 - (8 / (3 pi)) lambda c - 2 / (pi lambda),
/// and c continues with the slope in w = -s^2 that it has in w = s^2 at first contact. Everything
/// is smooth in s on each side; across s = 0, n and P are smooth up to s^3.
/// @tparam Q of s, @tparam L of lambda: any number with + * / and sqrt
template <class Q, class L>
struct MaugisContact {
  Q root;       // s, 0 across a gap
  Q beyond;     // w, 0 in contact
  Q place;      // d w / d s, halved
  Q inverse;    // (m^2 - 1)^(1/2) / m
  Q angle;      // arcsec m
  Q share;      // a / c
  L range;      // lambda
  L at_edge;    // c, where a > 0
  L half_rate;  // d c / d w
  L outer;      // c

  /// @param gap 0 in contact (s >= 0), 1 across a gap (s <= 0)
  template <class Side>
  [[gnu::always_inline]] MaugisContact(const Q& s, const L& lambda, const Side& gap)
      : range(lambda) {
    using std::sqrt;
    root = s * (1.0 + -gap);
    beyond = -(s * s) * gap;
    place = s * (1.0 + -2.0 * gap);
    const Q within = root * root;
    const Q one_more = within + 1.0;
    const Q secant = sqrt(one_more);
    const Q tangent = 1.0 / (root + secant);  // of half of the angle
    angle = 2.0 * tangent * arctan_over(Q(tangent * tangent));
    const Q inverse_square = 1.0 / one_more;
    inverse = secant * inverse_square;
    share = root * inverse;
    const Q first = (angle * (1.0 + -within) + root) * inverse_square;
    const Q second = 4.0 / 3.0 * ((angle + -tangent) * inverse);
    const L half = second * (lambda * lambda);
    const L discriminant = sqrt(half * half + (2.0 * first) * lambda);
    at_edge = 2.0 / (half + discriminant);
    half_rate = (lambda * at_edge) * (angle * (inverse_square * inverse_square)) *
                (at_edge + (2.0 / 3.0 * secant) * lambda) * (1.0 / discriminant);
    outer = at_edge + beyond * half_rate;
  }

  /// d n / d s.
  [[gnu::always_inline]] L rate() const { return (2.0 * place) * rate_in_w(); }
  /// d n / d w.
  [[gnu::always_inline]] L rate_in_w() const {
    const Q cube = inverse * inverse * inverse;
    return (at_edge * at_edge) * (cube * inverse) +
           2.0 * ((share * share) * (at_edge * half_rate)) +
           range * ((2.0 / 3.0) * (cube * at_edge) + -((4.0 / 3.0) * (inverse * half_rate))) +
           beyond * (half_rate * half_rate);
  }
  /// a^3.
  [[gnu::always_inline]] L elastic() const {
    return (outer * outer * outer) * (share * share * share);
  }
  /// lambda a^2 [...], positive.
  [[gnu::always_inline]] L adhesive() const {
    return (range * (outer * outer)) * (root * inverse * inverse + angle);
  }
  /// n.
  [[gnu::always_inline]] L approach() const {
    const L edge =
        (at_edge * at_edge) * (share * share) + -((4.0 / 3.0) * (inverse * (range * at_edge)));
    const Q cube = inverse * inverse * inverse;
    const L slope =
        (at_edge * at_edge) * (cube * inverse) +
        range * ((2.0 / 3.0) * (cube * at_edge) + -((4.0 / 3.0) * (inverse * half_rate)));
    return edge + beyond * (slope + (0.5 * beyond) * (half_rate * half_rate));
  }
  /// Energy of the bodies relative to infinite separation, the integral of P dn. For any stress
  /// within c, the envelope theorem and scaling give 3 E = P n - pi W c^2 + (second moment of the
  /// stress) / (2 r).
  [[gnu::always_inline]] L energy() const {
    const L radius = outer * share;
    const L square = outer * outer;
    const L moment =
        0.2 * (radius * radius * radius * radius * radius) +
        -((0.25 * range) * (square * square) *
          (angle + (share * inverse) * ((5.0 / 3.0) * (share * share) + inverse * inverse)));
    return (1.0 / 3.0) * (approach() * (elastic() + -adhesive()) + -square + moment);
  }
};

/// Places of an impact under MaugisLaw, which depend only on lambda, as s of MaugisContact
/// (negative across a gap); energies in pi W r (pi^2 W^2 r / K^2)^(1/3).
struct MaugisPath {
  double start = 0.0;        ///< after the jump into contact at the approach n = -W / s0
  double start_slope = 0.0;  ///< d start / d lambda
  double release = 0.0;      ///< end of the contact: the smallest n
  double resting = 0.0;      ///< P = 0
  double scale = 0.0;        ///< unit of s, with which start and release are of order one
  double energy_at_release = 0.0;
  double energy_slope = 0.0;    ///< d energy_at_release / d lambda
  double energy_at_rest = 0.0;  ///< relative to the release
  double cusp = 0.0;            ///< half the curvature of the energy in s about the release
};

/// @param lambda from 1e-6 to 1e6
MaugisPath maugis_path(double lambda);

/// The contact of Maugis (1992), MaugisContact, from the first attraction to the last, with the two
/// dampings of eq. 5: C_H on its elastic part a^3, C_A on its adhesive part. It tends to JkrLaw for
/// large lambda. For small lambda it tends to DmtLaw with the attraction across the gap W / s0
/// before and after, which the other laws omit and which is conservative without damping.
///
/// The adhesive stress begins when the gap is W / s0, at the approach n = -W / s0; V is the
/// velocity there. An undamped impact loses the energy of jumping in and out, from 0 to 7.0922 (W^5
/// r^4 / E*^2)^(1/3).
///
/// With q = s / scale and dt = (dn / dq) dsigma,
///   dq/dsigma = u,  du/dsigma = -Lambda (dn/dq) [a^3 (1 + alpha u) - P_a (1 + gamma S)],
/// in the units of Maugis for n, a and P_a. Lambda = 6^(-5/3) beta^(5/2), where beta is that of the
/// f0 that eqs 9 and 10 have for this W. The scale is a unit, which is constant in derivatives in
/// lambda.
struct MaugisLaw {
  static constexpr std::string_view equation = "Maugis (1992), damped";
  static constexpr std::string_view description =
      "Contact of Maugis (1992), between JKR and DMT, with the work of adhesion {W} over a range "
      "that follows from the separation; damping {C_H} on its elastic part, {C_A} on its adhesive "
      "part";
  static constexpr std::string_view elastic_part = "K a^3 / r";
  static constexpr std::string_view adhesive_part =
      "a constant stress 1.026 W / z0 around the contact (Maugis 1992)";
  static constexpr std::string_view undamped_loss =
      "loses 0 to 7.0922 of these units, depending on the Tabor parameter";
  static constexpr bool by_force = false, jumps = true, has_range = true;
  static constexpr bool attracts_at_distance = true, has_dashpot = false, exportable = false;
  static constexpr bool quick_to_fit = false;
  /// The value for JKR, used only as the start of a search.
  static double capture_square(double C_H, double C_A, bool both_phases, double scale) {
    return JkrLaw::capture_square(C_H, C_A, both_phases, scale);
  }

  static constexpr unsigned groups = 4;  ///< alpha, Lambda, gamma, lambda
  /// Scale; lambda, energy at release and its slope; 1 across a gap (LawPath::seam), else 0.
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
  /// Zero at the release.
  template <class Q, class Alpha, class Strength, class Gamma, class Lambda, class Constant>
  static auto potential(const Q& q, const Alpha&, const Strength& strength, const Gamma&,
                        const Lambda& lambda, const Constant& scale, const Constant& at,
                        const Constant& energy, const Constant& slope, const Constant& gap) {
    const MaugisContact<Q, Lambda> contact(Q(q * scale), lambda, gap);
    return strength * (contact.energy() + -((lambda + -at) * slope + energy));
  }
  static bool admits(const ImpactGroups& g) {
    constexpr double largest_range = 1e6;  // much larger than for any solid
    return std::isfinite(g.range) && g.range >= 0.0 && g.range <= largest_range;
  }
  /// Adhesion is negligible at V beyond 1e10 V_a, or if the range of attraction is more than a
  /// million times the depth to which adhesion presses the bodies.
  static bool vanishes(const ImpactGroups& g) { return g.range < 1e-6 || g.beta < 1e-8; }
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
  static PlainForces forces(double q, double u, double acts, double alpha, double strength,
                            double gamma, double lambda, double scale, double, double, double,
                            double gap) {
    const MaugisContact<double, double> contact(q * scale, lambda, gap);
    const double unit = std::pow(strength, 0.6);
    const double hertz = -unit * contact.elastic();
    const double adhesion = unit * contact.adhesive();
    return {hertz, hertz * alpha * u, adhesion, -adhesion * acts * gamma * u};
  }
  /// The larger of the elastic and the adhesive energy [m V^2].
  static double largest_energy(double q, double, double strength, double, double lambda,
                               double scale, double, double, double, double gap) {
    const MaugisContact<double, double> contact(q * scale, lambda, gap);
    const double radius = std::cbrt(contact.elastic());
    return strength *
           std::max(0.4 * std::pow(radius, 5), contact.adhesive() * std::abs(contact.approach()));
  }
  /// The radius about the release and u = 0 within which potential and kinetic energy are below
  /// `energy`.
  static double cusp_radius(const ImpactGroups& g, double energy) {
    const MaugisPath path = maugis_path(g.range);
    const double curvature = path.cusp * path.scale * path.scale * strength(g);
    return std::sqrt(energy / std::max(curvature, 0.5));
  }

  /// s at the deepest point, where c / a is close to 1. For small 1 / s the equation for c gives
  /// s^3 = (2/3) lambda a^2 + (2/3) lambda^2 a s. The a is that of JkrLaw.
  static double deepest_of(const ImpactGroups& g) {
    const double hertz =
        6.0 * 1.069234599991188 / (std::sqrt(g.beta) * std::sqrt(std::sqrt(g.beta)));
    const double root = std::cbrt(10.0 + hertz);
    const double radius = 0.5503212081491045 * root * root;
    const double part = 2.0 / 3.0 * g.range * radius;
    return std::sqrt(part * g.range + std::cbrt(part * radius * part * radius));
  }

  /// The coordinate is s.
  template <class T>
  static LawPlace<T> place_at(const T& s, const T& lambda) {
    const MaugisContact<T, T> contact(s, lambda, s.value < 0.0 ? 1.0 : 0.0);
    const T radius = contact.outer * contact.share;
    const T energy = contact.energy();
    const T outer = contact.outer * contact.outer;
    const T moment =
        3.0 * energy + outer + -(contact.approach() * (contact.elastic() + -contact.adhesive()));
    return {energy, radius * radius, 2.0 * (energy + -moment)};
  }
  static DeepestSearch deepest_search(double strength, double lambda);
};

}  // namespace recoil
