#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// Work to part a JKR contact from zero approach to its tear at fixed grips, in units of
/// (W^5 R^4 / E*^2)^(1/3): the integral of the JKR curve; Thornton & Ning (1998) print 7.09.
constexpr double parting_work = 7.0922;

struct JkrHysteresis {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const double E = e.at->reduced_modulus;
    e.lose(parting_work * std::cbrt(1.0 / (E * E)) * power(own[0], 5.0 / 3.0) *
           power(e.contact_radius, 4.0 / 3.0));
  }
};

}  // namespace

Mechanism jkr_hysteresis() {
  return make_mechanism<JkrHysteresis>({
      .id = "jkr_hysteresis",
      .title = "adhesive contact that tears later than it forms (JKR)",
      .cause = "adhesion hysteresis",
      .kind = MechanismKind::physics,
      .place = MechanismPlace::contact,
      .formula =
          "constant work lost per impact, 7.0922 (W^5 R^4 / E*^2)^(1/3); e^2 = e_0^2 - (V_s / V)^2",
      .source = "Johnson, K. L., Kendall, K. & Roberts, A. D. (1971), Proc. R. Soc. A 324, "
                "301-313; Thornton, C. & Ning, Z. (1998), Powder Technol. 99, 154-162",
      .fingerprint =
          "1 - e^2 falls like V^-2 d^(-5/3), e towards 1 far above capture; V* ~ d^(-5/6), which a "
          "freed size law takes for f0 ~ r^(5/9); V* ~ W^(5/6) between targets",
      .parameters =
          {{.name = "jkr_work",
            .unit = "J/m2",
            .meaning = "work of adhesion W of the JKR contact",
            .null_value = 0.0,
            .initial = 0.1,
            .lower = 0.0,
            .upper = 50.0,
            .plausible = {0.0, 3.0,
                          "van der Waals contacts have 0.01 to 0.3 J/m2, clean metals and "
                          "semiconductors up to 3"},
            .starts = {0.02, 0.5}}},
  });
}

}  // namespace recoil
