#include "mechanism/mechanism.hpp"
#include "mechanism/survivors_mean.hpp"

namespace recoil {
namespace {

struct SurvivorBias {
  template <class T>
  static void vary(Encounter<T>& e, std::span<const T> own, double z) {
    e.adhesion_force *= exponential(own[0] * (cut_scale() * z));
  }
};

}  // namespace

Mechanism survivor_bias() {
  return make_mechanism<SurvivorBias>({
      .id = "survivor_bias",
      .title = "adhesion varies from impact to impact, and only rebounds are averaged",
      .cause = "unequal impacts averaged in one point",
      .kind = MechanismKind::measurement,
      .place = MechanismPlace::spread,
      .formula = "f0 is lognormal from impact to impact, truncated at 2.62 standard deviations of "
                 "ln f0; a point is the mean e of rebounds",
      .source = "Rabinovich, Y. I. et al. (2000), J. Colloid Interface Sci. 232, 10-16 (scatter of "
                "the adhesion between rough surfaces)",
      .fingerprint = "flattens e(V) near capture and hides the capture velocity: some spheres "
                     "rebound at velocities at which the typical one sticks",
      .parameters = {{.name = "adhesion_spread",
                      .unit = "1",
                      .meaning = "standard deviation of ln(f0) from impact to impact",
                      .initial = 0.2,
                      .upper = 1.5,
                      .plausible = {0.0, 0.6,
                                    "roughness makes pull-off forces scatter by 20 to 50 %"},
                      .starts = {0.05, 0.5}}},
  });
}

}  // namespace recoil
