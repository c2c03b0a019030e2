#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr double vacuum_permittivity = 8.8541878128e-12;  // [F/m], CODATA 2018

// Field emission begins here (Hinds, Aerosol Technology, chapter on charging; Gomer, Field Emission
// and Field Ionization). A positive sphere draws electrons from the target.
constexpr double emission_field = 9e8;  // [V/m]
constexpr double vacuum_below =
    100.0;  // [Pa]; gaps of micrometres to centimetres do not break down
// The highest potential by triboelectric charging, from walking on dry carpet (DOD-HDBK-263).
constexpr double handling_potential = 35e3;  // [V]

/// Field at which air breaks down around a sphere of radius r (Peek 1929, Dielectric Phenomena in
/// High Voltage Engineering), 2.72 MV/m D (1 + 0.054 (m / (D r))^(1/2)), D the density of the air
/// over that at 25 C and 1 atm [V/m].
double breakdown_field(double pressure, double temperature, double radius) {
  const double density = pressure / 101325.0 * 298.15 / temperature;
  return 2.72e6 * density * (1.0 + 0.054 / std::sqrt(density * radius));
}

/// Field of a sphere divided by the largest possible one, which the breakdown of the gas and the
/// charging by handling limit. Without a stated pressure the gas is air at 1 atm.
double field_over_strongest(const Encounter<double>& sphere, std::span<const double> own) {
  const double radius = sphere.radius();
  const double field =
      own[0] * std::pow(sphere.diameter / sphere.at->reference_diameter, own[1] - 2.0);
  const double pressure =
      sphere.at->stated(Condition::ambient_pressure, sphere.series).value_or(Air().pressure);
  const double held =
      pressure < vacuum_below
          ? emission_field
          : std::min(emission_field, breakdown_field(pressure, sphere.air().temperature, radius));
  return field / std::min(held, handling_potential / radius);
}

struct ElectrostaticImage {
  /// 2 U / m, U = k q^2 / (16 pi eps0 r) the energy of the charge and its image in contact.
  template <class T>
  static T gained(const Encounter<T>& e, std::span<const T> own) {
    const T growth =
        exponential((2.0 * own[1] - 4.0) * logarithm(e.diameter / e.at->reference_diameter));
    return 1.5 * vacuum_permittivity * e.at->image_factor / e.density * own[0] * own[0] * growth;
  }
};

}  // namespace

Mechanism electrostatic_image() {
  return make_mechanism<Attraction<ElectrostaticImage>>({
      .id = "electrostatic_image",
      .title = "attraction of a charged sphere by its image charge",
      .place = MechanismPlace::field,
      .needs_flat = true,
      .formula = "the sphere gains the energy U before contact and loses it after: e^2 = e_0^2 - "
                 "(1 - e_0^2) 2 U / (m V^2), U = k q^2 / (16 pi eps0 r), q = 4 pi eps0 r^2 E_s at "
                 "the reference diameter and q ~ d^p; k = (eps - 1) / (eps + 1) for a target of "
                 "the stated relative_permittivity eps; if none is stated, k = 1, the value of a "
                 "conductor and the largest",
      .source = "Dahneke, B. (1975), J. Colloid Interface Sci. 51, 58-65 (energy balance with a "
                "potential well); Jackson, Classical Electrodynamics (image of a point charge at a "
                "conductor and at a dielectric)",
      .fingerprint = "1 - e^2 ~ V^(-2), only if e_0 < 1; the same at all sizes for a given surface "
                     "field (V* ~ d^0), d^(-4) for a given charge; vanishes with a neutraliser",
      .parameters =
          {{.name = "surface_field",
            .unit = "V/m",
            .meaning = "E_s, field of the charge at the sphere's surface",
            .initial = 1e6,
            .upper = 1e10,
            .plausible = {0.0, 1e10, "limit of the formula"},
            .starts = {1e7, 1e8, 1e9},
            .limit =
                {.quantity = "surface field / largest field that the sphere can hold",
                 .upper = 1.0,
                 .why = "the field is limited by the breakdown of air (Peek's law) and by electron "
                        "emission at 9e8 V/m; handling charges a sphere to at most 35 kV",
                 .of = field_over_strongest},
            .stated_by = {none_where(Condition::neutralised)}},
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
