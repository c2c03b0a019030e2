#pragma once

#include <cmath>

#include "impact/partial.hpp"

namespace recoil {

/// arctan(t) / t from t^2, for t in [0, 1]: the polynomial of degree 19 in t^2 with the least error
/// (Remez exchange), 3e-17. In powers of t^8 four short sums run side by side.
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
/// The first is a square equation for c once m is chosen. Here s = (m^2 - 1)^(-1/2) is chosen, so
/// that s = 0 is the point of first contact (a = 0). Before it the stress acts across a gap (Kim,
/// McMeeking & Johnson 1998, J. Adhesion Sci. Technol. 12, 393-404):
///   P = -(pi / 2) lambda c^2,   n = c^2 / 2 - (8 / (3 pi)) lambda c - 2 / (pi lambda),
/// and c goes on with the slope in w = -s^2 that it has in w = s^2 where the contact begins. On
/// either side everything is smooth in s; from one to the other n and P are smooth up to s^3.
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
  /// Energy of the bodies less that of the same bodies far apart, the integral of P dn. For any
  /// load by a stress within c, envelope theorem and scaling give 3 E = P n - pi W c^2 + (second
  /// moment of the stress) / (2 r).
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

}  // namespace recoil
