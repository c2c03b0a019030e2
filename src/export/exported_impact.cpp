#include "export/exported_impact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/numerics.hpp"
#include "core/units.hpp"
#include "data/contact.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/predictor.hpp"
#include "impact/impact.hpp"

namespace recoil {
namespace {

ImpactGroups groups_under(const ContactForce& force, double velocity, ImpactScales& scales) {
  const ImpactConditions conditions = {.diameter = 2.0 * force.radius,
                                       .velocity = velocity,
                                       .density = force.density,
                                       .stiffness = force.stiffness,
                                       .adhesion_force = force.adhesion_force,
                                       .hertz_damping = force.hertz_damping,
                                       .adhesion_damping = force.adhesion_damping};
  scales = impact_scales(conditions);
  ImpactGroups groups = impact_groups(conditions);
  groups.kappa =
      force.dashpot * scales.length * std::sqrt(scales.length) / (force.mass() * velocity);
  return groups;
}

ImpactOptions options_under(const ContactForce& force) {
  ImpactOptions options;
  options.adhesion = force.adhesion;
  options.phase = force.phase;
  options.dashpot = force.dashpot > 0.0;
  options.never_pulls = force.never_pulls;
  return options;
}

void require_answer(const ImpactResult& impact, double diameter, double velocity) {
  if (impact.usable()) return;
  throw ComputationError(fmt::format("the impact at V = {:.6g} m/s, d = {:.6g} um: {}", velocity,
                                     diameter / units::um, to_string(impact.outcome)));
}

// In a fit "no adhesion" is a lower bound, not zero. Adhesion is omitted if V_a, or V*, is below
// this part of the slowest velocity, which changes e^2 by 1e-8.
constexpr double no_adhesion = 1e-6;

/// True if the e^2 of two e(V) agree to `same_square`.
bool same(std::span<const double> one, std::span<const double> other) {
  for (std::size_t k = 0; k < one.size(); ++k) {
    if (!(std::abs(one[k] * one[k] - other[k] * other[k]) <= same_square)) return false;
  }
  return true;
}

/// The force in the equation of motion with the changes by the chain, for a sphere with a velocity
/// in the middle of the range.
ContactForce force_at(const ImpactModel& model, std::span<const double> theta,
                      const ExportRequest& request) {
  const double middle = std::sqrt(request.slowest * request.fastest);
  const ImpactConditions c = conditions_at(model, theta, request.dataset, request.diameter, middle);
  const AdhesionLaw law = traits(model.adhesion).exportable ? model.adhesion : AdhesionLaw::ring;
  ContactForce force = {law,       model.phase,     0.5 * c.diameter,
                        c.density, c.stiffness,     c.adhesion_force,
                        0.0,       c.hertz_damping, c.adhesion_damping};
  if (!model.chain.empty()) {
    const ContactView view =
        contact_view(model, theta, {request.dataset, request.diameter, middle});
    const Encounter<double>& e = view.encounter;
    force.never_pulls = view.never_pulls;
    force.adhesion_force = e.adhesion_force;
    force.hertz_damping = e.hertz_damping;
    force.adhesion_damping = e.adhesion_damping;
    force.dashpot = 1.5 * e.relaxation * c.stiffness * std::sqrt(force.radius);
  }
  ImpactConditions touched = c;
  touched.adhesion_force = force.adhesion_force;
  if (!(adhesion_velocity(touched) > no_adhesion * request.slowest)) {
    force.adhesion = AdhesionLaw::ring;  // Hertz's contact, which every law becomes
    force.adhesion_force = 0.0;
  }
  force.adhesion_energy = adhesion_energy_for(force.adhesion_force, force.radius, force.stiffness);
  return force;
}

}  // namespace

double ContactForce::mass() const { return sphere_mass(2.0 * radius, density); }

double ContactForce::jkr_length() const {
  const double parting =
      std::cbrt(std::numbers::pi * adhesion_energy * radius * radius / (6.0 * stiffness));
  return parting * parting / radius;
}

std::vector<double> squares_under(const ContactForce& force, std::span<const double> velocity) {
  std::vector<ImpactGroups> groups;
  ImpactScales scales;
  for (const double v : velocity) groups.push_back(groups_under(force, v, scales));
  std::vector<ImpactResult> results(groups.size());
  simulate_impacts_fast(groups, options_under(force), results);
  std::vector<double> squares;
  for (std::size_t k = 0; k < results.size(); ++k) {
    require_answer(results[k], 2.0 * force.radius, velocity[k]);
    squares.push_back(results[k].restitution_squared);
  }
  return squares;
}

std::vector<double> restitution_under(const ContactForce& force, std::span<const double> velocity) {
  std::vector<double> e = squares_under(force, velocity);
  for (double& square : e) square = std::sqrt(std::max(square, 0.0));
  return e;
}

double capture_velocity_of(const std::function<double(double)>& square, double fastest) {
  double above = fastest;
  for (double v = 0.8 * fastest; v > no_adhesion * fastest; v *= 0.8) {
    if (square(v) <= 0.0) return find_root(square, v, above, 1e-10);
    above = v;
  }
  return 0.0;
}

double contact_time_under(const ContactForce& force, double velocity) {
  ImpactScales scales;
  const ImpactGroups groups = groups_under(force, velocity, scales);
  ImpactOptions options = options_under(force);
  options.budget = true;
  const ImpactResult impact = simulate_impact(groups, options);
  require_answer(impact, 2.0 * force.radius, velocity);
  return impact.contact_time * scales.time;
}

std::vector<double> of_nature(const ImpactModel& model, std::vector<double> theta) {
  for (std::size_t s = 0; s < theta.size(); ++s) {
    const Mechanism* mechanism = model.slots[s].mechanism();
    if (mechanism != nullptr && mechanism->info.kind == MechanismKind::measurement) {
      theta[s] = model.slots[s].parameter->null_value;
    }
  }
  return theta;
}

std::vector<double> squares_of_nature(const ImpactModel& model, std::span<const double> theta,
                                      std::size_t dataset, double diameter,
                                      std::span<const double> velocity) {
  std::vector<PointConditions> points;
  for (const double v : velocity) points.push_back({dataset, diameter, v});
  PointPredictor predictor(model, std::move(points), Effects::of_nature);
  predictor.evaluate(theta, false);
  std::vector<double> squares;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    require_answer(predictor.at(k), diameter, velocity[k]);
    squares.push_back(predictor.at(k).restitution_squared);
  }
  return squares;
}

