#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// Elastic-perfectly plastic contact, with p = p_Y (V / (1 m/s))^q where the rate of straining
/// raises the yield pressure. (The rate in a Hertz contact is V^(3/5) / d: that it also depends on
/// the size is left out, as it is in the recipes of the reconstructions.)
/// V_Y = (pi^2 / sqrt(40)) sqrt(p^5 / (E*^4 rho)); with
/// s = (V_Y / V)^2 < 1 and the loads in units of that at yield,
///   P = sqrt(1 + (6/5) (1/s - 1))                       at the turning point,
///   e_p^2 = (6 sqrt(3) / 5) (1 - s/6) sqrt(y / (y + 2 sqrt(6/5 - s/5))),  y = V_Y / V,
///   R_p / r = ((2 P + 1) / 3)^(3/2) / P                 of the unloading.
/// What the contact gives back is what an elastic impact at e_p V of a sphere with the curvature
/// R_p and the same mass would give back; adhesion and damping act on that one.
struct PlasticYield {
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    const T E = e.reduced_modulus();
    const double pi = std::numbers::pi;
    const T pressure = own[0] * exponential(own[1] * logarithm(e.velocity));
    const T yield_velocity = power(pressure, 2.5) * (pi * pi / (sqrt(e.density * 40.0) * E * E));
    if (!(value_of(e.velocity) > value_of(yield_velocity))) return;
    const T y = yield_velocity / e.velocity;
    const T s = y * y;
    const T load = sqrt(1.2 / s - 0.2);
    const T flatter = power((2.0 * load + 1.0) / 3.0, 1.5) / load;
    const T recovered =
        1.2 * std::sqrt(3.0) * (1.0 - s / 6.0) * sqrt(y / (y + 2.0 * sqrt(1.2 - 0.2 * s)));
    e.velocity *= sqrt(recovered);
    e.contact_radius *= flatter;
    e.adhesion_force *= power(flatter, 1.0 / 3.0);
  }
};

}  // namespace

Mechanism plastic_yield() {
  return make_mechanism<PlasticYield>({
      .id = "plastic_yield",
      .title = "plastic yielding of the contact",
      .kind = MechanismKind::physics,
      .place = MechanismPlace::contact,
      .formula = "above V_Y = 1.56 (p^5 / (E*^4 rho))^(1/2), p = p_Y (V / (1 m/s))^q: e_p^2 = (6 "
                 "sqrt(3) / 5) (1 - s/6) "
                 "(y / (y + 2 (6/5 - s/5)^(1/2)))^(1/2), y = V_Y / V, s = y^2; unloading with the "
                 "flattened radius R_p",
      .source = "Thornton, C. & Ning, Z. (1998), Powder Technol. 99, 154-162; Johnson, K. L. "
                "(1985), Contact Mechanics, section 11.5. The load at which adhesion alone yields "
                "is not lowered here",
      .fingerprint =
          "e falls with V above a threshold, concave, towards V^(-1/4), alike for all sizes and "
          "targets; the flattened contact sticks better, so that capture sets in earlier and "
          "steeper with size",
      .parameters =
          {{.name = "yield_pressure",
            .unit = "Pa",
            .meaning = "contact pressure at which the softer body flows",
            .null_value = 1e12,
            .initial = 3e8,
            .lower = 1e5,
            .upper = 1e12,
            .plausible = {1e5, 1e12, "the domain of the formula"},
            .starts = {3e7, 1e8, 1e9, 3e9},
            .log_scale = true,
            // Frenkel 1926, Z. Phys. 37, 572-609: no solid resists a shear of more than about a
            // tenth of its modulus; Tabor 1951, The Hardness of Metals: a contact flows at 2.8
            // times the yield stress, which annealed pure metals have at some 1e-4 of the modulus.
            .limit = {.quantity = "yield pressure over the reduced modulus of the bodies",
                      .lower = 5e-4,
                      .upper = 0.3,
                      .why =
                          "no solid resists more than about 0.3 of it, and only soft pure metals "
                          "flow below 0.001",
                      .sharp = true,
                      .of =
                          [](const Encounter<double>& sphere, std::span<const double> own) {
                            return own[0] / sphere.reduced_modulus();
                          }}},
           {.name = "yield_rate_exponent",
            .unit = "1",
            .meaning =
                "q, of the yield pressure with the impact velocity; p_Y is that of 10 um at 1 m/s",
            .null_value = 0.0,
            .initial = 0.0,
            .lower = 0.0,
            .upper = 0.35,
            .plausible =
                {0.0, 0.35,
                 "3/5 of the exponent of the rate: metals have 0.01 to 0.1, organic solids "
                 "up to about a third"},
            .starts = {0.1, 0.25},
            .free = false}},
  });
}

}  // namespace recoil
