#include "estimate/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace recoil {
namespace {

/// The diameter at which f0 is stated: the dataset's own, else the middle one of its points.
double reference_diameter_of(const Dataset& dataset) {
  if (dataset.system.reference_diameter) return *dataset.system.reference_diameter;
  const std::vector<double> diameters = distinct_diameters(dataset);
  return diameters[diameters.size() / 2];
}

std::size_t add_slot(ImpactModel& model, const ParameterEntry& entry, const ParameterSpec& spec,
                     const std::string& dataset, double initial) {
  model.slots.push_back({spec.name, entry.unit, dataset, initial, spec.lower, spec.upper, spec.free,
                         entry.log_scale && spec.lower > 0.0, entry.mechanism});
  return model.slots.size() - 1;
}

/// The slots of one parameter of a mechanism, per dataset: one, or one per series.
std::vector<std::vector<std::size_t>> add_own_slots(ImpactModel& model, const ParameterEntry& entry,
                                                    const ParameterSpec& spec,
                                                    const MechanismParameter& parameter,
                                                    const std::vector<Dataset>& datasets) {
  std::vector<std::vector<std::size_t>> all;
  const auto add = [&](const std::string& dataset, const std::string& series) {
    const std::size_t slot = add_slot(model, entry, spec, dataset, spec.initial);
    model.slots[slot].series = series;
    model.slots[slot].null_value = parameter.null_value;
    model.slots[slot].starts = parameter.starts;
    return slot;
  };
  const bool several = datasets.size() > 1;
  for (const Dataset& dataset : datasets) {
    std::vector<std::size_t>& slots = all.emplace_back();
    if (parameter.per_series) {
      for (const std::string& series : dataset.series) {
        slots.push_back(add(several ? dataset.id : "", series));
      }
    } else if (all.size() == 1 || spec.per_dataset) {
      slots.push_back(add(several && spec.per_dataset ? dataset.id : "", ""));
    } else {
      slots = all.front();
    }
  }
  return all;
}

const MechanismParameter& parameter_of(const ParameterEntry& entry) {
  const Mechanism* const mechanism = find_mechanism(entry.mechanism);
  const auto& all = mechanism->info.parameters;
  return *std::find_if(all.begin(), all.end(),
                       [&](const MechanismParameter& p) { return p.name == entry.name; });
}

}  // namespace

std::string ParameterSlot::label() const {
  if (series.empty()) return dataset.empty() ? name : fmt::format("{}[{}]", name, dataset);
  return dataset.empty() ? fmt::format("{}[{}]", name, series)
                         : fmt::format("{}[{}/{}]", name, dataset, series);
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
    model.surroundings.push_back(surroundings_of(dataset.system, model.contacts.back()));
  }
  model.chain = chain_of(spec.mechanisms);
  const std::vector<ParameterEntry> entries = parameters_with(spec.mechanisms);
  assert(entries.size() == spec.parameters.size());
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const ParameterEntry& entry = entries[k];
    const ParameterSpec& parameter = spec.parameters[k];
    assert(entry.name == parameter.name);
    if (!entry.mechanism.empty()) {
      model.slot_own.push_back(
          add_own_slots(model, entry, parameter, parameter_of(entry), datasets));
      continue;
    }
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
      index.push_back(add_slot(model, entry, parameter, split ? datasets[d].id : "", initial));
    }
  }
  return model;
}

std::vector<double> without_mechanisms(const ImpactModel& model, std::vector<double> theta) {
  for (std::size_t j = 0; j < theta.size(); ++j) {
    if (!model.slots[j].mechanism.empty()) theta[j] = model.slots[j].null_value;
  }
  return theta;
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

std::vector<Prediction> predict(const ImpactModel& model, std::span<const double> theta,
                                std::vector<PointConditions> points, bool gradient) {
  PointPredictor predictor(model, std::move(points));
  predictor.evaluate(theta, gradient);
  std::vector<Prediction> predictions(predictor.size());
  for (std::size_t i = 0; i < predictor.size(); ++i) {
    predictions[i].outcome = predictor.at(i).outcome;
    predictions[i].restitution_squared = predictor.at(i).restitution_squared;
    if (!gradient) continue;
    predictions[i].gradient.resize(model.slots.size());
    predictor.gradient_row(i, 1.0, predictions[i].gradient);
  }
  return predictions;
}

Prediction predict(const ImpactModel& model, std::span<const double> theta, std::size_t dataset,
                   double diameter, double velocity, bool gradient) {
  return predict(model, theta, {{dataset, diameter, velocity}}, gradient).front();
}

}  // namespace recoil
