#include "mechanism/adhesive_yield.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// The diameter at which p_Y is stated if it depends on the strain rate; the velocity is 1 m/s.
constexpr double rate_diameter = 10e-6;  // [m]

/// The least recovered share of the incident energy with which the base impact is simulated. With
/// less the sphere is captured anyway.
constexpr double least_recovered = 0.01;

/// The onset of finite deformation, V_t^2 rho / p with the V_t of the formula of `plastic_yield`.
/// There the two laws of Wu, Li & Thornton (2003) intersect, e = 2.08 (V / V_y)^(-1/4) and e = 0.62
/// (V Y / (V_y E*))^(-1/2): V = 0.0079 (E* / Y)^2 V_y, where V_y is Johnson's for 1.6 Y. The first
/// law is Thornton & Ning's limit 1.185 (V_Y / V)^(1/4) for p = 3.94 Y.
constexpr double finite_deformation = 4.03e-4;

/// Elastic-perfectly plastic contact with the adhesion of the base model, see `adhesive_yield`. The
/// strain rate in a Hertz contact is (a / r) / t_c ~ V^(3/5) / d. If the yield pressure increases
/// with its power 5q/3,
///   p = p_Y (V / (1 m/s))^q (d / (10 um))^(-5q/3).
/// The work of adhesion is s times the W that corresponds to the f0 of the ring law (eqs 9 and 10
/// of Li, Dunn & Brach 1999).
///
/// The energy recovered between turning point and zero approach is assigned to an elastic impact of
/// a sphere with the curvature R_p and the same mass. Adhesion and damping of the ring law and the
/// other losses act on this impact. Of the adhesion, this mechanism includes only the effect on the
/// yielding. The work of separation of a JKR contact is `jkr_hysteresis`, with the radius R_p. Both
/// together are the full law of Thornton & Ning, without overlap.
struct PlasticYield {
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    const T E = e.reduced_modulus();
    const double pi = std::numbers::pi;
    const T r = e.radius();
    const T density =
        e.mass() / (r * r * r * (4.0 / 3.0 * pi));  // of two spheres: as one on a flat
    const T rate = logarithm(e.velocity) - 5.0 / 3.0 * logarithm(r / (0.5 * rate_diameter));
    const T pressure = own[0] * exponential(own[1] * rate);
    const T speed = e.velocity * e.velocity;
    // m V^2 / 2 and W in the units of `adhesive_yield`.
    const T energy = density * power(E / pi, 4.0) * speed / power(pressure, 5.0) * (32.0 / 3.0);
    T tension(0.0);
    if (value_of(e.adhesion_force) > 0.0 && value_of(own[2]) > 0.0) {
      const T work =
          own[2] * power(2.0 * pi * e.adhesion_force, 1.5) / (sqrt(e.stiffness * r) * (6.0 * pi));
      tension = E * (2.0 / pi) * sqrt(work / (r * pressure)) / pressure;
    }
    const AdhesiveYield yield = adhesive_yield(value_of(energy), value_of(tension));
    if (!yield.yielded) return;
    e.flow_pressure = value_of(pressure);
    e.flow_radius = yield.contact * pi * value_of(r) * e.flow_pressure / (2.0 * value_of(E));
    T recovered = yield.recovered;
    add_slopes(recovered, yield.recovered_by_energy, energy);
    add_slopes(recovered, yield.recovered_by_tension, tension);
    T flatness = yield.flatness;
    add_slopes(flatness, yield.flatness_by_energy, energy);
    add_slopes(flatness, yield.flatness_by_tension, tension);

    const T past = own[3] * own[3] * speed * density / (finite_deformation * pressure);
    const T back = recovered / energy * speed / power(1.0 + past, 0.25);
    // A sphere that does not come back to zero approach is captured. Its base impact is so slow
    // that it does not matter.
    const T least = least_recovered * speed;
    const T entering =
        value_of(back) < value_of(least) ? least * least / (2.0 * least - back) : back;
    e.square += back - entering;
    e.velocity = sqrt(entering);
    e.contact_radius *= flatness;
    e.adhesion_force *= power(flatness, 1.0 / 3.0);
  }
};

}  // namespace

