#include "estimate/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/error.hpp"
#include "impact/impact.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

// Limits of an isotropic solid: unstable at -1, incompressible at 1/2.
constexpr double least_poisson_ratio = -0.99;
constexpr double largest_poisson_ratio = 0.5;

/// The diameter at which f0 is stated: the one that the dataset states, else the median of its
/// diameters.
double reference_diameter_of(const Dataset& dataset) {
  if (dataset.system.reference_diameter) return *dataset.system.reference_diameter;
  const std::vector<double> diameters = distinct_diameters(dataset);
  return diameters[diameters.size() / 2];
}

std::size_t add_slot(ImpactModel& model, const ParameterSpec& spec, const std::string& dataset,
                     const std::string& series, double initial) {
  // A fixed value may lie below the bounds of a fitted one: f0 = 0 without adhesion.
  const double lower = spec.free ? spec.lower : std::min(spec.lower, initial);
  model.slots.push_back({spec.parameter, dataset, series, initial, lower, spec.upper, spec.free,
                         spec.parameter->log_scale && lower > 0.0, spec.is_derived()});
  return model.slots.size() - 1;
}

/// A slot whose value a condition states.
std::size_t add_stated_slot(ImpactModel& model, const ParameterSpec& spec,
                            const std::string& dataset, const std::string& series,
                            const StatedValue& said) {
  const std::size_t slot = add_slot(model, spec, dataset, series, said.value);
  model.slots[slot].free = false;
  model.slots[slot].log_scale = false;
  model.slots[slot].stated = said.by;
  return slot;
}

/// The values of a parameter that the conditions of each series of a dataset state; the last entry
/// is for a sphere without series.
std::vector<std::optional<StatedValue>> said_by_conditions(const ImpactModel& model,
                                                           const ParameterSpec& spec,
                                                           const Dataset& dataset, std::size_t d) {
  std::vector<std::optional<StatedValue>> said(dataset.series.size() + 1);
  if (spec.mentioned) return said;
  for (std::size_t s = 0; s < said.size(); ++s) {
    said[s] = stated_value(*spec.parameter, model.surroundings[d], conditions_of(dataset, s));
  }
  return said;
}

/// The slots of one parameter of a mechanism, per dataset: one, or one per series.
std::vector<std::vector<std::size_t>> add_own_slots(ImpactModel& model, const ParameterSpec& spec,
                                                    const std::vector<Dataset>& datasets) {
  std::vector<std::vector<std::size_t>> all;
  const bool several = datasets.size() > 1;
  std::optional<std::size_t> common;  // shared by all datasets and series without a stated value
  const auto open_slot = [&](const Dataset& dataset) {
    if (spec.per_dataset) return add_slot(model, spec, several ? dataset.id : "", "", spec.initial);
    if (!common) common = add_slot(model, spec, "", "", spec.initial);
    return *common;
  };
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    const Dataset& dataset = datasets[d];
    std::vector<std::size_t>& slots = all.emplace_back();
    if (spec.parameter->per_series) {
      for (const std::string& series : dataset.series) {
        slots.push_back(add_slot(model, spec, several ? dataset.id : "", series, spec.initial));
      }
      continue;
    }
    const std::string id = several ? dataset.id : "";
    const auto said = said_by_conditions(model, spec, dataset, d);
    const bool alike = std::all_of(said.begin(), said.end() - 1,
                                   [&](const auto& value) { return value == said.front(); });
    if (alike) {
      slots.push_back(said.front() ? add_stated_slot(model, spec, id, "", *said.front())
                                   : open_slot(dataset));
      continue;
    }
    std::optional<std::size_t> open;  // slot of this dataset for series without a stated value
    for (std::size_t s = 0; s < said.size(); ++s) {
      const bool of_series = s < dataset.series.size();
      if (said[s]) {
        slots.push_back(
            add_stated_slot(model, spec, id, of_series ? dataset.series[s] : "any", *said[s]));
      } else {
        if (!open) open = open_slot(dataset);
        slots.push_back(*open);
      }
    }
  }
  return all;
}

