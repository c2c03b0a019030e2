#include "predict/validity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.hpp"
#include "estimate/predictor.hpp"
#include "impact/impact.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

constexpr double largest_contact = 0.3;   // a / R
constexpr double largest_pressure = 0.3;  // p_0 / E*
constexpr double yield_share = 0.03;      // yield pressure over E if the strength is not stated
// Yield begins below the surface at p_0 = 1.6 Y (Johnson 1985, section 6.1); a contact flows at 2.8
// Y.
constexpr double first_yield = 1.6 / 2.8;
constexpr double least_tabor = 5.0;
constexpr double least_transits = 5.0;

/// Does a mechanism of the fit have a pressure at which the contact yields?
bool yields(const ImpactModel& model) {
  return std::any_of(model.slots.begin(), model.slots.end(), [](const ParameterSlot& slot) {
    return slot.mechanism() != nullptr && slot.parameter->unit == "Pa" &&
           slot.mechanism()->info.place == MechanismPlace::contact;
  });
}

/// The largest contact radius over R of an elastic sphere without damping [1]: from (2/5) K sqrt(r)
/// n^(5/2) - (4/3) pi sqrt(r) f0 n^(3/2) = m V^2 / 2, by Newton's method from above.
double undamped_contact(const ContactProperties& contact, double diameter, double velocity,
                        double f0) {
  const double r = contact.relative_radius(diameter);
  const double m = contact.reduced_mass(diameter, contact.particle_density);
  const double hertz =
      std::pow(1.25 * m * velocity * velocity / (contact.stiffness * std::sqrt(r)), 0.4);
  double n = hertz + 10.0 / 3.0 * pi * f0 / contact.stiffness;
  for (int step = 0; step < 20; ++step) {
    const double root = std::sqrt(r * n);
    const double energy = 0.4 * contact.stiffness * root * n * n - 4.0 / 3.0 * pi * f0 * root * n -
                          0.5 * m * velocity * velocity;
    n -= energy / (root * (contact.stiffness * n - 2.0 * pi * f0));
  }
  return std::sqrt(n / r);
}

struct LargestContact {
  double radius = 0.0;    ///< [m]
  double pressure = 0.0;  ///< at its centre [Pa]
};

/// The contact at the deepest penetration n [m] of an impact. If the contact yields: at the end of
/// the loading, with the pressure at which it flows. Else by the adhesion law: a^2 = R n; under jkr
/// a^2 / R = n + (8 pi W a / 3K)^(1/2), where adhesion lowers the pressure 2 E* a / (pi R) by (2 W
/// E* / (pi a))^(1/2) (Johnson 1985, section 5.5); under maugis a of the undamped impact.
LargestContact largest_contact_of(AdhesionLaw law, const ContactView& view, double n, double work) {
  const Encounter<double>& e = view.encounter;
  if (e.flow_pressure > 0.0) return {e.flow_radius, e.flow_pressure};
  const double radius = e.radius();
  double a = law == AdhesionLaw::maugis ? std::sqrt(e.contact_square()) : std::sqrt(radius * n);
  double lowered = 0.0;
  if (law == AdhesionLaw::jkr) {
    for (int step = 0; step < 100; ++step) {
      a = std::sqrt(radius * (n + std::sqrt(8.0 * pi * work * a / (3.0 * e.stiffness))));
    }
    lowered = std::sqrt(2.0 * work * e.reduced_modulus() / (pi * a));
  }
  return {a, 2.0 * e.reduced_modulus() * a / (pi * radius) - lowered};
}

/// The points of one dataset at which a quantity can be most extreme: the largest contact, the
/// fastest and the smallest sphere.
std::vector<PointConditions> extreme_points(const FitResult& fitted, std::size_t dataset) {
  const ImpactModel& model = fitted.model;
  const ContactProperties& contact = model.contacts[dataset];
  std::vector<PointConditions> points;
  for (const Observation& point : fitted.data.points) {
    if (point.dataset == dataset) points.push_back(point.conditions());
  }
  if (points.empty()) return points;
  const double f0 = adhesion_force_under(model, fitted.theta, dataset);
  const auto contact_of = [&](const PointConditions& p) {
    return undamped_contact(contact, p.diameter, p.velocity,
                            contact.adhesion_force_at(f0, p.diameter));
  };
  const auto worst = [&](const auto& more) {
    return *std::max_element(
        points.begin(), points.end(),
        [&](const PointConditions& a, const PointConditions& b) { return more(a) < more(b); });
  };
  return {worst(contact_of), worst([](const PointConditions& p) { return p.velocity; }),
          worst([](const PointConditions& p) { return -p.diameter; })};
}

}  // namespace

