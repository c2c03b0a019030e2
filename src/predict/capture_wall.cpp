#include "predict/capture_wall.hpp"

#include <algorithm>
#include <cmath>

namespace recoil {

double wall_capture_velocity(double mass, double restitution, double energy_difference) {
  return std::sqrt(std::max(0.0, -2.0 * energy_difference / (mass * restitution * restitution)));
}

}  // namespace recoil
