#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// Integral of (d x^(3/2) / d tau)^2 over a Hertzian impact, 4.5 times that of x sqrt(1 - (4/5)
/// x^(5/2)) up to x_m = (5/4)^(2/5): 1.8 x_m^2 B(4/5, 3/2).
const double force_rate_squared =
    1.8 * std::pow(1.25, 0.8) * std::exp(std::lgamma(0.8) + std::lgamma(1.5) - std::lgamma(2.3));

struct ElasticWaves {
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    // F = (m V^2 / n_c) x^(3/2), t = (n_c / V) tau
    const T scale = e.scale();
    const T force = e.mass() * e.velocity * e.velocity / scale;
    e.dissipate(own[0] * e.wave_mobility * force_rate_squared * force * force * e.velocity / scale);
  }
};

}  // namespace

Mechanism elastic_waves() {
  return make_mechanism<ElasticWaves>({
      .id = "elastic_waves",
      .title = "elastic waves radiated into a thick target",
      .needs_flat = true,
      .formula = "energy loss eta D (integral of F'^2 dt), with the force F of the Hertzian impact "
                 "and D = c(nu) / (2 pi mu c_T) of the target (c(1/4) = 0.931)",
      .source = "Hunter, S. C. (1957), J. Mech. Phys. Solids 5, 162-171; Miller, G. F. & Pursey, "
                "H. (1955), Proc. R. Soc. A 233, 55-69. If the dataset states no density of the "
                "surface, that of the sphere is used",
      .fingerprint = "1 - e^2 ~ V^(3/5), the same at all sizes; about 1 % for steel and 0.1 % for "
                     "organic spheres",
      .parameters =
          {{.name = "wave_radiation",
            .unit = "1",
            .meaning = "eta, radiated energy in units of that of an elastic half-space",
            .initial = 1.0,
            .upper = 1e4,
            .plausible = {0.0, 3.0,
                          "the theory gives 1; values up to 3 allow for an unstated density"},
            .starts = {10.0}}},
  });
}

}  // namespace recoil