ExportedImpact exported_impact(const ImpactModel& model, std::span<const double> theta,
                               const ExportRequest& request) {
  ExportedImpact out;
  out.request = request;
  for (const Mechanism* mechanism : model.chain) {
    const bool measured = mechanism->info.kind == MechanismKind::measurement;
    (measured ? out.of_measurement : out.of_nature).push_back(mechanism);
  }
  const std::vector<double> values = of_nature(model, {theta.begin(), theta.end()});
  out.velocity = log_spaced(request.slowest, request.fastest, error_velocities);
  const std::vector<double> squares =
      squares_of_nature(model, values, request.dataset, request.diameter, out.velocity);
  for (const double square : squares) out.restitution.push_back(std::sqrt(std::max(square, 0.0)));
  const CaptureVelocity capture =
      capture_velocity(model, values, request.dataset, request.diameter);
  out.captures = capture.found && capture.value > no_adhesion * request.slowest &&
                 !without_adhesion(model, request.dataset);
  out.capture_velocity = out.captures ? capture.value : 0.0;
  out.force = force_at(model, values, request);
  out.surface_diameter = model.contacts[request.dataset].surface_diameter;
  const std::vector<double> alone = restitution_under(out.force, out.velocity);
  out.force_is_all = traits(model.adhesion).exportable && same(alone, out.restitution);
  out.shortest_contact = contact_time_under(out.force, request.fastest);
  out.longest_contact = 0.0;
  for (std::size_t k = 0; k < out.velocity.size(); k += 20) {
    out.longest_contact =
        std::max(out.longest_contact, contact_time_under(out.force, out.velocity[k]));
  }
  return out;
}

}  // namespace recoil
