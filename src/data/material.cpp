#include "data/material.hpp"

namespace recoil {

std::optional<double> ImpactSystem::value_of(Body body, Constant constant) const {
  const Material& material = body == Body::surface ? surface : particle;
  switch (constant) {
    case Constant::density:
      return material.density;
    case Constant::youngs_modulus:
      return material.youngs_modulus;
    case Constant::poisson_ratio:
      return material.poisson_ratio;
    case Constant::surface_energy:
      return material.surface_energy;
    case Constant::gilman_factor:
      return 1.0;
    case Constant::stiffness_K:
      return stiffness_K;
    case Constant::adhesion_energy:
      return adhesion_energy;
    case Constant::adhesion_force_f0:
      return adhesion_force_f0;
  }
  return std::nullopt;
}

double ImpactSystem::error_of(Body body, Constant constant) const {
  for (const ConstantError& stated : errors) {
    if (stated.body == body && stated.constant == constant) return stated.sd;
  }
  return 0.0;
}

}  // namespace recoil
