#include <cmath>
#include <numbers>
#include <vector>

#include "core/numerics.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// s = n / n_max = sin^4(phi) at a Gauss-Legendre node in phi, with what is needed of it.
struct Node {
  double s;
  double s_1_5, s_2_5;
  double log_s;
  double weight;  ///< of a sum over s
};

const std::vector<Node>& nodes() {
  constexpr std::size_t count = 12;
  static const std::vector<Node> all = [] {
    std::vector<Node> made;
    for (const auto& [position, weight] : gauss_legendre(count)) {
      const double phi = 0.5 * std::numbers::pi * position;
      const double s = std::pow(std::sin(phi), 4);
      const double stretch = 2.0 * std::numbers::pi * std::pow(std::sin(phi), 3) * std::cos(phi);
      made.push_back({s, std::pow(s, 1.5), std::pow(s, 2.5), std::log(s), weight * stretch});
    }
    return made;
  }();
  return all;
}

/// What comes back of the square of the speed [m2/s2]; a captured sphere has lost all of it.
template <class T>
T comes_back(const Encounter<T>& e) {
  return positive_part(e.square, T(0.01 * e.velocity * e.velocity));
}

/// The integral of v_c^k d(pi a^2) on the way out [m2], v_c in m/s, in a contact with a^2 = R n:
///   pi R integral over n of (sqrt(R / n) |n'| / 2)^k.
/// n' is that of an undamped sphere (`undamped_square`) less what the base model loses, spread
/// evenly over the way out: n'^2 - (1 - e_0^2) V^2 (1 - n / n_max). With n = n_max sin^4(phi)
/// twelve Gauss-Legendre nodes in phi leave an error below 1e-5 of the loss (against 300 nodes, for
/// k from 0.05 to 1.5, base losses up to 0.9 and adhesion up to five times the kinetic energy).
template <class T>
T opening_under_ring(const Encounter<T>& e, const T& k) {
  const T deepest = e.deepest();
  const T speed = e.velocity * e.velocity;
  const T lost = speed - comes_back(e);
  // `undamped_square` at n = s deepest, its two terms as numbers times s^(3/2) and s^(5/2).
  const T root = deepest * sqrt(e.contact_radius * deepest) / e.mass();
  const T adhesion = root * e.adhesion_force * (8.0 / 3.0 * std::numbers::pi);
  const T stored = root * deepest * (e.stiffness * 0.8);
  const T shape = 0.5 * logarithm(0.25 * e.contact_radius / deepest);
  // The derivatives of the sum in what its terms share: fewer than every term would carry.
  double total = 0.0;
  double by_k = 0.0;
  double by_speed = 0.0;
  double by_adhesion = 0.0;
  double by_stored = 0.0;
  double by_lost = 0.0;
  for (const Node& node : nodes()) {
    const double square = value_of(speed) + value_of(adhesion) * node.s_1_5 -
                          value_of(stored) * node.s_2_5 - value_of(lost) * (1.0 - node.s);
    if (!(square > 0.0)) continue;
    const double log_crack = value_of(shape) + 0.5 * (std::log(square) - node.log_s);
    const double term = node.weight * std::exp(value_of(k) * log_crack);
    const double by_square = 0.5 * value_of(k) * term / square;
    total += term;
    by_k += term * log_crack;
    by_speed += by_square;
    by_adhesion += by_square * node.s_1_5;
    by_stored -= by_square * node.s_2_5;
    by_lost -= by_square * (1.0 - node.s);
  }
  T sum(total);
  add_slopes(sum, by_k, k);
  add_slopes(sum, total * value_of(k), shape);
  add_slopes(sum, by_speed, speed);
  add_slopes(sum, by_adhesion, adhesion);
  add_slopes(sum, by_stored, stored);
  add_slopes(sum, by_lost, lost);
  return std::numbers::pi * e.contact_radius * deepest * sum;
}

/// A place on the way of JKR, in the units of Maugis (1992): a in (pi W R^2 / K)^(1/3), n in
/// (pi^2 W^2 R / K^2)^(1/3), energies in their product with pi W R.
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

