#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

struct PlateFlexure {
  static constexpr bool dashpot = true;
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    e.relaxation += e.mass() * own[0];
  }
};

}  // namespace

Mechanism plate_flexure() {
  return make_mechanism<PlateFlexure>({
      .id = "plate_flexure",
      .title = "flexural waves in a thin target",
      .needs_flat = true,
      .formula =
          "at the point of impact the target moves with the velocity F / Z: n'' = -F / m - F' / Z, "
          "for a plate of thickness H with Z = (4 / sqrt(3)) H^2 (E_2 rho_2 / (1 - nu_2^2))^(1/2)",
      .source = "Zener, C. (1941), Phys. Rev. 59, 669-673. Flexure by the adhesion force is "
                "neglected. A target thicker than c_T t_c / 2 acts as a half-space: no reflected "
                "wave returns during the contact",
      .fingerprint = "1 - e^2 ~ V^(1/5) d^(+2): large spheres lose most, the opposite of adhesion; "
                     "independent of the surface energy",
      .parameters =
          {{.name = "plate_mobility",
            .unit = "s/kg",
            .meaning = "1 / Z, velocity of the target per force",
            .initial = 1e-1,
            .upper = 1e9,
            .plausible =
                {0.0, 1e3,
                 "a silicon wafer of 0.5 mm has 0.1 s/kg, a mica sheet of 10 um about 300 s/kg"},
            .starts = {1.0, 10.0, 100.0},
            .stated_by = {StatedBy{Condition::target_thickness,
                                   [](double thickness, const Surroundings& at,
                                      const Conditions&) -> std::optional<double> {
                                     if (!(at.plate_impedance > 0.0)) return std::nullopt;
                                     return 1.0 / (at.plate_impedance * thickness * thickness);
                                   }}}}},
      .taken_away =
          TakenAway{Condition::target_thickness, 0.05,
                    "use a plate so thick that no reflected wave returns during the contact",
                    // from the struck face to the other and back, at the speed of shear waves
                    [](const Encounter<double>& sphere) {
                      return 0.5 * sphere.at->shear_speed * sphere.hertz_contact_time();
                    }},
  });
}

}  // namespace recoil
