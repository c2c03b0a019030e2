#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr double polished = 1e-9;  // [m]

struct AsperityLoss {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    e.dissipate(own[0]);
  }
};

}  // namespace

Mechanism asperity_loss() {
  return make_mechanism<AsperityLoss>({
      .id = "asperity_loss",
      .title = "crushing of asperities",
      .formula = "a constant energy loss per impact, the same for all sizes",
      .source = "Tsai, C.-J., Pui, D. Y. H. & Liu, B. Y. H. (1990), Aerosol Sci. Technol. 12, "
                "497-507, for the deformation of asperities in adhesive impacts",
      .fingerprint = "1 - e^2 ~ V^(-2) d^(-3), V* ~ d^(-3/2)",
      .parameters =
          {{.name = "asperity_energy",
            .unit = "J",
            .meaning = "energy lost per impact",
            .initial = 1e-14,
            .upper = 1e-3,
            .plausible = {0.0, 1e-11,
                          "a contact of radius 0.1 um that yields by 10 nm at 1 GPa takes 3e-13 J"},
            .starts = {1e-15, 1e-13, 1e-12},
            .stated_by = {{.condition = Condition::surface_rms_roughness,
                           .zero_up_to = polished}}}},
      .taken_away = TakenAway{Condition::surface_rms_roughness, polished,
                              "polish the target to a roughness of 1 nm"},
  });
}

}  // namespace recoil
