#include "mechanism/mechanism.hpp"
#include "mechanism/opening_loss.hpp"

namespace recoil {
namespace {

struct AdhesionHysteresis {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const T work = own[0] * e.adhesion_energy;
    e.lose(e.at->adhesion == AdhesionLaw::ring ? opening_energy(e, work, T(0.0))
                                               : std::numbers::pi * work * e.contact_square());
  }
};

}  // namespace

Mechanism adhesion_hysteresis() {
  return make_mechanism<AdhesionHysteresis>({
      .id = "adhesion_hysteresis",
      .title = "separation takes more work per area than contact gave",
      .cause = "adhesion hysteresis",
      .kind = MechanismKind::physics,
      .place = MechanismPlace::contact,
      .formula = "loss pi a_max^2 dW, dW = s W_A with W_A of the two bodies, a_max of the damped "
                 "impact, and less damping of the slower sphere (other laws than the ring's: a_max "
                 "of the undamped impact)",
      .source =
          "Chaudhury, M. K. & Whitesides, G. M. (1991), Langmuir 7, 1013-1025 (adhesion hysteresis "
          "of contacts); that dW of unlike targets has the ratio of their W_A is an assumption",
      .fingerprint = "1 - e^2 falls like V^(-6/5) d^(-1), slower than for a constant energy; V* ~ "
                     "d^(-5/6), which a freed size law takes for f0 ~ r^(5/9); grows with W_A from "
                     "target to target",
      .parameters = {{.name = "hysteresis_factor",
                      .unit = "1",
                      .meaning = "s, work of separation less work gained on contact, over W_A",
                      .null_value = 0.0,
                      .initial = 0.15,
                      .lower = 0.0,
                      .upper = 150.0,
                      .plausible = {0.0, 3.0,
                                    "the work of separation of organic solids is up to a few times "
                                    "the work gained on contact"},
                      .starts = {0.03, 1.0}}},
      .needs_adhesion = true,
  });
}

}  // namespace recoil
