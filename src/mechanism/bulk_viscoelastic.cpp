#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

struct BulkViscoelastic {
  static constexpr bool dashpot = true, never_pulls = true;
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
      .dry_loss = "viscoelastic",
      .formula = "force -(3/2) A K (r n)^(1/2) n' in both phases, in the equation of motion; "
                 "it and the elastic force together push or are 0",
      .source = "Kuwabara, G. & Kono, K. (1987), Jpn. J. Appl. Phys. 26, 1230-1233; Brilliantov, "
                "N. V. et al. (1996), Phys. Rev. E 53, 5382-5392; "
                "Schwager, T. & Poeschel, T. (2008), Phys. Rev. E 78, 051304 (end of the push)",
      .fingerprint = "1 - e^2 ~ V^(1/5) d^(-1), independent of the target's surface energy; V* ~ "
                     "d^(-17/12). At one size it equals C_A: A = (2/3) C_A n_eq",
      .parameters = {{.name = "bulk_relaxation",
                      .unit = "s",
                      .meaning = "A, relaxation time of the bulk",
                      .initial = 1e-10,
                      .upper = 0.1,
                      .plausible = {0.0, 0.1, "limit of the formula"},
                      .starts = {1e-12, 1e-11, 1e-9},
                      // Ferry 1980, Viscoelastic Properties of Polymers: glasses have 0.01 to 0.1,
                      // rubbers about 1 at the glass transition.
                      .limit = {.quantity = "loss tangent of the contact, pi A over its duration",
                                .upper = 1.0,
                                .why = "organic solids have 0.01 to 0.1, metals less, rubbers at "
                                       "most about 1; the law does not hold beyond that",
                                .of =
                                    [](const Encounter<double>& sphere,
                                       std::span<const double> own) {
                                      return std::numbers::pi * own[0] /
                                             sphere.hertz_contact_time();
                                    }}}},
  });
}

}  // namespace recoil
