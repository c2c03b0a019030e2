#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

struct SizeCalibration {
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    e.resize(1.0 + own[0]);
  }
};

}  // namespace

Mechanism size_calibration() {
  return make_mechanism<SizeCalibration>({
      .id = "size_calibration",
      .title = "the stated diameters are wrong by a factor",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::size,
      .formula = "true diameter (1 + s) d",
      .source = "Li, X., Dunn, P. F. & Brach, R. M. (1999) state the error of their sizes",
      .fingerprint = "V* shifts by 5/4 of the relative error, the same at all sizes; at one size "
                     "it equals a wrong f0 or density",
      .parameters = {{.name = "diameter_error",
                      .unit = "1",
                      .meaning = "s, true diameter / stated diameter - 1",
                      .initial = 0.02,
                      .lower = -0.8,
                      .upper = 4.0,
                      .plausible = {-0.15, 0.15,
                                    "sizes are known to 15 % below 2 um, to 1 % above 80 um"},
                      .starts = {-0.02, 0.1, -0.1},
                      .stated_by = {none_where(Condition::sizes_calibrated)}}},
      .taken_away = TakenAway{Condition::sizes_calibrated, 1.0,
                              "calibrate the diameters against a length standard"},
  });
}

}  // namespace recoil
