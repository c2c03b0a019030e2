#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// ln of a lognormal diameter is normal about ln of its median, and its mean is exp(s^2 / 2) times
/// that median: the stated diameter is the mean.
struct Polydispersity {
  template <class T>
  static void vary(Encounter<T>& e, std::span<const T> own, double z) {
    const T shift = own[0] * z - 0.5 * own[0] * own[0];
    const T factor = exponential(shift);
    e.diameter *= factor;
    e.contact_radius *= factor;
    e.adhesion_force *= exponential(1.0 / 3.0 * shift);
  }
};

}  // namespace

Mechanism polydispersity() {
  return make_mechanism<Polydispersity>({
      .id = "polydispersity",
      .title = "spheres of many sizes in one point",
      .cause = "unequal impacts averaged in one point",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::spread,
      .formula =
          "diameters are lognormal with the stated one as their mean (by number), d = d_mean "
          "exp(s z - s^2 / 2); a point is the mean e of those that rebound",
      .source = "Hinds, W. C., Aerosol Technology (lognormal sizes)",
      .fingerprint = "rounds e(V) off near capture, where only the large ones come back: e too "
                     "high just above V*, where the mean sphere would hardly rebound",
      .parameters =
          {{.name = "size_spread",
            .unit = "1",
            .meaning = "standard deviation of ln(diameter)",
            .null_value = 0.0,
            .initial = 0.1,
            .lower = 0.0,
            .upper = 1.0,
            .plausible = {0.0, 0.5,
                          "calibration spheres have 0.01 to 0.05, sieved powders about 0.3"},
            .starts = {0.02, 0.3}}},
      .mixes_sizes = true,
  });
}

}  // namespace recoil
