#include "mechanism/mechanism.hpp"
#include "mechanism/opening_contact.hpp"

namespace recoil {
namespace {

/// Work of separation w = w_0 + w_1 (v_c / (1 m/s))^k at the crack velocity v_c = |a'|,
/// w_1 = s W_A: the work without rate is multiplied (Gent & Schultz 1972). The first term is paid
/// back in closing, or is in the base model; the second costs on the way out.
struct CrackRate {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const T work = own[0] * e.adhesion_energy;
    e.square -= opening_loss(e, work, own[1]);
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
                 "= integral of w_1 v_c^k d(pi a^2) along the way out, which it slows, v_c = (R / "
                 "n)^(1/2) |n'| / 2",
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
