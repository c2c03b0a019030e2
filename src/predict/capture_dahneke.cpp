#include "predict/capture_dahneke.hpp"

#include <algorithm>
#include <cmath>

namespace recoil {

double dahneke_capture_velocity(double mass, double restitution, double incident_energy,
                                double rebound_energy) {
  const double square = restitution * restitution;
  return std::sqrt(
      std::max(0.0, 2.0 / (mass * square) * (rebound_energy - square * incident_energy)));
}

}  // namespace recoil
