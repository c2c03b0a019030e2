#include "impact/sensitivity.hpp"

#include <cassert>

#include "data/contact.hpp"

namespace recoil {

ImpactSensitivity impact_sensitivity(const ImpactConditions& c, const ImpactResult& impact) {
  const auto [by_alpha, by_beta, by_gamma, by_kappa, by_range] = impact.gradient;
  assert(by_kappa == 0.0);  // the base model only
  static_cast<void>(by_kappa);
  const ImpactGroups groups = impact_groups(c);
  ImpactConditions unit_adhesion = c;
  unit_adhesion.adhesion_force = 1.0;
  const double along_beta = groups.beta * by_beta;
  ImpactSensitivity s;
  // lambda ~ f0 / K
  const double along_range = groups.range * by_range;
  s.diameter = -along_beta / c.diameter;
  s.velocity = (groups.alpha * by_alpha - 0.8 * along_beta + groups.gamma * by_gamma) / c.velocity;
  s.density = -0.4 * along_beta / c.density;
  s.stiffness = -(0.6 * along_beta + along_range) / c.stiffness;
  s.adhesion_force = impact_groups(unit_adhesion).beta * by_beta +
                     maugis_parameter_per_force(c.stiffness, c.separation) * by_range;
  s.hertz_damping = c.velocity * by_alpha;
  s.adhesion_damping = c.velocity * by_gamma;
  return s;
}

StiffnessSensitivity stiffness_sensitivity(const ImpactSystem& system) {
  const double k1 = compliance(system.particle.youngs_modulus, system.particle.poisson_ratio);
  const double k2 = compliance(system.surface.youngs_modulus, system.surface.poisson_ratio);
  const double stiffness = hertzian_stiffness(k1, k2);
  // K ~ 1 / (k1 + k2), k = (1 - nu^2) / (pi E).
  const auto by_modulus = [&](double k, double modulus) {
    return stiffness * k / (k1 + k2) / modulus;
  };
  const auto by_ratio = [&](double k, double nu) {
    return stiffness * k / (k1 + k2) * 2.0 * nu / (1.0 - nu * nu);
  };
  return {by_modulus(k1, system.particle.youngs_modulus),
          by_modulus(k2, system.surface.youngs_modulus),
          by_ratio(k1, system.particle.poisson_ratio), by_ratio(k2, system.surface.poisson_ratio)};
}

}  // namespace recoil