/// Upper limit of C_H V. At C_H V = 30 a sphere keeps e = 0.03, by 1 + C_H V = (1 - C_H V e)
/// exp(C_H V (1 + e)) (Hunt & Crossley 1975, J. Appl. Mech. 42, 440-445). Slow spheres with a low e
/// need a C_H far above the bound of the catalogue.
constexpr double most_damping = 30.0;

ParameterSpec with_room_for_damping(ParameterSpec spec, const std::vector<Dataset>& datasets) {
  if (spec.bounds_stated) return spec;
  double fastest = 0.0;
  for (const Dataset& dataset : datasets) {
    for (const ImpactPoint& point : dataset.points) {
      fastest = std::max(fastest, point.incident_velocity);
    }
  }
  if (fastest > 0.0) spec.upper = std::max(spec.upper, most_damping / fastest);
  return spec;
}

/// The slot of a parameter of the base model for every dataset.
std::vector<std::size_t> add_base_slots(ImpactModel& model, const ParameterSpec& spec,
                                        const std::vector<Dataset>& datasets) {
  // f0 depends on the pair of materials: if it is derived, every dataset has its own slot.
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

/// Fixes C_A at 0 if no dataset of its slot has adhesion: it then damps nothing.
void fix_damping_of_nothing(ImpactModel& model) {
  for (const std::size_t damping : model.slot_C_A) {
    bool adheres = false;
    for (std::size_t d = 0; d < model.slot_C_A.size(); ++d) {
      const ParameterSlot& adhesion = model.slots[model.slot_adhesion[d]];
      adheres =
          adheres || (model.slot_C_A[d] == damping && (adhesion.free || adhesion.initial > 0.0));
    }
    if (adheres) continue;
    model.slots[damping].free = false;
    model.slots[damping].initial = 0.0;
  }
}

/// Range of a constant to either side, in standard deviations.
constexpr double widest = 8.0;

void add_constant(ImpactModel& model, const UncertainConstant& constant,
                  const std::vector<Dataset>& datasets) {
  const double reach = widest * constant.sd;
  const bool positive = is_positive(constant.constant);
  std::string where;
  if (constant.datasets.size() < datasets.size()) {
    for (const std::size_t d : constant.datasets) {
      where += (where.empty() ? "" : ", ") + datasets[d].id;
    }
  }
  ParameterSlot slot;
  slot.parameter = &parameter_of(constant.body, constant.constant);
  slot.dataset = where;
  slot.initial = constant.stated;
  slot.lower = positive ? constant.stated * std::exp(-reach)
                        : std::max(constant.stated - reach, least_poisson_ratio);
  slot.upper = positive ? constant.stated * std::exp(reach)
                        : std::min(constant.stated + reach, largest_poisson_ratio);
  slot.free = false;
  slot.log_scale = positive;
  model.slots.push_back(std::move(slot));
  model.constants.push_back(constant);
}

/// Adds the constants on which the model depends.
void add_constants(ImpactModel& model, const std::vector<Dataset>& datasets) {
  const std::vector<UncertainConstant> all = uncertain_constants(datasets);
  std::vector<double> stated;
  for (const UncertainConstant& constant : all) stated.push_back(constant.stated);
  std::vector<bool> acts(all.size(), false);
  const bool uses_energy =
      std::any_of(model.chain.begin(), model.chain.end(),
                  [](const Mechanism* mechanism) { return mechanism->info.needs_adhesion; });
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    const MaterialLaw law(datasets[d].system, model.contacts[d], all, d);
    const ParameterSlot& adhesion = model.slots[model.slot_adhesion[d]];
    const bool follows = adhesion.derived && !adhesion.free && adhesion.initial > 0.0;
    for (const MaterialSlope& slope : law.slopes(stated)) {
      const double by_force = !follows                          ? 0.0
                              : traits(model.adhesion).by_force ? slope.adhesion_force
                                                                : slope.adhesion_energy;
      const bool in_chain = (uses_energy && slope.adhesion_energy != 0.0) ||
                            (!model.chain.empty() && slope.wave_mobility != 0.0);
      if (slope.density != 0.0 || slope.stiffness != 0.0 || by_force != 0.0 || in_chain) {
        acts[slope.index] = true;
      }
    }
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (acts[k]) add_constant(model, all[k], datasets);
  }
}

