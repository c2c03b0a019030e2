#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// Work of separation w = w_0 + w_1 (v_c / (1 m/s))^k at the crack velocity v_c = |a'|. The first
/// term is paid back in closing; the second costs, with a^2 = R n and the n(t) of a Hertzian
/// impact,
///   integral of w_1 v_c^k d(pi a^2) = pi R n_m w_1 v_m^k (2/5) B((2 - k) / 5, 1 + k / 2),
///   v_m = V sqrt(R / n_m) / 2.
struct CrackRate {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const T& k = own[1];
    const T deepest = e.hertz_penetration();
    const T crack_velocity = 0.5 * e.velocity * sqrt(e.contact_radius / deepest);
    const T first = (2.0 - k) / 5.0;
    const T second = 1.0 + 0.5 * k;
    const T log_beta = log_gamma(first) + log_gamma(second) - log_gamma(first + second);
    const T rate = exponential(k * logarithm(crack_velocity) + log_beta);
    e.lose(0.4 * std::numbers::pi * e.contact_radius * deepest * own[0] * rate);
  }
};

}  // namespace

Mechanism crack_rate() {
  return make_mechanism<CrackRate>({
      .id = "crack_rate",
      .title = "adhesion that grows with the speed of the opening crack",
      .kind = MechanismKind::physics,
      .place = MechanismPlace::contact,
      .formula = "w = w_0 + w_1 (v_c / (1 m/s))^k on opening; loss pi a_max^2 w_1 v_m^k (2/5) "
                 "B((2-k)/5, 1+k/2), v_m = V (R / n_max)^(1/2) / 2",
      .source = "Gent, A. N. & Schultz, J. (1972), J. Adhesion 3, 281-294; Maugis, D. & Barquins, "
                "M. (1978), J. Phys. D 11, 1989-2023. The crack is taken to open at the speed of "
                "an elastic rebound, which overstates the loss by about k (1 - e) / 2 of itself",
      .fingerprint = "1 - e^2 ~ V^((3k-6)/5) d^(-1), V* ~ d^(-5/(6-3k)): between area hysteresis "
                     "(k = 0) and viscous loss; grows with the target's surface energy",
      .parameters = {{.name = "crack_energy",
                      .unit = "J/m2",
                      .meaning = "w_1, rate-dependent work of separation at 1 m/s",
                      .null_value = 0.0,
                      .initial = 0.05,
                      .lower = 0.0,
                      .upper = 50.0,
                      .plausible = {0.0, 10.0,
                                    "rates multiply the 0.01 to 0.3 J/m2 of van der Waals contacts "
                                    "by up to some tens"},
                      .starts = {0.01, 0.3}},
                     {.name = "crack_exponent",
                      .unit = "1",
                      .meaning = "k, of the crack velocity",
                      .null_value = 0.5,
                      .initial = 0.5,
                      .lower = 0.05,
                      .upper = 1.5,
                      .plausible = {0.2, 0.8, "0.3 to 0.7 are measured for polymers"},
                      .free = false}},
  });
}

}  // namespace recoil
