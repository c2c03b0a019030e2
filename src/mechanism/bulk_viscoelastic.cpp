#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

struct BulkViscoelastic {
  static constexpr bool dashpot = true;
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    e.relaxation += own[0];
  }
};

}  // namespace

Mechanism bulk_viscoelastic() {
  return make_mechanism<BulkViscoelastic>({
      .id = "bulk_viscoelastic",
      .title = "viscous loss in the deformed bulk",
      .kind = MechanismKind::physics,
      .place = MechanismPlace::contact,
      .formula = "force -(3/2) A K (r n)^(1/2) n' in both phases, in the equation of motion",
      .source = "Kuwabara, G. & Kono, K. (1987), Jpn. J. Appl. Phys. 26, 1230-1233; Brilliantov, "
                "N. V. et al. (1996), Phys. Rev. E 53, 5382-5392",
      .fingerprint = "1 - e^2 ~ V^(1/5) d^(-1), no dependence on the target's surface energy; V* ~ "
                     "d^(-17/12). At one size the same as C_A: A = (2/3) C_A n_eq",
      .parameters = {{.name = "bulk_relaxation",
                      .unit = "s",
                      .meaning = "A, relaxation time of the bulk",
                      .null_value = 0.0,
                      .initial = 1e-10,
                      .lower = 0.0,
                      .upper = 1e-3,
                      .plausible = {0.0, 1e-8,
                                    "up to 1e-9 s for organic solids, below 1e-12 s for metals; "
                                    "1e-8 s would be a rubber"},
                      .starts = {1e-12, 1e-11, 1e-9}}},
  });
}

}  // namespace recoil
