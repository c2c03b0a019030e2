#include "mechanism/mechanism.hpp"
#include "mechanism/opening_loss.hpp"

namespace recoil {
namespace {

struct AdhesionHysteresis {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const T work = own[0] * e.adhesion_energy;
    e.dissipate(e.at->adhesion == AdhesionLaw::ring ? opening_energy(e, work, T(0.0))
                                                    : std::numbers::pi * work * e.contact_square());
  }
};

}  // namespace

Mechanism adhesion_hysteresis() {
  return make_mechanism<AdhesionHysteresis>({
      .id = "adhesion_hysteresis",
      .title = "separation takes more work per area than contact gains",
      .cause = "adhesion hysteresis",
      .formula =
          "energy loss pi a_max^2 dW, dW = s W_A, with the work of adhesion W_A of the two bodies "
          "and the largest contact radius a_max of the damped impact; the slower sphere is damped "
          "less. Laws of adhesion other than ring use a_max of the undamped impact",
      .source =
          "Chaudhury, M. K. & Whitesides, G. M. (1991), Langmuir 7, 1013-1025 (adhesion hysteresis "
          "of contacts); that dW is proportional to W_A from target to target is an assumption",
      .fingerprint = "1 - e^2 ~ V^(-6/5) d^(-1), a slower fall than with a constant energy loss; "
                     "V* ~ d^(-5/6), which a free size law fits as f0 ~ r^(5/9); the loss grows "
                     "with W_A from target to target",
      .parameters = {{.name = "hysteresis_factor",
                      .unit = "1",
                      .meaning = "s, (work of separation - work gained on contact) / W_A",
                      .initial = 0.15,
                      .upper = 150.0,
                      .plausible = {0.0, 3.0,
                                    "the work of separation of organic solids is up to a few times "
                                    "the work gained on contact"},
                      .starts = {0.03, 1.0}}},
      .needs_adhesion = true,
  });
}

}  // namespace recoil
