#include "diagnosis/elsewhere.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/other_target.hpp"

namespace recoil {
namespace {

constexpr double least_expected = 0.3;  // nearer to capture a straight line is a poor guess
constexpr int velocities_of_size = 6;   // of each size
constexpr double least_range = 3.0;     // the fastest over the slowest of them
constexpr int looked_at = 24;           // velocities, to find the slowest

/// C_H and C_A of every dataset by themselves, and its adhesion.
FitSpec with_own_contacts(const FitSpec& spec) {
  FitSpec own = spec;
  own.parameters.clear();
  for (const Parameter* parameter : parameters_with(spec.mechanisms, spec.adhesion)) {
    ParameterSpec& stated = own.parameters.emplace_back(spec.statement_of(*parameter));
    if (parameter->is_damping() || parameter->is_adhesion()) stated.per_dataset = true;
  }
  return own;
}

/// The slots of theta under which a point of `dataset` is predicted, in one order for all models
/// with the same mechanisms.
std::vector<std::size_t> slots_of(const ImpactModel& model, std::size_t dataset) {
  std::vector<std::size_t> slots = {model.slot_C_H[dataset], model.slot_C_A[dataset],
                                    model.slot_adhesion[dataset]};
  for (const auto& own : model.slot_own) {
    slots.insert(slots.end(), own[dataset].begin(), own[dataset].end());
  }
  return slots;
}

/// The slot of the constant of `model` that is constant `k` of `other`, which has more datasets.
std::optional<std::size_t> same_constant(const ImpactModel& model, const ImpactModel& other,
                                         std::size_t k) {
  const UncertainConstant& wanted = other.constants[k];
  for (std::size_t j = 0; j < model.constants.size(); ++j) {
    const UncertainConstant& constant = model.constants[j];
    if (constant.body == wanted.body && constant.constant == wanted.constant &&
        constant.datasets.front() == wanted.datasets.front()) {
      return model.first_constant() + j;
    }
  }
  return std::nullopt;
}

void carry_over(const ImpactModel& from, const std::vector<double>& theta,
                const std::vector<bool>& moving, Elsewhere& to) {
  const ImpactModel& model = to.candidate.model;
  const auto take = [&](std::size_t slot, std::size_t old_slot) {
    to.theta[slot] = theta[old_slot];
    to.moving[slot] = old_slot < moving.size() && moving[old_slot];
  };
  for (std::size_t d = 0; d < to.dataset; ++d) {
    const std::vector<std::size_t> old_slots = slots_of(from, d);
    const std::vector<std::size_t> slots = slots_of(model, d);
    for (std::size_t k = 0; k < slots.size(); ++k) take(slots[k], old_slots[k]);
  }
  for (std::size_t k = 0; k < model.constants.size(); ++k) {
    const std::size_t slot = model.first_constant() + k;
    const auto old_slot = same_constant(from, model, k);
    to.moving[slot] = true;
    if (old_slot) take(slot, *old_slot);
  }
}

void guess(Elsewhere& there, std::size_t slot, double value, double sd) {
  there.theta[slot] = value;
  if (!(sd > 0.0)) return;
  there.moving[slot] = true;
  there.precisions(static_cast<Eigen::Index>(slot)) = 1.0 / (sd * sd);
}

void guess_the_contact(Elsewhere& there, std::size_t like) {
  const ImpactModel& model = there.candidate.model;
  const std::size_t target = there.dataset;
  for (const auto* slots : {&model.slot_C_H, &model.slot_C_A}) {
    const double value = there.theta[(*slots)[like]];
    const std::size_t slot = (*slots)[target];
    guess(there, slot, value, std::max(value, model.slots[slot].parameter->initial));
  }
  for (const auto& own : model.slot_own) {  // those of which the fit has one for each target
    const std::size_t slot = own[target].front();
    const ParameterSlot& its = model.slots[slot];
    if (its.stated || its.parameter->per_series || slot == own[like].front()) continue;
    const double value = there.theta[own[like].front()];
    guess(there, slot, value, std::abs(value));
  }
  const double derived = derived_adhesion(model, like);
  const double factor = derived > 0.0 ? derived_adhesion(model, target) / derived : 0.0;
  const double adhesion = factor * there.theta[model.slot_adhesion[like]];
  const bool ring = traits(model.adhesion).by_force;
  const double log_sd = (ring ? 1.0 : 1.5) * log_sd_of_other_adhesion;  // of f0, or of W
  const bool by_constants = follows_materials(model, target);
  guess(there, model.slot_adhesion[target], adhesion, by_constants ? 0.0 : log_sd * adhesion);
}

}  // namespace

Elsewhere carried_elsewhere(const FitSpec& spec, const std::vector<Dataset>& datasets,
                            const Dataset& target, std::size_t like, const Candidate& here,
                            const std::vector<double>& theta, const std::vector<bool>& moving) {
  Elsewhere there;
  there.dataset = datasets.size();
  std::vector<Dataset> all = datasets;
  all.push_back(target);
  there.candidate = make_candidate(with_own_contacts(spec), all, here.added, here.released);
  there.candidate.model.solver = here.model.solver;
  there.theta = there.candidate.model.initial();
  there.moving.assign(there.theta.size(), false);
  there.precisions = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(there.theta.size()));
  carry_over(here.model, theta, moving, there);
  guess_the_contact(there, like);
  return there;
}

std::size_t fullest(const std::vector<Dataset>& datasets) {
  const auto most = std::max_element(
      datasets.begin(), datasets.end(),
      [](const Dataset& a, const Dataset& b) { return a.points.size() < b.points.size(); });
  return static_cast<std::size_t>(most - datasets.begin());
}

std::vector<PointConditions> places_elsewhere(
    const Dataset& dataset, std::size_t place, double slowest, double fastest,
    const std::function<std::vector<double>(const std::vector<PointConditions>&)>& expected) {
  std::vector<PointConditions> places;
  const std::vector<double> all = distinct_diameters(dataset);
  std::vector<double> sizes = {all.front()};
  if (all.size() > 1) sizes.push_back(all.back());
  for (const double diameter : sizes) {
    const auto spaced = [&](double from, int count) {
      std::vector<PointConditions> at;
      for (int k = 0; k < count; ++k) {
        const double share = static_cast<double>(k) / (count - 1);
        at.push_back({place, diameter, from * std::pow(fastest / from, share)});
      }
      return at;
    };
    const std::vector<PointConditions> looked = spaced(slowest, looked_at);
    const std::vector<double> e = expected(looked);
    std::size_t first = 0;  // from here on all expect rebounds
    for (std::size_t i = 0; i < e.size(); ++i) {
      if (!(e[i] >= least_expected)) first = i + 1;
    }
    if (first == looked.size() || fastest < least_range * looked[first].velocity) continue;
    const std::vector<PointConditions> at = spaced(looked[first].velocity, velocities_of_size);
    places.insert(places.end(), at.begin(), at.end());
  }
  return places;
}

}  // namespace recoil
