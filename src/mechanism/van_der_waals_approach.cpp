#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

struct VanDerWaalsApproach {
  /// 2 U / m, U = A R / (6 z0), with the distance z0 of two surfaces in contact.
  template <class T>
  static T gained(const Encounter<T>& e, std::span<const T> own) {
    return own[0] * e.radius() / (3.0 * equilibrium_separation * e.mass());
  }
};

}  // namespace

Mechanism van_der_waals_approach() {
  return make_mechanism<Attraction<VanDerWaalsApproach>>({
      .id = "van_der_waals_approach",
      .title = "attraction of the surfaces before they touch",
      .place = MechanismPlace::field,
      .formula = "the sphere gains the energy U = A R / (6 z0), z0 = 0.4 nm, before contact and "
                 "loses it after: e^2 = e_0^2 - (1 - e_0^2) 2 U / (m V^2)",
      .source = "Hamaker, H. C. (1937), Physica 4, 1058-1072; Dahneke, B. (1975), J. Colloid "
                "Interface Sci. 51, 58-65 (energy balance with a potential well). Only A / z0 is "
                "fitted; with z0 = 0.165 nm, which Israelachvili uses for surface energies, A is "
                "0.41 times the value given here",
      .fingerprint =
          "1 - e^2 ~ V^(-2) d^(-2), only if e_0 < 1; V* ~ d^(-1) if it causes the capture",
      .parameters =
          {{.name = "hamaker_constant",
            .unit = "J",
            .meaning = "A, Hamaker constant of the two bodies",
            .initial = 1e-19,
            .upper = 1e-15,
            .plausible = {0.0, 5e-19,
                          "organic solids have 0.5e-19 J, oxides 1e-19 J, metals 3e-19 to 5e-19 J "
                          "(Israelachvili, Intermolecular and Surface Forces)"},
            .starts = {1e-20, 1e-18}}},
      .refused = [](AdhesionLaw law) -> std::string_view {
        if (!traits(law).attracts_at_distance) return {};
        return "that law already contains the attraction before contact, which would count twice";
      },
  });
}

}  // namespace recoil