/// Are the materials of the dataset exact? (A model that was built without `make_model` has no
/// constants.)
bool is_exact(const ImpactModel& model, std::size_t dataset) {
  return model.material_count() == 0 || model.materials[dataset].exact();
}

/// Does `dataset` state its adhesion without an error? Then it does not depend on any uncertain
/// constant.
bool states_exact_adhesion(const ImpactModel& model, std::size_t dataset) {
  const ContactProperties& contact = model.contacts[dataset];
  const bool ring = traits(model.adhesion).by_force;
  const bool stated = ring ? contact.adhesion_force != contact.adhesion_force_derived
                           : contact.adhesion_energy != contact.adhesion_energy_derived;
  const Constant own = ring ? Constant::adhesion_force_f0 : Constant::adhesion_energy;
  return stated && std::none_of(model.constants.begin(), model.constants.end(),
                                [&](const UncertainConstant& constant) {
                                  const auto& its = constant.datasets;
                                  return constant.constant == own &&
                                         std::find(its.begin(), its.end(), dataset) != its.end();
                                });
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

std::optional<std::size_t> own_slot(const ImpactModel& model, std::size_t k,
                                    const Parameter& parameter, const PointConditions& at) {
  const std::vector<std::size_t>& slots = model.slot_own[k][at.dataset];
  if (parameter.per_series) {
    return at.series < slots.size() ? std::optional(slots[at.series]) : std::nullopt;
  }
  return slots[std::min(at.series, slots.size() - 1)];
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
    model.surroundings.back().phase = spec.phase;
    model.surroundings.back().separation = spec.separation;
    for (std::size_t s = 0; s < dataset.series.size(); ++s) {
      model.surroundings.back().of_series.push_back(conditions_of(dataset, s));
    }
    if (spec.mixed_sizes && dataset.mixed_sizes) {
      model.surroundings.back().sizes = mixed_sizes_of(*dataset.mixed_sizes);
    }
  }
  model.chain = chain_of(spec.mechanisms);
  for (const Mechanism* mechanism : model.chain) {
    for (std::size_t d = 0; d < datasets.size(); ++d) {
      if (!mechanism->info.needs_flat || !datasets[d].system.surface_diameter) continue;
      throw InputError(
          {spec.file.string()},
          fmt::format("{} beside two spheres ({})", mechanism->info.id, datasets[d].id),
          "its law holds for a flat surface", "leave it out of 'mechanisms'");
    }
  }
  for (const Parameter* parameter : parameters_with(spec.mechanisms, spec.adhesion)) {
    const ParameterSpec stated = spec.statement_of(*parameter);
    switch (parameter->role) {
      case ParameterRole::hertz_damping:
        model.slot_C_H = add_base_slots(model, with_room_for_damping(stated, datasets), datasets);
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
      case ParameterRole::material_constant:
      case ParameterRole::law_error:
        break;  // not a parameter of a fit file
    }
  }
  fix_damping_of_nothing(model);
  if (spec.uncertainty.materials != Materials::exact) add_constants(model, datasets);
  if (spec.uncertainty.materials == Materials::adjusted ||
      spec.uncertainty.materials == Materials::averaged) {
    model = with_adjusted_materials(std::move(model));
  }
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    model.materials.emplace_back(datasets[d].system, model.contacts[d], model.constants, d);
  }
  return model;
}

