#include <cmath>
#include <numbers>
#include <vector>

#include "core/quadrature.hpp"
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

/// Work of separation w = w_0 + w_1 (v_c / (1 m/s))^k at the crack velocity v_c = |a'|, a^2 = R n,
/// w_1 = s W_A: the work without rate is multiplied (Gent & Schultz 1972). The first term is paid
/// back in closing; the second costs on the way out
///   integral of w_1 v_c^k d(pi a^2) = pi R w_1 integral over n of (sqrt(R / n) |n'| / 2)^k.
/// n' is that of an undamped sphere (`undamped_square`) less what the base model loses, spread
/// evenly over the way out: n'^2 - (1 - e_0^2) V^2 (1 - n / n_max). With n = n_max sin^4(phi)
/// twelve Gauss-Legendre nodes in phi leave an error below 1e-5 of the loss (against 300 nodes, for
/// k from 0.05 to 1.5, base losses up to 0.9 and adhesion up to five times the kinetic energy).
struct CrackRate {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const T& k = own[1];
    const T deepest = e.deepest();
    const T speed = e.velocity * e.velocity;
    // What comes back of the square of the speed; a captured sphere has lost all of it.
    const T width = 0.01 * speed;
    const T back = 0.5 * (e.square + sqrt(e.square * e.square + width * width));
    const T lost = speed - back;
    // `undamped_square` at n = s deepest, its two terms as numbers times s^(3/2) and s^(5/2).
    const T root = deepest * sqrt(e.contact_radius * deepest) / e.mass();
    const T adhesion = root * e.adhesion_force * (8.0 / 3.0 * std::numbers::pi);
    const T stored = root * deepest * (e.stiffness * 0.8);
    const T shape = 0.5 * logarithm(0.25 * e.contact_radius / deepest);
    T sum(0.0);
    for (const Node& node : nodes()) {
      const T square = speed + adhesion * node.s_1_5 - stored * node.s_2_5 - lost * (1.0 - node.s);
      if (!(value_of(square) > 0.0)) continue;
      const T log_crack = shape + 0.5 * (logarithm(square) - node.log_s);
      sum += node.weight * exponential(k * log_crack);
    }
    const T work = own[0] * e.adhesion_energy;
    e.lose(std::numbers::pi * e.contact_radius * deepest * work * sum);
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
      .source =
          "Gent, A. N. & Schultz, J. (1972), J. Adhesion 3, 281-294; Maugis, D. & Barquins, "
          "M. (1978), J. Phys. D 11, 1989-2023. The contact is taken to open at the speed of the "
          "base model's sphere",
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
                                    "rates multiply the work of adhesion by up to some tens"},
                      .starts = {0.03, 1.0}},
                     {.name = "crack_exponent",
                      .unit = "1",
                      .meaning = "k, of the crack velocity",
                      .null_value = 0.5,
                      .initial = 0.5,
                      .lower = 0.05,
                      .upper = 1.5,
                      .plausible = {0.2, 0.8, "0.3 to 0.7 are measured for polymers"},
                      .free = false}},
      .needs_adhesion = true,
  });
}

}  // namespace recoil
