#include "validation/synthetic/other_laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hidden {
namespace {

using std::numbers::pi;

constexpr double first_coefficient = 1.5 * 1.15344;  // of b

/// (K sqrt(R) / m)^(2/5) V^(1/5) [1/s]: one over the time of a Hertz contact, but for a factor.
double contact_rate(const Sphere& s, double velocity) {
  return std::pow(s.stiffness * std::sqrt(s.radius) / s.mass, 0.4) * std::pow(velocity, 0.2);
}

}  // namespace

const std::vector<std::string_view>& effects_with_other_law() {
  static const std::vector<std::string_view> ids = {"plastic_yield", "bulk_viscoelastic",
                                                    "plate_flexure", "gas_film"};
  return ids;
}

bool is_law_of_dry_contact(std::string_view effect) {
  return effect == "plastic_yield" || effect == "bulk_viscoelastic" || effect == "plate_flexure";
}

double jackson_restitution(const Sphere& s, double yield_pressure, double velocity) {
  const double depth = s.radius * std::pow(2.0 * pi * yield_pressure / (3.0 * s.stiffness), 2);
  const double energy = 0.4 * s.stiffness * std::sqrt(s.radius) * std::pow(depth, 2.5);
  const double u = velocity / std::sqrt(2.0 * energy / s.mass);
  if (!(u > 1.0)) return 1.0;
  constexpr double middle = 60.0;
  if (u <= middle) return 1.0 - 0.1 * std::log(u) * std::pow((u - 1.0) / (middle - 1.0), 0.156);
  const double strain = yield_pressure / (1.6 * 0.75 * s.stiffness);
  const double e = 1.0 - 0.1 * std::log(middle) -
                   0.11 * std::log(u / middle) * std::pow(u - middle, 2.36 * strain);
  return std::max(e, 0.0);
}

double largest_by_other_law(std::string_view effect, const Sphere& s, double velocity) {
  const double rate = contact_rate(s, velocity);
  if (effect == "bulk_viscoelastic") return 0.3 / (first_coefficient * rate);
  if (effect == "plate_flexure") return 0.25 / (s.mass * rate);
  return INFINITY;
}

double ramirez_restitution(const Sphere& s, double relaxation, double velocity) {
  const double b = first_coefficient * relaxation * contact_rate(s, velocity);
  return 1.0 - b + 0.6 * b * b;
}

double boettcher_restitution(const Sphere& s, double plate_mobility, double velocity) {
  return std::exp(-1.719 * s.mass * plate_mobility * contact_rate(s, velocity));
}

double speed_lost_in_film(double mu, const Sphere& s, double gap, double path) {
  return 6.0 * pi * mu * s.radius * s.radius / s.mass * std::log(gap / path);
}

}  // namespace hidden
