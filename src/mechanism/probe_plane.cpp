#include "core/units.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

struct ProbePlane {
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    e.velocity = sqrt(e.velocity * e.velocity + 2.0 * standard_gravity * own[0]);
  }
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    e.square -= 2.0 * standard_gravity * own[0];
  }
};

}  // namespace

Mechanism probe_plane() {
  return make_mechanism<ProbePlane>({
      .id = "probe_plane",
      .title = "the measuring plane is higher than the correction assumes",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::height,
      .needs_flat = true,
      .formula = "spheres fall freely: V^2 = V_p^2 + 2 g h before the contact, V_p^2 = V^2 - 2 g h "
                 "after it",
      .source = "Galileo's law of falling bodies; Li, X., Dunn, P. F. & Brach, R. M. (1999) "
                "measure above the surface",
      .fingerprint = "1 - e^2 ~ V^(-2) at low V, the same at all sizes and for all targets",
      .parameters = {{.name = "plane_height",
                      .unit = "m",
                      .meaning = "h, uncorrected height of the measuring plane",
                      .initial = 1e-4,
                      .lower = -1e-2,
                      .upper = 1e-1,
                      .plausible = {-2e-3, 5e-3, "beams are within a few mm of the surface"},
                      .starts = {1e-3, -1e-4},
                      // The data may have been corrected for a height above 0.
                      .stated_by = {{.condition = Condition::probe_height, .zero_up_to = 0.0}}}},
      .methods = {Method::velocimeter},
      .taken_away = TakenAway{Condition::probe_height, 0.0,
                              "measure at the height of the surface, or correct for the fall from "
                              "the measuring plane"},
  });
}

}  // namespace recoil
