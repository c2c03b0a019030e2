#include <algorithm>

#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr double vacuum_permittivity = 8.8541878128e-12;  // [F/m], CODATA 2018

/// Field at which the surface of a sphere discharges [V/m]. In air of the density delta (1 at 1
/// atm) Peek's law for spheres, 2.72e6 delta (1 + 0.54 / sqrt(delta r / cm)): that of electrodes of
/// millimetres and more, taken far below here, up to what emission from the surface allows, 9e8 V/m
/// for electrons (2.1e10 V/m for positive ions). Where the free path of the molecules exceeds ten
/// radii no avalanche grows and emission alone limits; so it does where nobody says what is around.
double breakdown_field(const Encounter<double>& sphere) {
  constexpr double emission = 9e8;
  constexpr double free_path_times_pressure = 66e-9 * 101325.0;  // Hinds [m Pa]
  const double r = 0.5 * sphere.diameter;
  if (!sphere.at->ambient_pressure) return emission;
  const double pressure = *sphere.at->ambient_pressure;
  if (free_path_times_pressure > 10.0 * r * pressure) return emission;
  const double delta = pressure / 101325.0;
  return std::min(emission, 2.72e6 * delta * (1.0 + 0.54 / std::sqrt(delta * r / 0.01)));
}

struct ElectrostaticImage {
  /// 2 U / m, U = q^2 / (16 pi eps0 r) the energy of the charge and its image in contact.
  template <class T>
  static T gained(const Encounter<T>& e, std::span<const T> own) {
    const T growth =
        exponential((2.0 * own[1] - 4.0) * logarithm(e.diameter / e.at->reference_diameter));
    return 1.5 * vacuum_permittivity / e.at->density * own[0] * own[0] * growth;
  }
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    e.velocity = sqrt(e.velocity * e.velocity + gained(e, own));
  }
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    e.square -= gained(e, own);
  }
};

}  // namespace

Mechanism electrostatic_image() {
  return make_mechanism<ElectrostaticImage>({
      .id = "electrostatic_image",
      .title = "attraction of a charged sphere by its image",
      .kind = MechanismKind::physics,
      .place = MechanismPlace::field,
      .formula =
          "gain U on the way in, cost U on the way out: e^2 = e_0^2 - (1 - e_0^2) 2 U / (m V^2), U "
          "= q^2 / (16 pi eps0 r), q = 4 pi eps0 r^2 E_s at the reference diameter and q ~ d^p",
      .source =
          "Dahneke, B. (1975), J. Colloid Interface Sci. 51, 58-65 (energy balance with a "
          "potential well); Jackson, Classical Electrodynamics (image of a point charge at a "
          "conductor; a target of the permittivity eps has (eps - 1) / (eps + 1) of U, 0.6 for "
          "4, which is not known here). A metal sphere on a metal gives its charge away in the "
          "contact and pays nothing back",
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
            .plausible = {0.0, 1e9, "the domain of the formula"},
            .starts = {3e6, 1e7, 1e8},
            // Peek 1929, Dielectric Phenomena in High Voltage Engineering; Hinds, Aerosol
            // Technology (charge limits of solid particles).
            .limit = {.quantity = "field at the surface over that of breakdown",
                      .upper = 1.0,
                      .why = "air at 1 atm holds 2.72e6 (1 + 0.54 / (r / cm)^(1/2)) V/m "
                             "around a sphere (Peek 1929, from electrodes of mm and "
                             "more), vacuum 9e8 V/m (emission of electrons; Hinds, Aerosol "
                             "Technology); where the dataset states no ambient_pressure, "
                             "the larger counts",
                      .of =
                          [](const Encounter<double>& sphere, std::span<const double> own) {
                            const double growth = sphere.diameter / sphere.at->reference_diameter;
                            return own[0] * std::pow(growth, own[1] - 2.0) /
                                   breakdown_field(sphere);
                          }}},
           {.name = "charge_exponent",
            .unit = "1",
            .meaning = "p, of the charge with the diameter",
            .null_value = 2.0,
            .initial = 2.0,
            .lower = -2.0,
            .upper = 4.0,
            .plausible = {0.0, 2.0, "0 for a fixed charge, 1 to 2 for what chargers give"},
            .free = false}},
  });
}

}  // namespace recoil