std::vector<Validity> impact_validity(const ImpactModel& model, const ImpactSystem& system,
                                      std::span<const double> theta, const PointConditions& point) {
  const ContactProperties& contact = model.contacts[point.dataset];
  const ContactView view = contact_view(model, theta, point);
  ImpactOptions options = model.impact_options(false);
  options.budget = true;
  options.dashpot = view.dashpot;
  options.never_pulls = view.never_pulls;
  const ImpactResult impact = simulate_impact(view.groups, options);
  if (!impact.usable()) return {};

  const double radius = view.encounter.radius();
  const double modulus = 0.75 * contact.stiffness;  // E*
  const double f0 = view.encounter.adhesion_force;
  // f0 belongs to the curvature of the contact on unloading.
  const double work = adhesion_energy_for(f0, view.encounter.contact_radius, contact.stiffness);
  const LargestContact largest =
      largest_contact_of(model.adhesion, view, impact.penetration_max * view.scales.length, work);
  const double contact_radius = largest.radius / radius;
  const double pressure = largest.pressure;
  std::vector<Validity> found;
  const auto add = [&](ValidityQuantity quantity, double value, double limit) -> Validity& {
    found.push_back({quantity, value, limit, point.dataset, point.diameter, point.velocity});
    return found.back();
  };
  add(ValidityQuantity::contact_radius, contact_radius, largest_contact);
  add(ValidityQuantity::pressure_modulus, pressure / modulus, largest_pressure);
  // Against an elastomer the pressure remains far below the yield pressure of another body.
  const bool elastomer = system.particle.is_elastomer() || system.surface.is_elastomer();
  if (!yields(model) && !elastomer) {
    const auto yield_of = [](const Material& body) {
      return first_yield * body.yield_pressure().value_or(yield_share * body.youngs_modulus);
    };
    const Material& first =
        yield_of(system.particle) < yield_of(system.surface) ? system.particle : system.surface;
    Validity& found_yield = add(ValidityQuantity::pressure_yield, pressure / yield_of(first), 1.0);
    found_yield.yield_pressure = yield_of(first);
    found_yield.yield_stated = first.yield_pressure().has_value();
  }
  const bool adheres = f0 > 0.0 && !without_adhesion(model, point.dataset);
  if (adheres && !traits(model.adhesion).has_range) {
    const double tabor =
        std::cbrt(radius * work * work / (modulus * modulus)) / equilibrium_separation;
    add(ValidityQuantity::tabor, tabor, least_tabor);
  }
  if (view.encounter.flow_pressure == 0.0) {
    const double wave = std::sqrt(system.particle.youngs_modulus / system.particle.density);
    add(ValidityQuantity::wave_transits,
        impact.contact_time * view.scales.time * wave / view.encounter.diameter, least_transits);
  }
  return found;
}

void keep_worst(const Validity& one, std::vector<Validity>& worst) {
  const auto known = std::find_if(worst.begin(), worst.end(), [&](const Validity& other) {
    return other.quantity == one.quantity;
  });
  if (known == worst.end()) {
    worst.push_back(one);
  } else if (one.limit_is_least() ? one.value < known->value : one.value > known->value) {
    *known = one;
  }
}

std::vector<Validity> fit_validity(const FitResult& fitted, const std::vector<Dataset>& datasets) {
  std::vector<Validity> all;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    std::vector<Validity> worst;
    for (const PointConditions& point : extreme_points(fitted, d)) {
      for (const Validity& one :
           impact_validity(fitted.model, datasets[d].system, fitted.theta, point)) {
        keep_worst(one, worst);
      }
    }
    all.insert(all.end(), worst.begin(), worst.end());
  }
  return all;
}

}  // namespace recoil
