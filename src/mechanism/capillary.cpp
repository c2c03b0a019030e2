#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr double water_surface_tension = 0.0728;  // [N/m] at 293 K (IAPWS)

/// Kelvin radius r_K of a meniscus of water in equilibrium with air of this humidity [m], gamma V_m
/// / (R T ln(1 / h)) (Thomson 1871). It is 0 in dry air and very large in saturated air. The force
/// of a bridge is 4 pi r gamma (1 - D / (2 r_K)) at the distance D, so that l = r_K.
double kelvin_radius(double humidity, double temperature) {
  constexpr double molar_volume = 1.805e-5;     // of water at 293 K [m3/mol] (IAPWS)
  constexpr double gas_constant = 8.314462618;  // [J/(mol K)], CODATA 2018
  if (!(humidity > 0.0)) return 0.0;
  return water_surface_tension * molar_volume /
         (gas_constant * temperature * std::max(-std::log(humidity), 1e-9));
}

/// Below this pressure water cannot bridge the contact: the vapour then has at most 100 / 2339 of
/// the saturation pressure at 293 K (IAPWS), and the Kelvin radius is at most 0.17 nm, less than a
/// molecule of water (0.28 nm).
constexpr double no_bridge_below = 100.0;  // [Pa]

struct Capillary {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    e.dissipate(4.0 * std::numbers::pi * water_surface_tension * e.radius() * own[0]);
  }
};

}  // namespace

Mechanism capillary() {
  return make_mechanism<Capillary>({
      .id = "capillary",
      .title = "a water bridge that breaks during rebound",
      .formula = "energy loss 4 pi r gamma l: the force of the bridge times its length l at "
                 "rupture, gamma = 0.0728 N/m. If the humidity is stated, l is the Kelvin radius. "
                 "Below 100 Pa there is no bridge",
      .source = "Israelachvili, J. N., Intermolecular and Surface Forces (force of a liquid bridge "
                "at small contact angle). The Kelvin radius holds for a bridge in equilibrium with "
                "its vapour. During an impact of nanoseconds the bridge cannot grow or shrink; at "
                "constant volume it takes 8 pi r gamma r_K, twice as much. If the film is known to "
                "be thicker or thinner, state bridge_length in the fit file",
      .fingerprint =
          "1 - e^2 ~ V^(-2) d^(-2), V* ~ d^(-1); depends on the humidity and vanishes in vacuum",
      .parameters =
          {{.name = "bridge_length",
            .unit = "m",
            .meaning = "l, length of the bridge at rupture",
            .initial = 1e-9,
            .upper = 1e-5,
            .plausible =
                {0.0, 2e-8,
                 "adsorbed water is 0.3 nm to a few nm thick; a bridge breaks at a few times that"},
            .starts = {1e-10, 1e-8},
            .stated_by = {StatedBy{Condition::ambient_pressure,
                                   [](double pressure, const Surroundings&,
                                      const Conditions&) -> std::optional<double> {
                                     if (pressure >= no_bridge_below) return std::nullopt;
                                     return 0.0;
                                   }},
                          StatedBy{Condition::relative_humidity,
                                   [](double humidity, const Surroundings&,
                                      const Conditions& all) -> std::optional<double> {
                                     return kelvin_radius(
                                         humidity, all.of(Condition::temperature).value_or(293.15));
                                   }}}}},
      .taken_away = TakenAway{Condition::relative_humidity, 0.0, "dry the chamber"},
  });
}

}  // namespace recoil
