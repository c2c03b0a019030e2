#include "reconstruction/elastoplastic_truth.hpp"

#include <cmath>
#include <numbers>

namespace recoil {
namespace {

using std::numbers::pi;

/// W_s (E^2 / (w^5 R^4))^(1/3), the work that a JKR contact takes from alpha = 0 to its tear at
/// fixed grips (Johnson, Kendall & Roberts 1971; Thornton & Ning 1998 print 7.09).
constexpr double parting_work = 7.0922;

struct TurningPoint {
  double contact_radius;    ///< a* [m]
  double unloading_radius;  ///< R_p [m]
};

TurningPoint turning_point(const ElastoplasticContact& c, double energy) {
  const double yield_radius = pi * c.radius * c.yield_pressure / (2.0 * c.reduced_modulus);
  const double yield_energy =
      8.0 * c.reduced_modulus * std::pow(yield_radius, 5) / (15.0 * c.radius * c.radius);
  if (!(energy > yield_energy)) {
    const double a = std::pow(15.0 * c.radius * c.radius * energy / (8.0 * c.reduced_modulus), 0.2);
    return {a, c.radius};
  }
  // The plastic work is quadratic in u = a^2 - a_Y^2, as P_Y = (2/3) pi p_Y a_Y^2.
  const double yield_area = yield_radius * yield_radius;
  const double plastic = 2.0 * c.radius * (energy - yield_energy) / (pi * c.yield_pressure);
  const double offset = 2.0 / 3.0 * yield_area;
  const double u = plastic / (offset + std::sqrt(offset * offset + plastic));
  const double a = std::sqrt(yield_area + u);
  const double load = pi * c.yield_pressure * (offset + u);
  return {a, 4.0 * c.reduced_modulus * a * a * a / (3.0 * load)};
}

}  // namespace

ElastoplasticImpact elastoplastic_impact(const ElastoplasticContact& contact, double velocity) {
  const double E = contact.reduced_modulus;
  const double energy = 0.5 * contact.mass * velocity * velocity;
  const auto [a, flattened] = turning_point(contact, energy);

  const double stored = 8.0 * E * std::pow(a, 5) / (15.0 * flattened * flattened);
  const double parting = parting_work * std::cbrt(std::pow(contact.adhesion_energy, 5) *
                                                  std::pow(flattened, 4) / (E * E));
  const double peeling = contact.hysteresis * pi * a * a;

  ElastoplasticImpact impact;
  impact.restitution_squared = (stored - parting - peeling) / energy;
  impact.rebounded = impact.restitution_squared > 0.0;
  impact.restitution = impact.rebounded ? std::sqrt(impact.restitution_squared) : 0.0;
  impact.contact_radius = a;
  impact.unloading_radius = flattened;
  impact.plastic_share = 1.0 - stored / energy;
  return impact;
}

}  // namespace recoil
