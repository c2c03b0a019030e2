#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

struct AdhesionHysteresis {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    // a_max^2 = R n_max
    e.lose(std::numbers::pi * e.contact_radius * e.deepest() * own[0]);
  }
};

}  // namespace

Mechanism adhesion_hysteresis() {
  return make_mechanism<AdhesionHysteresis>({
      .id = "adhesion_hysteresis",
      .title = "parting takes more work per area than meeting gave",
      .cause = "adhesion hysteresis",
      .kind = MechanismKind::physics,
      .place = MechanismPlace::contact,
      .formula = "loss pi a_max^2 dW, with a_max of the undamped impact",
      .source =
          "Chaudhury, M. K. & Whitesides, G. M. (1991), Langmuir 7, 1013-1025 (adhesion hysteresis "
          "of contacts); that damping makes the contact smaller is left out",
      .fingerprint = "1 - e^2 falls like V^(-6/5) d^(-1), slower than for a constant energy; V* ~ "
                     "d^(-5/6), which a freed size law takes for f0 ~ r^(5/9)",
      .parameters = {{.name = "hysteresis_energy",
                      .unit = "J/m2",
                      .meaning = "dW, work of parting less work of meeting",
                      .null_value = 0.0,
                      .initial = 0.05,
                      .lower = 0.0,
                      .upper = 50.0,
                      .plausible = {0.0, 1.0, "0.01 to 0.3 J/m2 is usual for organic solids"},
                      .starts = {0.01, 0.3}}},
  });
}

}  // namespace recoil
