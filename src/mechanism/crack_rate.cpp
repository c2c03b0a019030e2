#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "mechanism/mechanism.hpp"
#include "mechanism/opening_loss.hpp"
#include "mechanism/radau.hpp"

namespace recoil {
namespace {

/// A point of the JKR curve in the units of Maugis (1992): a in (pi W R^2 / K)^(1/3), n in (pi^2
/// W^2 R / K^2)^(1/3), energies in the unit of n times pi W R.
template <class T>
struct JkrPlace {
  T approach, slope, energy;  // n, dn / da, integral of P dn

  explicit JkrPlace(const T& a) {
    const double root6 = std::sqrt(6.0);
    const T root = sqrt(a);
    const T square = a * a;
    approach = square - (2.0 / 3.0 * root6) * root;
    slope = 2.0 * a - (root6 / 3.0) / root;
    // of (a^3 - (6 a^3)^(1/2)) dn
    energy = 0.4 * square * square * a - (2.0 / 3.0 * root6) * square * a * root + square;
  }
};

/// A part of the way of a sphere under JKR: a from `from` to `to`, `from` at s = 0. n'^2 and its
/// losses are in units of the incident one.
template <class T>
struct JkrWay {
  T deepest, from;
  double to;
  bool inward = false, opens = false;
  T before = T(0.0);                  ///< lost since the deepest point
  T elsewhere = T(0.0);               ///< other losses, distributed evenly over the way out
  std::optional<T> crack_power = {};  ///< v_c^k, if it is constant
};

/// The opening of the contact if JKR is the base model, with the dampings of the base model. From
/// the largest pull on, the crack is faster than the sphere; its speed is assumed to be constant
/// from there.
template <class T>
struct JkrOpening {
  static inline const double pull = std::cbrt(1.5);           // a at the largest pull
  static inline const double parting = std::cbrt(1.0 / 6.0);  // a where dn / da = 0
  static inline const double touching = std::cbrt(8.0 / 3.0);

  T exponent, velocity, length, strength, unit, on_elastic, on_adhesive, undamped;
  bool damps_both;

  JkrOpening(const Encounter<T>& e, const T& work, const T& k)
      : exponent(k),
        velocity(e.velocity),
        // 6^(2/3) of the unit of n is n_eq = 2 pi f0 / K, and a^2 is counted in R times that unit.
        length(e.adhesion_force / e.stiffness *
               (2.0 * std::numbers::pi * std::pow(6.0, -2.0 / 3.0))),
        strength(2.0 * std::pow(6.0, -5.0 / 3.0) * power(e.beta(), 2.5)),
        unit(work * e.contact_radius * length / (e.mass() * velocity * velocity) *
             (2.0 * std::numbers::pi)),
        on_elastic(e.hertz_damping * velocity),
        on_adhesive(e.adhesion_damping * velocity),
        undamped(sqrt(e.contact_square() / (e.contact_radius * length))),
        damps_both(e.at->phase == AdhesionDampingPhase::both) {
    length = sqrt(length / e.contact_radius);  // of n over that of a
  }

  T stored(const T& a) const {
    return strength * (JkrPlace<T>(a).energy - JkrPlace<double>(touching).energy);
  }
  /// n'^2 at a, after `lost` on this part of the way.
  T square(const JkrWay<T>& way, const T& a, double lost) const {
    const T plain = stored(way.deepest) - stored(a);
    if (way.inward) return plain + lost;
    const T all = JkrPlace<T>(way.deepest).approach - JkrPlace<double>(parting).approach;
    const T part = JkrPlace<T>(way.deepest).approach - JkrPlace<T>(a).approach;
    return plain - lost - way.before - way.elsewhere * (part / all);
  }
  /// v_c^k at this n'^2, v_c = |n'| / (dn / da). It ends when a captured sphere stops, with a
  /// smooth transition.
  T crack_power(const T& square, const T& slope) const {
    return exponential(exponent * (0.5 * logarithm(positive_part(square, T(width))) +
                                   logarithm(velocity) - logarithm(slope * length)));
  }
  /// The loss per s, at a = from - (from - to) s^2, because n'^2 grows like s^2 from the deepest
  /// point, and its slope in `lost`.
  std::pair<T, double> rate(const JkrWay<T>& way, double s, double lost) const {
    const T a = way.from - (way.from - way.to) * (s * s);
    const T slope = JkrPlace<T>(a).slope;
    const T now = square(way, a, lost);
    const T cube = a * a * a;
    T force = on_elastic * cube;
    if (!way.inward || damps_both) force += on_adhesive * sqrt(6.0 * cube);
    const T damping = strength * force * slope * sqrt(positive_part(now, T(width)));
    T opening(0.0);
    if (way.opens) {
      opening = 2.0 * unit * a * (way.crack_power ? *way.crack_power : crack_power(now, slope));
    }
    const T stretch = (way.from - way.to) * (2.0 * s);
    const double felt = way.crack_power ? 0.0 : value_of(exponent) * value_of(opening);
    const double by_square = 0.5 * (value_of(damping) + felt) / std::hypot(value_of(now), width);
    return {(damping + opening) * stretch,
            (way.inward ? by_square : -by_square) * value_of(stretch)};
  }

  static constexpr double width = 1e-4;
};

JkrWay<double> plain(const JkrWay<double>& way) { return way; }
template <class T>
JkrWay<double> plain(const JkrWay<T>& way) {
  JkrWay<double> same{value_of(way.deepest), value_of(way.from),     way.to, way.inward, way.opens,
                      value_of(way.before),  value_of(way.elsewhere)};
  if (way.crack_power) same.crack_power = value_of(*way.crack_power);
  return same;
}

template <class T>
struct JkrLosses {
  JkrOpening<double> numbers;
  JkrOpening<T> full;