double derived_adhesion(const ImpactModel& model, std::size_t dataset) {
  const ContactProperties& contact = model.contacts[dataset];
  return traits(model.adhesion).by_force ? contact.adhesion_force : contact.adhesion_energy;
}

double adhesion_force_under(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset) {
  const std::size_t slot = model.slot_adhesion[dataset];
  const double value = theta[slot];
  const bool ring = traits(model.adhesion).by_force;
  const ContactProperties& contact = model.contacts[dataset];
  if (!is_exact(model, dataset)) {
    const MaterialState now = materials_under(model, theta, dataset);
    const bool follows = follows_materials(model, dataset);
    if (ring) return follows ? value * now.adhesion_force / contact.adhesion_force : value;
    return adhesion_force_for(
        follows ? value * now.adhesion_energy / contact.adhesion_energy : value,
        contact.relative_radius(contact.reference_diameter), now.stiffness);
  }
  if (ring) return value;
  return adhesion_force_for(value, contact.relative_radius(contact.reference_diameter),
                            contact.stiffness);
}

bool without_adhesion(const ImpactModel& model, std::size_t dataset) {
  if (dataset >= model.contacts.size()) return false;
  for (const Mechanism* mechanism : model.chain) {
    if (mechanism->info.dry_loss.empty()) return false;
  }
  return model.contacts[dataset].adhesion_force == 0.0 &&
         !model.slots[model.slot_adhesion[dataset]].free;
}

bool averages_over_sizes(const ImpactModel& model, std::size_t dataset) {
  return dataset < model.surroundings.size() && model.surroundings[dataset].sizes.mixed();
}

bool averages_over_sizes(const ImpactModel& model) {
  return std::any_of(model.surroundings.begin(), model.surroundings.end(),
                     [](const Surroundings& at) { return at.sizes.mixed(); });
}

bool follows_materials(const ImpactModel& model, std::size_t dataset) {
  const ParameterSlot& slot = model.slots[model.slot_adhesion[dataset]];
  return !is_exact(model, dataset) && slot.derived && !slot.free && slot.initial > 0.0 &&
         !states_exact_adhesion(model, dataset);
}

double adhesion_value_under(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset) {
  const double value = theta[model.slot_adhesion[dataset]];
  if (!follows_materials(model, dataset)) return value;
  if (traits(model.adhesion).by_force) return adhesion_force_under(model, theta, dataset);
  return value * materials_under(model, theta, dataset).adhesion_energy /
         model.contacts[dataset].adhesion_energy;
}

std::optional<std::size_t> followed_in(const ImpactModel& model, std::size_t slot) {
  for (std::size_t d = 0; d < model.contacts.size(); ++d) {
    if (model.slot_adhesion[d] == slot && follows_materials(model, d)) return d;
  }
  return std::nullopt;
}

double acting_value(const ImpactModel& model, std::span<const double> theta, std::size_t slot) {
  const std::optional<std::size_t> dataset = followed_in(model, slot);
  return dataset ? adhesion_value_under(model, theta, *dataset) : theta[slot];
}

ImpactModel with_adjusted_materials(ImpactModel model) {
  for (std::size_t j = model.first_constant(); j < model.slots.size(); ++j) {
    model.slots[j].adjusted = true;
  }
  return model;
}

ImpactModel with_exact_materials(ImpactModel model) {
  model.slots.resize(model.first_constant());
  model.constants.clear();
  model.law_error.reset();
  return model;
}

