#include <cmath>
#include <numbers>
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

/// The opening of the contact if JKR is the base model, which gives a(n) and the undamped speed.
/// n'^2 is that of an undamped sphere less the energy that the opening has taken, and less all
/// other losses, distributed evenly over the way out. From the largest pull on, the crack is faster
/// than the sphere; its speed is assumed to be constant from there.
template <class T>
struct JkrOpening {
  static inline const double pull = std::pow(1.5, 2.0 / 3.0);      // a^2 at the largest pull
  static inline const double parting = std::pow(6.0, -2.0 / 3.0);  // a^2 where dn / da = 0

  T exponent, speed, length, area, strength, most, unit, elsewhere;
  JkrPlace<T> deepest, touch, parted;

  JkrOpening(const Encounter<T>& e, const T& work, const T& k)
      : exponent(k),
        speed(e.velocity * e.velocity),
        // 6^(2/3) of the unit of n is n_eq = 2 pi f0 / K, and a^2 is counted in R times that unit.
        length(e.adhesion_force / e.stiffness * (2.0 * std::numbers::pi * parting)),
        area(e.contact_radius * length),
        strength(power(e.beta(), 2.5) * std::pow(6.0, -5.0 / 3.0)),
        most(e.contact_square() / area),
        unit(work * area / e.mass() * (2.0 * std::numbers::pi)),
        deepest(sqrt(most)),
        touch(T(std::cbrt(8.0 / 3.0))),
        parted(T(std::cbrt(1.0 / 6.0))) {
    elsewhere = undamped(parted) - positive_part(e.square, 0.01 * speed);
  }

  T undamped(const JkrPlace<T>& at) const {
    return speed - speed * (2.0 * strength * (at.energy - touch.energy));
  }
  /// The n'^2 that the opening takes per a^2 at this a^2, after it has taken `taken`. It ends when
  /// a captured sphere stops, with a smooth transition at 1e-4 of the incident n'^2.
  /// @return the rate and its slope in `taken`
  std::pair<T, double> rate(const T& square_of_a, double taken) const {
    const JkrPlace<T> at(sqrt(square_of_a));
    const T way = (deepest.approach - at.approach) / (deepest.approach - parted.approach);
    const T square = undamped(at) - elsewhere * way - taken;
    const T width = 1e-4 * speed;
    // v_c = |n'| / (dn / da), dn / da in units of length / sqrt(area).
    const T slope = at.slope * length / sqrt(area);
    const T took =
        unit *
        exponential(exponent * (0.5 * logarithm(positive_part(square, width)) - logarithm(slope)));
    return {took, -0.5 * value_of(exponent) * value_of(took) /
                      std::hypot(value_of(square), value_of(width))};
  }
};

/// The energy [J] that the opening takes.
template <class T>
T opening_under_jkr(const Encounter<T>& e, const T& work, const T& k) {
  const JkrOpening<double> plain(e.without_slopes(), value_of(work), value_of(k));
  if (!(plain.most > plain.pull)) return T(0.0);
  const JkrOpening<T> full(e, work, k);
  // a^2 = pull + (most - pull) cos^2(pi s / 2), because the speed vanishes like a square root at
  // the largest a^2. The unit is the square of the incident speed.
  const auto part = [](double s) { return std::pow(std::cos(0.5 * std::numbers::pi * s), 2); };
  const auto stretch = [](double s) {
    return 0.5 * std::numbers::pi * std::sin(std::numbers::pi * s);
  };
  const double width = plain.most - plain.pull;
  constexpr int steps = 12;
  const T sum = integrate_loss<T, steps>(
      [&](int node, double taken) -> RateOfLoss {
        const double s = radau_place(node, steps);
        const auto [took, slope] = plain.rate(plain.pull + width * part(s), taken * plain.speed);
        return {took * width * stretch(s) / plain.speed, slope * width * stretch(s)};
      },
      [&](int node, double taken) {
        const double s = radau_place(node, steps);
        const T wide = full.most - full.pull;
        const T took = full.rate(full.pull + wide * part(s), taken * plain.speed).first;
        return took * wide * (stretch(s) / plain.speed);
      });
  const double whole = value_of(sum) * plain.speed;
  auto [last, slope] = full.rate(T(full.pull), whole);
  add_slopes(last, slope * plain.speed, sum);
  return 0.5 * e.mass() * (sum * plain.speed + (full.pull - full.parting) * last);
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
                      .upper = 1.5,
                      .plausible = {0.2, 0.8, "0.3 to 0.7 are measured for polymers"},
                      .free = false}},
      .needs_adhesion = true,
      .refused = [](AdhesionLaw law) -> std::string_view {
        if (law == AdhesionLaw::ring || law == AdhesionLaw::jkr) return {};
        return "such a contact has no crack with a sharp edge";
      },
  });
}

}  // namespace recoil
