#include "reconstruction/elastoplastic_truth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reconstruction/gsl_tools.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

/// The JKR contact of a sphere of radius R, all quantities by contact radius a [m].
struct JkrContact {
  double modulus;          ///< E* [Pa]
  double radius;           ///< R [m]
  double adhesion_energy;  ///< w [J/m2]

  double pull() const { return std::sqrt(8.0 * pi * adhesion_energy * modulus); }
  double neck() const { return 0.5 * std::sqrt(2.0 * pi * adhesion_energy / modulus); }

  double force(double a) const {
    return 4.0 * modulus * a * a * a / (3.0 * radius) - pull() * std::pow(a, 1.5);
  }

  /// Integral of force(a) d alpha from 0 to a [J], term by term.
  double work(double a) const {
    return 8.0 * modulus * std::pow(a, 5) / (15.0 * radius * radius) -
           (4.0 * modulus * neck() + 6.0 * pull()) / (3.0 * radius) * std::pow(a, 3.5) / 3.5 +
           0.5 * pull() * neck() * a * a;
  }

  /// Pressure in the centre [Pa]; rises with a.
  double central_pressure(double a) const {
    return 2.0 * modulus * a / (pi * radius) -
           std::sqrt(2.0 * adhesion_energy * modulus / (pi * a));
  }

  /// Contact radius where the surfaces first touch, alpha = 0.
  double touching() const {
    return std::cbrt(2.0 * pi * adhesion_energy * radius * radius / modulus);
  }

  /// Contact radius where the contact tears at fixed grips, d alpha / d a = 0.
  double tearing() const {
    return std::cbrt(pi * adhesion_energy * radius * radius / (8.0 * modulus));
  }
};

/// The virgin loading: JKR, then the line of constant contact pressure.
struct Loading {
  JkrContact elastic;
  double yield_pressure;
  double yield_radius;  ///< a_Y [m]
  double yield_force;   ///< P_Y [N]

  bool yielded(double a) const { return a > yield_radius; }

  double force(double a) const {
    if (!yielded(a)) return elastic.force(a);
    return yield_force + pi * yield_pressure * (a * a - yield_radius * yield_radius);
  }

  /// Antiderivative of the plastic line with respect to alpha, by a.
  double plastic_work(double a) const {
    const double offset = yield_force - pi * yield_pressure * yield_radius * yield_radius;
    const double R = elastic.radius;
    const double C = elastic.neck();
    return offset * (a * a / R - 2.0 * C * std::sqrt(a)) +
           pi * yield_pressure * (std::pow(a, 4) / (2.0 * R) - C * std::pow(a, 2.5) / 2.5);
  }

  /// Work from the first touch to a [J].
  double work(double a) const {
    const double start = elastic.touching();
    const double elastic_end = std::clamp(yield_radius, start, a);
    double total = elastic.work(elastic_end) - elastic.work(start);
    if (a > elastic_end) total += plastic_work(a) - plastic_work(elastic_end);
    return total;
  }
};

double yield_contact_radius(const JkrContact& elastic, double yield_pressure) {
  const auto excess = [&](double a) { return elastic.central_pressure(a) - yield_pressure; };
  const double without_adhesion = pi * elastic.radius * yield_pressure / (2.0 * elastic.modulus);
  if (elastic.adhesion_energy == 0.0) return without_adhesion;
  double upper = 2.0 * without_adhesion;
  while (excess(upper) < 0.0) upper *= 2.0;
  return find_root(excess, without_adhesion, upper, "the onset of yield");
}

}  // namespace

ElastoplasticImpact elastoplastic_impact(const ElastoplasticContact& contact, double velocity) {
  const JkrContact virgin{contact.reduced_modulus, contact.radius, contact.adhesion_energy};
  Loading loading{virgin, contact.yield_pressure, contact.yield_pressure, 0.0};
  if (std::isfinite(contact.yield_pressure)) {
    loading.yield_radius = yield_contact_radius(virgin, contact.yield_pressure);
    loading.yield_force = virgin.force(loading.yield_radius);
  }

  const double energy = 0.5 * contact.mass * velocity * velocity;
  const auto missing = [&](double a) { return loading.work(a) - energy; };
  const double start = virgin.touching();
  double upper = std::max(2.0 * start, 1e-3 * contact.radius);
  while (missing(upper) < 0.0) upper *= 2.0;
  const double deepest = find_root(missing, start, upper, "the turning point");

  JkrContact flattened = virgin;
  const bool yielded = loading.yielded(deepest);
  if (yielded) {
    const double cube = deepest * deepest * deepest;
    flattened.radius = 4.0 * virgin.modulus * cube /
                       (3.0 * (loading.force(deepest) + virgin.pull() * std::pow(deepest, 1.5)));
  }
  ElastoplasticImpact impact;
  impact.restitution_squared =
      (flattened.work(deepest) - flattened.work(flattened.tearing())) / energy;
  // The tear may lie beyond the deepest contact: then the contact can never be pulled apart here.
  impact.rebounded = impact.restitution_squared > 0.0 && deepest > flattened.tearing();
  impact.restitution = impact.rebounded ? std::sqrt(impact.restitution_squared) : 0.0;
  impact.contact_radius = deepest;
  impact.unloading_radius = flattened.radius;
  impact.yielded = yielded;
  return impact;
}

}  // namespace recoil
