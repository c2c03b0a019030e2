#include "mechanism/attraction.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr double vacuum_permittivity = 8.8541878128e-12;  // [F/m], CODATA 2018

struct ElectrostaticImage {
  /// 2 U / m, U = q^2 / (16 pi eps0 r) the energy of the charge and its image in contact.
  template <class T>
  static T gained(const Encounter<T>& e, std::span<const T> own) {
    const T growth =
        exponential((2.0 * own[1] - 4.0) * logarithm(e.diameter / e.at->reference_diameter));
    return 1.5 * vacuum_permittivity / e.density * own[0] * own[0] * growth;
  }
};

}  // namespace

Mechanism electrostatic_image() {
  return make_mechanism<Attraction<ElectrostaticImage>>({
      .id = "electrostatic_image",
      .title = "attraction of a charged sphere by its image charge",
      .kind = MechanismKind::physics,
      .place = MechanismPlace::field,
      .formula =
          "gain U on the way in, cost U on the way out: e^2 = e_0^2 - (1 - e_0^2) 2 U / (m V^2), U "
          "= q^2 / (16 pi eps0 r), q = 4 pi eps0 r^2 E_s at the reference diameter and q ~ d^p",
      .source = "Dahneke, B. (1975), J. Colloid Interface Sci. 51, 58-65 (energy balance with a "
                "potential well); Jackson, Classical Electrodynamics (image of a point charge at a "
                "conductor)",
      .fingerprint = "1 - e^2 ~ V^(-2), only where e_0 < 1; for a given surface field the same at "
                     "all sizes (V* ~ d^0), for a given charge d^(-4); gone with a neutraliser",
      .parameters = {{.name = "surface_field",
                      .unit = "V/m",
                      .meaning = "E_s, field of the charge at the sphere's surface",
                      .null_value = 0.0,
                      .initial = 1e6,
                      .lower = 0.0,
                      .upper = 1e9,
                      // Around a sphere of micrometres it takes more: by Peek's law 1e8 V/m around
                      // 5 um in air, by emission 9e8 V/m in vacuum. What is so highly charged was
                      // charged on purpose, and its charge is known.
                      .plausible = {0.0, 3e6,
                                    "air at a plane breaks down above this, and spheres that "
                                    "nobody charged carry less"},
                      .starts = {3e6, 1e7},
                      .stated_by = none_where(Condition::neutralised)},
                     {.name = "charge_exponent",
                      .unit = "1",
                      .meaning = "p, exponent of the charge in the diameter",
                      .null_value = 2.0,
                      .initial = 2.0,
                      .lower = -2.0,
                      .upper = 4.0,
                      .plausible = {0.0, 2.0,
                                    "0 for a fixed charge, 1 to 2 for spheres from a charger"},
                      .free = false}},
      .taken_away = TakenAway{Condition::neutralised, 1.0, "neutralise the spheres"},
  });
}

}  // namespace recoil
