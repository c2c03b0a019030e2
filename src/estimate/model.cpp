#include "estimate/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "impact/fast_solver.hpp"
#include "impact/reference_solver.hpp"
#include "mechanism/catalogue.hpp"

namespace recoil {
namespace {

/// The diameter at which f0 is stated: the dataset's own, else the middle one of its points.
double reference_diameter_of(const Dataset& dataset) {
  if (dataset.system.reference_diameter) return *dataset.system.reference_diameter;
  const std::vector<double> diameters = distinct_diameters(dataset);
  return diameters[diameters.size() / 2];
}

std::size_t add_slot(ImpactModel& model, const ParameterSpec& spec, const std::string& dataset,
                     const std::string& series, double initial) {
  model.slots.push_back({spec.parameter, dataset, series, initial, spec.lower, spec.upper,
                         spec.free, spec.parameter->log_scale && spec.lower > 0.0});
  return model.slots.size() - 1;
}

/// The slots of one parameter of a mechanism, per dataset: one, or one per series.
std::vector<std::vector<std::size_t>> add_own_slots(ImpactModel& model, const ParameterSpec& spec,
                                                    const std::vector<Dataset>& datasets) {
  std::vector<std::vector<std::size_t>> all;
  const bool several = datasets.size() > 1;
  for (const Dataset& dataset : datasets) {
    std::vector<std::size_t>& slots = all.emplace_back();
    if (spec.parameter->per_series) {
      for (const std::string& series : dataset.series) {
        slots.push_back(add_slot(model, spec, several ? dataset.id : "", series, spec.initial));
      }
    } else if (all.size() == 1 || spec.per_dataset) {
      const std::string id = several && spec.per_dataset ? dataset.id : "";
      slots.push_back(add_slot(model, spec, id, "", spec.initial));
    } else {
      slots = all.front();
    }
  }
  return all;
}

/// The slot of a parameter of the base model for every dataset.
std::vector<std::size_t> add_base_slots(ImpactModel& model, const ParameterSpec& spec,
                                        const std::vector<Dataset>& datasets) {
  // f0 belongs to a pair of materials: where it is derived, every dataset has its own.
  const bool derived = spec.is_derived();
  const bool split = datasets.size() > 1 && (spec.per_dataset || (derived && !spec.free));
  std::vector<std::size_t> slots;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    if (d > 0 && !split) {
      slots.push_back(slots.front());
      continue;
    }
    const double initial = derived ? derived_adhesion(model, d) : spec.initial;
    slots.push_back(add_slot(model, spec, split ? datasets[d].id : "", "", initial));
  }
  return slots;
}

long simulate_by_reference(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                           std::span<ImpactResult> results) {
  for (std::size_t i = 0; i < groups.size(); ++i) results[i] = simulate_impact(groups[i], options);
  return 0;
}

}  // namespace

std::string ParameterSlot::label() const {
  const std::string_view name = parameter->name;
  if (series.empty()) {
    return dataset.empty() ? std::string(name) : fmt::format("{}[{}]", name, dataset);
  }
  return dataset.empty() ? fmt::format("{}[{}]", name, series)
                         : fmt::format("{}[{}/{}]", name, dataset, series);
}

std::vector<double> ImpactModel::initial() const {
  std::vector<double> theta;
  for (const ParameterSlot& slot : slots) theta.push_back(slot.initial);
  return theta;
}

int ImpactModel::free_count() const {
  return static_cast<int>(std::count_if(slots.begin(), slots.end(),
                                        [](const ParameterSlot& slot) { return slot.free; }));
}

ImpactOptions ImpactModel::impact_options(bool gradient) const {
  ImpactOptions options;
  options.adhesion = adhesion;
  options.phase = phase;
  options.gradient = gradient;
  options.tolerance *= solver.tolerance_factor;
  options.fast_tolerance *= solver.tolerance_factor;
  return options;
}

SimulateImpacts ImpactModel::simulator() const {
  return solver.kind == Solver::fast ? simulate_impacts_fast : simulate_by_reference;
}

ImpactModel make_model(const FitSpec& spec, const std::vector<Dataset>& datasets) {
  ImpactModel model;
  model.adhesion = spec.adhesion;
  model.separation = spec.separation;
  model.phase = spec.phase;
  for (const Dataset& dataset : datasets) {
    model.contacts.push_back(derive_contact(dataset.system, reference_diameter_of(dataset)));
    model.surroundings.push_back(surroundings_of(dataset.system, model.contacts.back()));
    model.surroundings.back().adhesion = spec.adhesion;
    model.surroundings.back().separation = spec.separation;
  }
  model.chain = chain_of(spec.mechanisms);
  for (const Parameter* parameter : parameters_with(spec.mechanisms, spec.adhesion)) {
    const ParameterSpec stated = spec.statement_of(*parameter);
    switch (parameter->role) {
      case ParameterRole::hertz_damping:
        model.slot_C_H = add_base_slots(model, stated, datasets);
        break;
      case ParameterRole::adhesion_damping:
        model.slot_C_A = add_base_slots(model, stated, datasets);
        break;
      case ParameterRole::adhesion_force:
      case ParameterRole::adhesion_energy:
        model.slot_adhesion = add_base_slots(model, stated, datasets);
        break;
      case ParameterRole::of_mechanism:
        model.slot_own.push_back(add_own_slots(model, stated, datasets));
        break;
    }
  }
  return model;
}

double derived_adhesion(const ImpactModel& model, std::size_t dataset) {
  const ContactProperties& contact = model.contacts[dataset];
  return model.adhesion == AdhesionLaw::ring ? contact.adhesion_force : contact.adhesion_energy;
}

double adhesion_force_under(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset) {
  const double value = theta[model.slot_adhesion[dataset]];
  if (model.adhesion == AdhesionLaw::ring) return value;
  const ContactProperties& contact = model.contacts[dataset];
  return adhesion_force_for(value, contact.reference_diameter / 2.0, contact.stiffness);
}

double adhesion_force_slope(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset) {
  if (model.adhesion == AdhesionLaw::ring) return 1.0;
  const double energy = theta[model.slot_adhesion[dataset]];
  return energy > 0.0 ? 2.0 / 3.0 * adhesion_force_under(model, theta, dataset) / energy : 0.0;
}

std::vector<double> without_mechanisms(const ImpactModel& model, std::vector<double> theta) {
  for (std::size_t j = 0; j < theta.size(); ++j) {
    const Parameter& parameter = *model.slots[j].parameter;
    if (parameter.mechanism != nullptr) theta[j] = parameter.null_value;
  }
  return theta;
}

ImpactConditions conditions_at(const ImpactModel& model, std::span<const double> theta,
                               std::size_t dataset, double diameter, double velocity) {
  assert(theta.size() == model.slots.size());
  const ContactProperties& contact = model.contacts[dataset];
  return {diameter,
          velocity,
          contact.particle_density,
          contact.stiffness,
          adhesion_force_at(adhesion_force_under(model, theta, dataset), contact.reference_diameter,
                            diameter),
          theta[model.slot_C_H[dataset]],
          theta[model.slot_C_A[dataset]],
          model.separation};
}

}  // namespace recoil
