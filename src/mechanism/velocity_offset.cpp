#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// The slowest rebound that is detected, divided by V [1].
constexpr double slowest_seen = 0.1;

struct VelocityOffset {
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    e.velocity -= own[0];
  }
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    e.square = shifted_if_seen(e.square, own[0] * own[1], slowest_seen * e.measured_velocity);
  }
};

}  // namespace

Mechanism velocity_offset() {
  return make_mechanism<VelocityOffset>({
      .id = "velocity_offset",
      .title = "the velocimeter has a constant velocity error",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::instrument,
      .formula = "the incident velocity is read as V + delta, the rebound velocity as V_r + s "
                 "delta; s = 1 for an error of the speed, s = -1 for an error of the signed "
                 "velocity (a residual frequency shift)",
      .source = "zero error of an instrument; no published source",
      .fingerprint = "e changes by (s - e) delta / V: 1 - e^2 ~ V^(-1), the same at all sizes and "
                     "targets",
      .parameters = {{.name = "velocity_error",
                      .unit = "m/s",
                      .meaning = "delta, error of the incident velocity",
                      .initial = 1e-2,
                      .lower = -10.0,
                      .upper = 10.0,
                      .plausible = {-0.1, 0.1, "velocimeters have zero errors of a few cm/s"},
                      .starts = {-1e-2, 1e-1, -1e-1},
                      .stated_by = {none_where(Condition::velocities_calibrated)}},
                     {.name = "rebound_sign",
                      .unit = "1",
                      .meaning = "s, error of the rebound velocity / delta",
                      .null_value = 1.0,
                      .initial = 1.0,
                      .lower = -1.0,
                      .upper = 1.0,
                      .plausible = {-1.0, 1.0, "both velocities have an error of the same size"},
                      .starts = {-1.0},
                      .free = false}},
      .methods = {Method::velocimeter},
      .taken_away = TakenAway{Condition::velocities_calibrated, 1.0,
                              "check the velocimeter's zero against a known velocity"},
  });
}

}  // namespace recoil
