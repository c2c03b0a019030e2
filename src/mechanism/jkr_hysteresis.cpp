#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// Work to separate a JKR contact from zero approach to its instability at fixed grips, in units of
/// (W^5 R^4 / E*^2)^(1/3): the integral of the JKR curve. Thornton & Ning (1998) print 7.09.
constexpr double parting_work = 7.092195971863959;

/// mu = (R W^2 / (E*^2 z0^3))^(1/3).
double tabor_parameter(const Encounter<double>& sphere, std::span<const double> own) {
  const double ratio = own[0] * sphere.adhesion_energy / sphere.reduced_modulus();
  return std::cbrt(sphere.radius() * ratio * ratio) / equilibrium_separation;
}

struct JkrHysteresis {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const T work = own[0] * e.adhesion_energy;
    e.dissipate(parting_work * power(e.reduced_modulus(), -2.0 / 3.0) * power(work, 5.0 / 3.0) *
                power(e.contact_radius, 4.0 / 3.0));
  }
};

}  // namespace

Mechanism jkr_hysteresis() {
  return make_mechanism<JkrHysteresis>({
      .id = "jkr_hysteresis",
      .title = "adhesive contact that breaks at a larger distance than it forms (JKR)",
      .cause = "adhesion hysteresis",
      .formula = "a constant energy loss per impact, 7.0922 (W^5 R^4 / E*^2)^(1/3), W = s W_A with "
                 "W_A of the two bodies; e^2 = e_0^2 - (V_s / V)^2",
      .source =
          "Johnson, K. L., Kendall, K. & Roberts, A. D. (1971), Proc. R. Soc. A 324, 301-313; "
          "Thornton, C. & Ning, Z. (1998), Powder Technol. 99, 154-162. The factor 7.0922 holds "
          "for Tabor parameters mu = (R W^2 / (E*^2 z0^3))^(1/3) (z0 = 0.4 nm) above about 3 to 5 "
          "and falls to 0 towards 1: Greenwood, J. A. (1997), Proc. R. Soc. A 453, 1277-1297",
      .fingerprint = "1 - e^2 ~ V^(-2) d^(-5/3): e approaches 1 far above capture; V* ~ d^(-5/6), "
                     "which a free size law fits as f0 ~ r^(5/9); V* ~ W_A^(5/6) between targets",
      .parameters =
          {{.name = "jkr_factor",
            .unit = "1",
            .meaning = "s, work of adhesion of the JKR contact / W_A",
            .initial = 0.3,
            .upper = 150.0,
            .plausible = {0.0, 3.0,
                          "rough or covered surfaces have less than W_A, down to a hundredth; for "
                          "soft solids Gilman's estimate is about half of the measured value"},
            .starts = {0.05, 1.5},
            .limit =
                {.quantity = "Tabor parameter mu of the largest sphere",
                 .lower = 1.0,
                 .why =
                     "below it a contact jumps neither in nor out, and no hysteresis is expected",
                 .of = tabor_parameter}}},
      .needs_adhesion = true,
      .refused = [](AdhesionLaw law) -> std::string_view {
        if (law == AdhesionLaw::ring) return {};
        return traits(law).jumps ? "that law already contains this loss, which would count twice"
                                 : "such a contact forms and separates without a jump";
      },
  });
}

}  // namespace recoil
