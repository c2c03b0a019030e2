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

PointPredictor::PointPredictor(const ImpactModel& model, std::vector<PointConditions> points)
    : model_(model),
      points_(std::move(points)),
      beta_per_f0_(points_.size()),
      groups_(points_.size()),
      results_(points_.size()) {
  std::vector<double> unit_adhesion = model.initial();
  for (const std::size_t slot : model.slot_f0) unit_adhesion[slot] = 1.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const PointConditions& p = points_[i];
    beta_per_f0_[i] =
        impact_groups(conditions_at(model, unit_adhesion, p.dataset, p.diameter, p.velocity)).beta;
  }
}

long PointPredictor::evaluate(std::span<const double> theta, bool gradient) {
  assert(theta.size() == model_.slots.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const PointConditions& p = points_[i];
    groups_[i] = {theta[model_.slot_C_H[p.dataset]] * p.velocity,
                  theta[model_.slot_f0[p.dataset]] * beta_per_f0_[i],
                  theta[model_.slot_C_A[p.dataset]] * p.velocity};
  }
  ImpactOptions options;
  options.phase = model_.phase;
  options.gradient = gradient;
  options.tolerance *= model_.loosened;
  options.fast_tolerance *= model_.loosened;
  if (model_.solver == Solver::fast) {
    return simulate_impacts_fast(groups_, options, results_);
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    results_[i] = simulate_impact(groups_[i], options);
  }
  return 0;
}

void PointPredictor::gradient_row(std::size_t i, double scale, std::span<double> row) const {
  const PointConditions& p = points_[i];
  const auto& by_group = results_[i].gradient;
  std::fill(row.begin(), row.end(), 0.0);
  row[model_.slot_C_H[p.dataset]] += scale * p.velocity * by_group[0];
  row[model_.slot_f0[p.dataset]] += scale * beta_per_f0_[i] * by_group[1];
  row[model_.slot_C_A[p.dataset]] += scale * p.velocity * by_group[2];
}

double PointPredictor::velocity_slope(std::size_t i) const {
  const ImpactGroups& g = groups_[i];
  const auto& by_group = results_[i].gradient;
  return (g.alpha * by_group[0] - 0.8 * g.beta * by_group[1] + g.gamma * by_group[2]) /
         points_[i].velocity;
}

double PointPredictor::diameter_slope(std::size_t i) const {
  // beta ~ f0 / D with f0 ~ D^(1/3) (eq. 12).
  return -2.0 / 3.0 * groups_[i].beta * results_[i].gradient[1] / points_[i].diameter;
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
