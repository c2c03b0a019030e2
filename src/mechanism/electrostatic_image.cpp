#include "mechanism/attraction.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr double vacuum_permittivity = 8.8541878128e-12;  // [F/m], CODATA 2018

constexpr double emission = 1e9;  // of electrons (Hinds, Aerosol Technology, section 15.9) [V/m]
constexpr double atmosphere = 101325.0;  // [Pa]

/// The field at the surface of a sphere of this radius [m] at which the gas around it breaks down
/// [V/m]: the smaller the sphere, the shorter the way on which the field could make an avalanche.
/// Peek, F. W. (1929), Dielectric Phenomena in High Voltage Engineering: 27.2 D (1 + 0.54 / sqrt(D
/// r / cm)) kV/cm around spheres, D the density of the air over that at 1 atm. In a vacuum it is
/// left to emission.
double breakdown_field(double radius, double pressure) {
  const double density = pressure / atmosphere;
  if (density < 0.01) return emission;
  return std::min(emission, 2.72e6 * density * (1.0 + 0.54 / std::sqrt(density * radius * 100.0)));
}

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
      .parameters =
          {{.name = "surface_field",
            .unit = "V/m",
            .meaning = "E_s, field of the charge at the sphere's surface",
            .null_value = 0.0,
            .initial = 1e6,
            .lower = 0.0,
            .upper = 1e9,
            .plausible = {0.0, emission, "electrons leave a surface above 1e9 V/m, even in vacuum"},
            .starts = {3e6, 1e7},
            .limit = {.quantity = "field over that at which the gas breaks down around "
                                  "the sphere (Peek),",
                      .upper = 1.0,
                      .why = "a corona takes off what is more",
                      .of =
                          [](const Encounter<double>& sphere, std::span<const double> own) {
                            const double ratio = sphere.diameter / sphere.at->reference_diameter;
                            return own[0] * std::pow(ratio, own[1] - 2.0) /
                                   breakdown_field(sphere.diameter / 2.0,
                                                   sphere.at->ambient_pressure);
                          }},
            .stated_by = StatedBy{Condition::neutralised,
                                  [](double neutralised, const Surroundings&,
                                     const Conditions&) -> std::optional<double> {
                                    if (neutralised == 0.0) return std::nullopt;
                                    return 0.0;
                                  }}},
           {.name = "charge_exponent",
            .unit = "1",
            .meaning = "p, exponent of the charge in the diameter",
            .null_value = 2.0,
            .initial = 2.0,
            .lower = -2.0,
            .upper = 4.0,
            .plausible = {0.0, 2.0, "0 for a fixed charge, 1 to 2 for spheres from a charger"},
            .free = false}},
      .taken_away = TakenAway{Condition::neutralised, 1.0, "neutralise the spheres"},
  });
}

}  // namespace recoil