Mechanism plastic_yield() {
  return make_mechanism<PlasticYield>({
      .id = "plastic_yield",
      .title = "plastic yielding of the contact",
      .dry_loss = "yield",
      .formula = "the pressure of the JKR contact is limited to p = p_Y (V / (1 m/s))^q (d / (10 "
                 "um))^(-5q/3) during approach; the contact unloads with the flattened radius R_p: "
                 "e_p^2 = (U(a*) - U(a_0)) / (m V^2 / 2), U(a) = (8/15) E* a^5 / R_p^2 - (4/3) (2 "
                 "pi W E*)^(1/2) a^(7/2) / R_p + pi W a^2 from the turning point a* back to zero "
                 "approach, a_0^3 = 2 pi W R_p^2 / E*; W = s (2 pi f0)^(3/2) / (6 pi (K r)^(1/2)). "
                 "Without adhesion, above V_Y = 1.56 (p^5 / (E*^4 rho))^(1/2): e_p^2 = (6 sqrt(3) "
                 "/ 5) (1 - y^2/6) (y / (y + 2 (6/5 - y^2/5)^(1/2)))^(1/2), y = V_Y / V. Times (1 "
                 "+ (c V / V_t)^2)^(-1/4), V_t = 0.020 (p / rho)^(1/2). Between two spheres "
                 "d is 2 R* and rho is m* / ((4/3) pi R*^3)",
      .source =
          "Thornton, C. & Ning, Z. (1998), Powder Technol. 99, 154-162; Johnson, K. L. (1985), "
          "Contact Mechanics, section 11.5; for c Wu, C.-Y., Li, L.-Y. & Thornton, C. (2003), Int. "
          "J. Impact Eng. 28, 929-946, whose finite elements give e ~ V^(-1/2); the factor that "
          "joins both laws lies 8 % below the two asymptotes at V_t. It holds if V_t is far above "
          "V_Y, p below 0.05 E*; stronger solids first reach large elastic strains",
      .fingerprint =
          "above a threshold e falls with V, concave, towards V^(-1/4 + 5q/8), the same for all "
          "targets, and for all sizes if q = 0. If q > 0, small spheres strain faster and lose "
          "less: e ~ d^(-25q/24). Near capture, adhesion helps the contact to yield, and the "
          "flattened contact adheres more strongly: V* is higher and depends more strongly on size",
      .parameters =
          {{.name = "yield_pressure",
            .unit = "Pa",
            .meaning = "contact pressure at which the softer body yields",
            .null_value = 1e12,
            .initial = 3e8,
            .lower = 1e5,
            .upper = 1e12,
            .plausible = {1e5, 1e12, "limit of the formula"},
            .starts = {3e7, 1e8, 1e9, 3e9},
            .log_scale = true,
            // Frenkel 1926, Z. Phys. 37, 572-609: no solid resists a shear of more than about a
            // tenth of its modulus; Tabor 1951, The Hardness of Metals: a contact flows at 2.8
            // times the yield stress, which annealed pure metals have at some 1e-4 of the modulus.
            .limit = {.quantity = "yield pressure / reduced modulus",
                      .lower = 5e-4,
                      .upper = 0.3,
                      .why = "no solid withstands more than about 0.3; only soft pure metals yield "
                             "below 0.001",
                      .sharp = true,
                      .of =
                          [](const Encounter<double>& sphere, std::span<const double> own) {
                            return own[0] / sphere.reduced_modulus();
                          }}},
           {.name = "yield_rate_exponent",
            .unit = "1",
            .meaning = "q, exponent of the yield pressure in the impact velocity; p_Y is the value "
                       "for 10 um at 1 m/s",
            .upper = 0.35,
            .plausible = {0.0, 0.35,
                          "it is 3/5 of the exponent of the strain rate: metals have 0.01 to 0.1, "
                          "organic solids up to about a third"},
            .starts = {0.1, 0.25},
            .free = false},
           {.name = "yield_adhesion",
            .unit = "1",
            .meaning = "s, work of adhesion of the yielding contact / that of f0",
            .initial = 1.0,
            .upper = 100.0,
            .plausible = {0.0, 3.0, "the adhesion of the base model within its uncertainty"},
            .free = false,
            .searched = false},
           {.name = "finite_deformation",
            .unit = "1",
            .meaning = "c, scale of the loss at large deformation: 1 as in the finite elements, 0 "
                       "for none",
            .upper = 10.0,
            .plausible = {0.0, 1.0, "between no such loss and that of the finite elements"},
            .free = false,
            .searched = false}},
      .needs_flow = true,
  });
}

}  // namespace recoil
