#include "estimate/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "impact/fast_solver.hpp"

namespace recoil {
namespace {

/// The diameter at which f0 is stated: the dataset's own, else the middle one of its points.
double reference_diameter_of(const Dataset& dataset) {
  if (dataset.system.reference_diameter) return *dataset.system.reference_diameter;
  const std::vector<double> diameters = distinct_diameters(dataset);
  return diameters[diameters.size() / 2];
}

std::size_t add_slot(ImpactModel& model, const ParameterSpec& spec, const std::string& dataset,
                     double initial) {
  const auto& catalogue = parameter_catalogue();
  const auto entry = std::find_if(catalogue.begin(), catalogue.end(),
                                  [&](const ParameterEntry& e) { return e.name == spec.name; });
  assert(entry != catalogue.end());
  model.slots.push_back({spec.name, entry->unit, dataset, initial, spec.lower, spec.upper,
                         spec.free, entry->log_scale && spec.lower > 0.0});
  return model.slots.size() - 1;
}

/// The impact under `conditions` by the model's solver, with gradient when asked for.
ImpactResult solve_impact(const ImpactModel& model, const ImpactGroups& groups, bool gradient) {
  ImpactOptions options;
  options.phase = model.phase;
  options.gradient = gradient;
  return model.solver == Solver::fast ? simulate_impact_fast(groups, options)
                                      : simulate_impact(groups, options);
}

/// The gradient in the groups turned into one in theta.
std::vector<double> theta_gradient(const ImpactModel& model, std::span<const double> theta,
                                   std::size_t dataset, double velocity, const ImpactGroups& groups,
                                   const ImpactResult& impact) {
  std::vector<double> gradient(model.slots.size(), 0.0);
  gradient[model.slot_C_H[dataset]] += velocity * impact.gradient[0];
  gradient[model.slot_C_A[dataset]] += velocity * impact.gradient[2];
  const double f0 = theta[model.slot_f0[dataset]];
  if (f0 > 0.0) gradient[model.slot_f0[dataset]] += groups.beta / f0 * impact.gradient[1];
  return gradient;  // beta is proportional to f0
}

/// d e^2 / d V at fixed theta: alpha and gamma grow with V, beta falls like V^(-4/5).
double velocity_slope(const ImpactGroups& groups, const ImpactResult& impact, double velocity) {
  return (groups.alpha * impact.gradient[0] - 0.8 * groups.beta * impact.gradient[1] +
          groups.gamma * impact.gradient[2]) /
         velocity;
}

}  // namespace

std::string ParameterSlot::label() const {
  return dataset.empty() ? name : fmt::format("{}[{}]", name, dataset);
}

std::vector<double> ImpactModel::initial() const {
  std::vector<double> theta;
  for (const ParameterSlot& slot : slots) theta.push_back(slot.initial);
  return theta;
}

ImpactModel make_model(const FitSpec& spec, const std::vector<Dataset>& datasets) {
  ImpactModel model;
  model.phase = spec.phase;
  for (const Dataset& dataset : datasets) {
    model.contacts.push_back(derive_contact(dataset.system, reference_diameter_of(dataset)));
  }
  for (const ParameterSpec& parameter : spec.parameters) {
    std::vector<std::size_t>& index = parameter.name == "C_H"   ? model.slot_C_H
                                      : parameter.name == "C_A" ? model.slot_C_A
                                                                : model.slot_f0;
    // f0 belongs to a pair of materials: where it is derived, every dataset has its own.
    const bool derived = parameter.name == "f0" && !parameter.initial_stated;
    const bool split =
        datasets.size() > 1 && (parameter.per_dataset || (derived && !parameter.free));
    for (std::size_t d = 0; d < datasets.size(); ++d) {
      if (d > 0 && !split) {
        index.push_back(index.front());
        continue;
      }
      const double initial = derived ? model.contacts[d].adhesion_force : parameter.initial;
      index.push_back(add_slot(model, parameter, split ? datasets[d].id : "", initial));
    }
  }
  return model;
}

double Prediction::restitution() const { return std::sqrt(std::max(restitution_squared, 0.0)); }

ImpactConditions conditions_at(const ImpactModel& model, std::span<const double> theta,
                               std::size_t dataset, double diameter, double velocity) {
  assert(theta.size() == model.slots.size());
  const ContactProperties& contact = model.contacts[dataset];
  return {diameter,
          velocity,
          contact.particle_density,
          contact.stiffness,
          adhesion_force_at(theta[model.slot_f0[dataset]], contact.reference_diameter, diameter),
          theta[model.slot_C_H[dataset]],
          theta[model.slot_C_A[dataset]]};
}

Prediction predict(const ImpactModel& model, std::span<const double> theta, std::size_t dataset,
                   double diameter, double velocity, bool gradient) {
  const ImpactGroups groups =
      impact_groups(conditions_at(model, theta, dataset, diameter, velocity));
  const ImpactResult impact = solve_impact(model, groups, gradient);
  Prediction prediction{impact.outcome, impact.restitution_squared, {}};
  if (gradient) {
    prediction.gradient = theta_gradient(model, theta, dataset, velocity, groups, impact);
  }
  return prediction;
}

CaptureVelocity capture_velocity(const ImpactModel& model, std::span<const double> theta,
                                 std::size_t dataset, double diameter, double guess) {
  CaptureVelocity result;
  result.gradient.assign(model.slots.size(), 0.0);
  const ImpactConditions c = conditions_at(model, theta, dataset, diameter, 1.0);
  const double scale = adhesion_velocity(c);
  if (!(scale > 0.0) || (c.hertz_damping == 0.0 && c.adhesion_damping == 0.0)) {
    result.found = true;  // conservative: everything comes back
    return result;
  }
  // Small damping: V*^2 = 2 J (C_A + 2 C_H) V_a^3 with J = 0.827350 (rebound), twice C_A (both).
  const double damping =
      (model.phase == AdhesionDampingPhase::both ? 2.0 : 1.0) * c.adhesion_damping +
      2.0 * c.hertz_damping;
  constexpr double J = 0.827350;
  double square = guess > 0.0 ? guess * guess : 2.0 * J * damping * scale * scale * scale;
  double captured = 0.0;                  // largest V^2 seen that is captured
  double rebounds = 1e6 * scale * scale;  // smallest V^2 seen that rebounds
  bool rebound_seen = false;
  constexpr int most_iterations = 60;
  for (int i = 0; i < most_iterations; ++i) {
    const double velocity = std::sqrt(square);
    const ImpactGroups groups =
        impact_groups(conditions_at(model, theta, dataset, diameter, velocity));
    const ImpactResult impact = solve_impact(model, groups, true);
    if (!impact.usable()) return result;
    // Newton on e^2 V^2 as a function of V^2: nearly a straight line of slope 1 for weak damping,
    // as the energy that is lost hardly depends on V near capture.
    const double per_velocity = velocity_slope(groups, impact, velocity);
    const double excess = impact.restitution_squared * square;
    const double slope = impact.restitution_squared + 0.5 * velocity * per_velocity;
    (excess > 0.0 ? rebounds : captured) = square;
    rebound_seen = rebound_seen || excess > 0.0;
    double next = square - excess / slope;
    if (!(slope > 0.0) || !(next > captured) || !(next < rebounds)) {
      next =
          rebound_seen ? std::sqrt(std::max(captured, 1e-4 * rebounds) * rebounds) : 4.0 * square;
      if (!rebound_seen && next > 1e6 * scale * scale) return result;  // nothing rebounds
    }
    if (std::abs(next - square) <= 2e-9 * square) {
      result.found = true;
      result.value = std::sqrt(next);
      // Differentiate e^2(V*, theta) = 0.
      result.gradient = theta_gradient(model, theta, dataset, velocity, groups, impact);
      for (double& entry : result.gradient) entry /= -per_velocity;
      break;
    }
    square = next;
  }
  return result;
}

}  // namespace recoil
