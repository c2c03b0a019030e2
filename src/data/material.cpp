#include "data/material.hpp"

namespace recoil {

double ImpactSystem::error_of(Body body, Constant constant) const {
  for (const ConstantError& stated : errors) {
    if (stated.body == body && stated.constant == constant) return stated.sd;
  }
  return 0.0;
}

}  // namespace recoil
