#include "core/units.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// v^2 / V^2 of the slowest rebound that is read as one [1].
constexpr double lowest_rebound = 0.01;

struct HeightOrigin {
  /// 2 g delta.
  template <class T>
  static T too_much(std::span<const T> own) {
    return 2.0 * standard_gravity * own[0];
  }
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    const T less = too_much(own) * own[1];
    const T fall = e.velocity * e.velocity - less;
    e.velocity = sqrt(value_of(less) == 0.0 ? fall : positive_part(fall, 0.05 * less));
  }
  /// A sphere that stays on the surface is not read as a rebound to the height delta.
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const T least = lowest_rebound * e.measured_velocity * e.measured_velocity;
    const T seen = 0.5 * (1.0 + e.square / sqrt(e.square * e.square + least * least));
    e.square += too_much(own) * seen;
  }
};

}  // namespace

Mechanism height_origin() {
  return make_mechanism<HeightOrigin>({
      .id = "height_origin",
      .title = "drop and rebound heights refer to different points",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::height,
      .needs_flat = true,
      .formula = "heights h = V^2 / 2g: the rebound height is read as h_2 + delta, the drop height "
                 "as h_1 + s delta; e^2 = (e_0^2 (h_1 - s delta) + delta) / h_1 with h_1 as read",
      .source = "Galileo's law of falling bodies; a height is that of the sphere's lowest point "
                "above the surface; a height read at the centre or top is too large by r or 2 r",
      .fingerprint =
          "1 - e^2 changes by 2 g delta / V^2, the same at all sizes and targets: e is too high or "
          "too low at small drop heights. With s = 1 it equals probe_plane with h = -delta",
      .parameters =
          {{.name = "height_error",
            .unit = "m",
            .meaning = "delta, error of the rebound height",
            .initial = 1e-5,
            .lower = -0.1,
            .upper = 0.1,
            .plausible = {-0.1, 0.1, "limit of the formula"},
            .starts = {-1e-5, 1e-4, -1e-4, 5e-3, -5e-3},
            .limit = {.quantity = "error of the height / diameter",
                      .lower = -1.0,
                      .upper = 1.0,
                      .why = "two points of a sphere are at most one diameter apart",
                      .of = [](const Encounter<double>& sphere,
                               std::span<const double> own) { return own[0] / sphere.diameter; }},
            .stated_by = {none_where(Condition::velocities_calibrated)}},
           {.name = "drop_share",
            .unit = "1",
            .meaning = "s, error of the drop height / delta",
            .lower = -1.0,
            .upper = 1.0,
            .plausible = {-1.0, 1.0, "both heights have an error of the same size"},
            .free = false}},
      .methods = {Method::drop_heights},
      .taken_away = TakenAway{Condition::velocities_calibrated, 1.0,
                              "read both heights at the same point of the sphere"},
  });
}

}  // namespace recoil