  /// The loss on a part of the way.
  template <int steps = 12>
  T on(const JkrWay<T>& way) const {
    const JkrWay<double> same = plain(way);
    return integrate_loss<T, steps>(
        [&](int node, double lost) -> RateOfLoss {
          const auto [value, slope] = numbers.rate(same, radau_place(node, steps), lost);
          return {value, slope};
        },
        [&](int node, double lost) {
          return full.rate(way, radau_place(node, steps), lost).first;
        });
  }
  /// a at the deepest point: the stored energy and the loss on the way in are all of it.
  T deepest() const {
    const JkrLosses<double> same{numbers, numbers};
    const auto excess = [](const auto& losses, const auto& a) {
      return losses.full.stored(a) +
             losses.on(
                 {.deepest = a, .from = a, .to = JkrOpening<double>::touching, .inward = true}) -
             1.0;
    };
    double a = value_of(full.undamped), slope = 1.0;
    for (int step = 0; step < 12; ++step) {
      const double h = 1e-4 * a;
      slope = (excess(same, a + h) - excess(same, a - h)) / (2.0 * h);
      const double change = excess(same, a) / slope;
      a -= change;
      if (std::abs(change) < 1e-9 * a) break;
    }
    return a - excess(*this, T(a)) * (1.0 / slope);
  }
  /// n'^2 where the contact parts.
  T square_out(const T& deepest, bool opens, const T& elsewhere) const {
    using Opening = JkrOpening<double>;
    JkrWay<T> way{.deepest = deepest, .from = deepest, .to = Opening::pull};
    way.opens = opens;
    way.elsewhere = elsewhere;
    way.before = on(way);
    way.from = T(Opening::pull);
    way.to = Opening::parting;
    if (opens) {
      way.crack_power = full.crack_power(full.square(way, way.from, 0.0),
                                         T(JkrPlace<double>(Opening::pull).slope));
    }
    way.before += on<4>(way);
    return full.square(way, T(Opening::parting), 0.0);
  }
};

/// The energy [J] that the opening takes: as in `opening_loss`, the dampings act on the slower
/// sphere.
template <class T>
T opening_under_jkr(const Encounter<T>& e, const T& work, const T& k) {
  const JkrLosses<T> losses{{e.without_slopes(), value_of(work), value_of(k)}, {e, work, k}};
  if (!(losses.numbers.undamped > JkrOpening<double>::touching)) return T(0.0);
  const T speed = e.velocity * e.velocity;
  const T deepest = losses.deepest();
  const T elsewhere = losses.square_out(deepest, false, T(0.0)) - e.square / speed;
  const T taken =
      losses.square_out(deepest, false, elsewhere) - losses.square_out(deepest, true, elsewhere);
  return 0.5 * e.mass() * speed * taken;
}

/// Work of separation w = w_0 + w_1 (v_c / (1 m/s))^k at the crack velocity v_c = |a'|, w_1 = s
/// W_A, a multiple of the work without rate (Gent & Schultz 1972). The first term was gained when
/// the contact closed, or belongs to the base model; the second is lost on the way out.
struct CrackRate {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const T work = own[0] * e.adhesion_energy;
    e.dissipate(e.at->adhesion == AdhesionLaw::jkr ? opening_under_jkr(e, work, own[1])
                                                   : opening_energy(e, work, own[1]));
  }
};

}  // namespace

Mechanism crack_rate() {
  return make_mechanism<CrackRate>({
      .id = "crack_rate",
      .title = "adhesion that grows with the speed of the opening crack",
      .cause = "adhesion hysteresis",
      .formula =
          "work of separation w = w_0 + w_1 (v_c / (1 m/s))^k, w_1 = s W_A, with the work of "
          "adhesion W_A of the two bodies; energy loss = integral of w_1 v_c^k d(pi a^2) during "
          "rebound; crack speed v_c = (R / n)^(1/2) |n'| / 2, where n' includes all losses",
      .source = "Gent, A. N. & Schultz, J. (1972), J. Adhesion 3, 281-294; Maugis, D. & Barquins, "
                "M. (1978), J. Phys. D 11, 1989-2023. The contact is assumed to open as in the "
                "base model; under JKR, up to the largest pull",
      .fingerprint = "1 - e^2 ~ V^((3k-6)/5) d^(-1), V* ~ d^(-5/(6-3k)): between area hysteresis "
                     "(k = 0) and viscous loss; the loss grows with W_A from target to target",
      .parameters = {{.name = "crack_factor",
                      .unit = "1",
                      .meaning = "s, (rate-dependent work of separation at 1 m/s) / W_A",
                      .initial = 0.15,
                      .upper = 150.0,
                      .plausible = {0.0, 30.0,
                                    "the rate multiplies the work of adhesion by up to a few tens"},
                      .starts = {0.03, 1.0}},
                     {.name = "crack_exponent",
                      .unit = "1",
                      .meaning = "k, exponent of the crack velocity",
                      .null_value = 0.5,
                      .initial = 0.5,
                      .lower = 0.05,
                      .upper = 1.0,
                      .plausible = {0.2, 0.8, "0.3 to 0.7 are measured for polymers"},
                      .free = false}},
      .needs_adhesion = true,
      .refused = [](AdhesionLaw law) -> std::string_view {
        if (law == AdhesionLaw::ring || law == AdhesionLaw::jkr) return {};
        return "such a contact has no crack with a sharp edge";
      },
      .not_with = "adhesion_hysteresis",
  });
}

}  // namespace recoil