ImpactModel with_law_error(ImpactModel model, const LawErrorPrior& prior,
                           std::span<const PointConditions> points) {
  static const Parameter coefficient = [] {
    Parameter parameter;
    parameter.name = "law_error";
    parameter.unit = "1";
    parameter.meaning = "coefficient of the error of the laws";
    parameter.role = ParameterRole::law_error;
    return parameter;
  }();
  model.law_error = std::make_shared<const LawError>(prior, points);
  for (std::size_t k = 0; k < model.law_error->count(); ++k) {
    UncertainConstant constant;
    constant.sd = 1.0;
    constant.of_laws = true;
    model.constants.push_back(std::move(constant));
    ParameterSlot slot;
    slot.parameter = &coefficient;
    slot.lower = -widest;
    slot.upper = widest;
    slot.free = false;
    slot.adjusted = true;
    model.slots.push_back(std::move(slot));
  }
  return model;
}

ImpactModel with_exact_laws(ImpactModel model) {
  model.slots.resize(model.first_law_slot());
  model.constants.resize(model.material_count());
  model.law_error.reset();
  return model;
}

MaterialState materials_under(const ImpactModel& model, std::span<const double> theta,
                              std::size_t dataset) {
  if (!is_exact(model, dataset)) return model.materials[dataset].at(model.constants_of(theta));
  const ContactProperties& contact = model.contacts[dataset];
  return {contact.particle_density, contact.stiffness, contact.adhesion_force,
          contact.adhesion_energy, model.surroundings[dataset].wave_mobility};
}

std::vector<MaterialSlope> material_slopes(const ImpactModel& model, std::span<const double> theta,
                                           std::size_t dataset) {
  if (is_exact(model, dataset)) return {};
  std::vector<MaterialSlope> slopes = model.materials[dataset].slopes(model.constants_of(theta));
  const bool follows = follows_materials(model, dataset);
  for (MaterialSlope& slope : slopes) {
    if (!traits(model.adhesion).by_force) {
      slope.adhesion_force =
          slope.stiffness / 3.0 + (follows ? 2.0 / 3.0 * slope.adhesion_energy : 0.0);
    } else if (!follows) {
      slope.adhesion_force = 0.0;
    }
  }
  return slopes;
}

Surroundings surroundings_under(const ImpactModel& model, std::span<const double> theta,
                                std::size_t dataset) {
  Surroundings at = model.surroundings[dataset];
  if (is_exact(model, dataset)) return at;
  const MaterialState now = materials_under(model, theta, dataset);
  at.density = now.density;
  at.stiffness = now.stiffness;
  at.reduced_modulus = 0.75 * now.stiffness;
  at.adhesion_energy = now.adhesion_energy;
  at.wave_mobility = now.wave_mobility;
  return at;
}

double adhesion_force_slope(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset) {
  if (traits(model.adhesion).by_force) {
    const double value = theta[model.slot_adhesion[dataset]];
    return is_exact(model, dataset) || value == 0.0
               ? 1.0
               : adhesion_force_under(model, theta, dataset) / value;
  }
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

std::vector<double> without_mechanism(const ImpactModel& model, std::vector<double> theta,
                                      const Mechanism& mechanism) {
  for (std::size_t j = 0; j < theta.size(); ++j) {
    const Parameter& parameter = *model.slots[j].parameter;
    if (parameter.mechanism == &mechanism) theta[j] = parameter.null_value;
  }
  return theta;
}

ImpactConditions conditions_at(const ImpactModel& model, std::span<const double> theta,
                               std::size_t dataset, double diameter, double velocity) {
  assert(theta.size() == model.slots.size());
  const ContactProperties& contact = model.contacts[dataset];
  const MaterialState now = materials_under(model, theta, dataset);
  const auto [equal, density] = contact.as_one_sphere(diameter, now.density);
  return {.diameter = equal,
          .velocity = velocity,
          .density = density,
          .stiffness = now.stiffness,
          .adhesion_force =
              contact.adhesion_force_at(adhesion_force_under(model, theta, dataset), diameter),
          .hertz_damping = theta[model.slot_C_H[dataset]],
          .adhesion_damping = theta[model.slot_C_A[dataset]],
          .separation = model.separation};
}

}  // namespace recoil
