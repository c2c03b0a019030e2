#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr double closest = 0.4e-9;  // z0, distance of two surfaces in contact [m]

struct VanDerWaalsApproach {
  /// 2 U / m, U = A R / (6 z0).
  template <class T>
  static T gained(const Encounter<T>& e, std::span<const T> own) {
    return own[0] * e.radius() / (3.0 * closest * e.mass());
  }
};

}  // namespace

Mechanism van_der_waals_approach() {
  return make_mechanism<Attraction<VanDerWaalsApproach>>({
      .id = "van_der_waals_approach",
      .title = "attraction of the surfaces before they touch",
      .place = MechanismPlace::field,
      .formula = "gain U = A R / (6 z0) on the way in, z0 = 0.4 nm, cost U on the way out: e^2 = "
                 "e_0^2 - (1 - e_0^2) 2 U / (m V^2)",
      .source =
          "Hamaker, H. C. (1937), Physica 4, 1058-1072; Dahneke, B. (1975), J. Colloid "
          "Interface Sci. 51, 58-65 (energy balance with a potential well). Only A / z0 is "
          "fitted: with the z0 of 0.165 nm that Israelachvili takes for surface energies, A is "
          "0.41 of the value given here",
      .fingerprint = "1 - e^2 ~ V^(-2) d^(-2), only where e_0 < 1; V* ~ d^(-1) where it decides",
      .parameters =
          {{.name = "hamaker_constant",
            .unit = "J",
            .meaning = "A, Hamaker's constant of the two bodies",
            .initial = 1e-19,
            .upper = 1e-15,
            .plausible = {0.0, 5e-19,
                          "organic solids have 0.5e-19 J, oxides 1e-19 J, metals 3e-19 to 5e-19 J "
                          "(Israelachvili, Intermolecular and Surface Forces)"},
            .starts = {1e-20, 1e-18}}},
      .refused = [](AdhesionLaw law) -> std::string_view {
        if (!traits(law).attracts_at_distance) return {};
        return "that law has the attraction before contact itself: it would count twice";
      },
  });
}

}  // namespace recoil
