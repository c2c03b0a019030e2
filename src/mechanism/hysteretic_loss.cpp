#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

struct HystereticLoss {
  /// Loses a share of the elastic energy at the deepest point, which is m V^2 / 2 without adhesion.
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    e.dissipate(own[0] * e.stored_energy());
  }
};

}  // namespace

Mechanism hysteretic_loss() {
  return make_mechanism<HystereticLoss>({
      .id = "hysteretic_loss",
      .title = "a constant share of the elastic energy is lost",
      .dry_loss = "constant",
      .formula = "energy loss eta (2/5) K R^(1/2) n_max^(5/2), a share eta of the elastic energy "
                 "at the deepest point of the undamped impact; without adhesion e^2 = e_0^2 - eta",
      .source = "Greenwood, J. A., Minshall, H. & Tabor, D. (1961), Proc. R. Soc. A 259, 480-507 "
                "(hysteresis of rubber); Johnson, K. L. (1985), Contact Mechanics, section 9.2; "
                "that damping makes the contact smaller is neglected",
      .fingerprint =
          "1 - e^2 ~ V^0 d^0: e is lower by the same amount at all velocities, sizes and targets, "
          "as long as adhesion is small; without adhesion it causes no capture",
      .parameters = {{.name = "hysteretic_share",
                      .unit = "1",
                      .meaning = "eta, share of the elastic energy that is lost",
                      .initial = 0.05,
                      .upper = 1.0,
                      .plausible = {0.0, 0.8,
                                    "about pi times the loss tangent: steel has 0.001, wood 0.1, "
                                    "golf balls and rubber 0.2 to 0.6"},
                      .starts = {0.01, 0.2}}},
  });
}

}  // namespace recoil
