#include "export/export_job.hpp"

#include <cmath>

namespace recoil {

double rounded(double value, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - digits + 1);
  return unit < 1.0 ? std::round(value / unit) / std::round(1.0 / unit)
                    : std::round(value / unit) * unit;
}

double time_step(const ExportedImpact& impact) {
  return rounded(impact.shortest_contact / steps_per_contact, 2);
}

double longest_run(const ExportedImpact& impact) {
  constexpr double patience = 2.5;
  return rounded(patience * impact.longest_contact, 2);
}

double typical_velocity(const ExportedImpact& impact) {
  return rounded(std::sqrt(impact.request.slowest * impact.request.fastest), 2);
}

}  // namespace recoil