/// The same where JKR's contact is the base model: a against n, and the undamped speed, are its
/// own. From the greatest pull on the crack runs ahead of the sphere; there it is taken to keep the
/// speed that it has then.
template <class T>
T opening_under_jkr(const Encounter<T>& e, const T& k) {
  // 6^(2/3) of the unit of n is n_eq = 2 pi f0 / K, and a^2 is counted in R times that unit.
  const T length =
      e.adhesion_force / e.stiffness * (2.0 * std::numbers::pi * std::pow(6.0, -2.0 / 3.0));
  const T area = e.contact_radius * length;
  const T strength = power(e.beta(), 2.5) * std::pow(6.0, -5.0 / 3.0);
  const T most = e.contact_square() / area;
  const double pull = std::pow(1.5, 2.0 / 3.0);      // a^2 at the greatest pull: P' = 0
  const double parting = std::pow(6.0, -2.0 / 3.0);  // dn / da = 0
  if (!(value_of(most) > pull)) return T(0.0);
  const T speed = e.velocity * e.velocity;
  const JkrPlace<T> deepest(sqrt(most));
  const JkrPlace<T> touch(T(std::cbrt(8.0 / 3.0)));
  const JkrPlace<T> parted(T(std::cbrt(1.0 / 6.0)));
  const auto undamped = [&](const JkrPlace<T>& at) {
    return speed - speed * (2.0 * strength * (at.energy - touch.energy));
  };
  const T lost = undamped(parted) - comes_back(e);
  // (v_c)^k at a, v_c = |n'| / (dn / da).
  const auto crack = [&](const T& a) {
    const JkrPlace<T> at(a);
    const T way = (deepest.approach - at.approach) / (deepest.approach - parted.approach);
    const T square = undamped(at) - lost * way;
    if (!(value_of(square) > 0.0)) return T(0.0);
    // dn / da in units of length / sqrt(area)
    const T slope = at.slope * length / sqrt(area);
    return exponential(k * (0.5 * logarithm(square) - logarithm(slope)));
  };
  T sum = (pull - parting) * crack(T(std::sqrt(pull)));
  static const std::vector<QuadratureNode> places = gauss_legendre(24);
  for (const auto& [position, weight] : places) {
    const double phi = 0.5 * std::numbers::pi * position;
    const double part = std::sin(phi) * std::sin(phi);
    const double stretch = std::numbers::pi * std::sin(phi) * std::cos(phi) * weight;
    sum += (most - pull) * stretch * crack(sqrt(pull + (most - pull) * part));
  }
  return std::numbers::pi * area * sum;
}

/// Work of separation w = w_0 + w_1 (v_c / (1 m/s))^k at the crack velocity v_c = |a'|,
/// w_1 = s W_A: the work without rate is multiplied (Gent & Schultz 1972). The first term is paid
/// back in closing, or is in the base model; the second costs on the way out.
struct CrackRate {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const bool jkr = e.at->adhesion == AdhesionLaw::jkr;
    const T work = own[0] * e.adhesion_energy;
    e.lose(work * (jkr ? opening_under_jkr(e, own[1]) : opening_under_ring(e, own[1])));
  }
};

}  // namespace

Mechanism crack_rate() {
  return make_mechanism<CrackRate>({
      .id = "crack_rate",
      .title = "adhesion that grows with the speed of the opening crack",
      .cause = "adhesion hysteresis",
      .kind = MechanismKind::physics,
      .place = MechanismPlace::contact,
      .formula = "w = w_0 + w_1 (v_c / (1 m/s))^k on opening, w_1 = s W_A with W_A of the two "
                 "bodies; loss "
                 "= integral of w_1 v_c^k d(pi a^2) on the way out, v_c = (R / n)^(1/2) |n'| / 2",
      .source = "Gent, A. N. & Schultz, J. (1972), J. Adhesion 3, 281-294; Maugis, D. & Barquins, "
                "M. (1978), J. Phys. D 11, 1989-2023. The contact is taken to open as that of the "
                "base model does; under JKR, up to the greatest pull",
      .fingerprint = "1 - e^2 ~ V^((3k-6)/5) d^(-1), V* ~ d^(-5/(6-3k)): between area hysteresis "
                     "(k = 0) and viscous loss; grows with W_A from target to target",
      .parameters = {{.name = "crack_factor",
                      .unit = "1",
                      .meaning = "s, rate-dependent work of separation at 1 m/s over W_A",
                      .null_value = 0.0,
                      .initial = 0.15,
                      .lower = 0.0,
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
