#include "uncertainty/coverage_truth.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/random.hpp"
#include "reconstruction/reconstruction.hpp"

namespace recoil {
namespace {

struct KnownRecipe {
  Recipe recipe;
  std::map<std::string, double> parameters;
};

/// The recipes of all datasets, or nothing when one has none or another model.
std::vector<KnownRecipe> known_recipes(const std::vector<Dataset>& datasets) {
  std::vector<KnownRecipe> recipes;
  for (const Dataset& dataset : datasets) {
    if (!std::filesystem::exists(dataset.folder / "recipe.toml")) return {};
    Recipe recipe = load_recipe(dataset.folder);
    if (recipe.sizes) return {};  // mixed sizes: not the model of a fit
    std::map<std::string, double> parameters = true_parameters(recipe);
    if (parameters.empty()) return {};
    recipes.push_back({std::move(recipe), std::move(parameters)});
  }
  return recipes;
}

void add_capture_velocities(CoverageTruth& truth, const std::vector<Dataset>& datasets,
                            const std::vector<Truth>& truths) {
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const double diameter : distinct_diameters(datasets[d])) {
      truth.capture.push_back({diameter, true_capture_velocity(truths[d], diameter)});
    }
  }
}

CoverageTruth from_recipes(const FitSpec& spec, const std::vector<Dataset>& datasets,
                           std::vector<KnownRecipe> recipes, std::uint64_t seed) {
  CoverageTruth truth;
  truth.source = "truth and noise from the recipe, another seed for each";
  const ImpactModel model = make_model(spec, datasets);
  truth.theta = model.initial();
  std::vector<Truth> truths;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    truth.theta[model.slot_C_H[d]] = recipes[d].parameters.at("C_H");
    truth.theta[model.slot_C_A[d]] = recipes[d].parameters.at("C_A");
    truth.theta[model.slot_f0[d]] = recipes[d].parameters.at("f0");
    truths.push_back(recipes[d].recipe.truth);
  }
  add_capture_velocities(truth, datasets, truths);
  const auto shared = std::make_shared<const std::vector<KnownRecipe>>(std::move(recipes));
  truth.simulate = [datasets, shared, seed](std::uint64_t index) {
    std::vector<Dataset> made;
    for (std::size_t d = 0; d < datasets.size(); ++d) {
      made.push_back(regenerate(datasets[d], (*shared)[d].recipe, seed + 1 + index));
    }
    return made;
  };
  return truth;
}

Truth truth_at(const ImpactModel& model, std::span<const double> theta, std::size_t dataset) {
  const ContactProperties& contact = model.contacts[dataset];
  RingAdhesionTruth truth;
  truth.density = contact.particle_density;
  truth.stiffness = contact.stiffness;
  truth.adhesion_force = theta[model.slot_f0[dataset]];
  truth.reference_diameter = contact.reference_diameter;
  truth.C_H = theta[model.slot_C_H[dataset]];
  truth.C_A = theta[model.slot_C_A[dataset]];
  truth.damped_in_both_phases = model.phase == AdhesionDampingPhase::both;
  return truth;
}

CoverageTruth from_fit(const FitSpec& spec, const std::vector<Dataset>& datasets,
                       std::uint64_t seed) {
  const auto [fitted, truths] = truth_at_estimate(spec, datasets, gather(datasets, spec.noise));
  CoverageTruth truth;
  truth.source = "the fit's own estimate as truth, simulated independently of the fitter";
  truth.theta = fitted.theta;
  add_capture_velocities(truth, datasets, truths);
  std::vector<std::vector<double>> clean;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    clean.emplace_back();
    for (const ImpactPoint& point : datasets[d].points) {
      clean[d].push_back(true_restitution(truths[d], point.diameter, point.incident_velocity));
    }
  }
  // Without stated standard deviations the scatter is what the fit found for each point.
  std::vector<double> scatter;
  for (const Observation& point : fitted.data.points) scatter.push_back(point.sd);
  truth.simulate = [datasets, clean, seed, scatter](std::uint64_t index) {
    std::size_t row = 0;
    RandomStream random(seed, RandomPurpose::coverage, index);
    std::vector<Dataset> made = datasets;
    for (std::size_t d = 0; d < made.size(); ++d) {
      for (std::size_t i = 0; i < made[d].points.size(); ++i) {
        ImpactPoint& point = made[d].points[i];
        const double sd = scatter[row++];
        const double noise = random.normal();
        if (!point.all_captured()) point.restitution = std::max(0.0, clean[d][i] + sd * noise);
      }
    }
    return made;
  };
  return truth;
}

}  // namespace

CoverageTruth coverage_truth(const FitSpec& spec, const std::vector<Dataset>& datasets,
                             std::uint64_t seed) {
  std::vector<KnownRecipe> recipes = known_recipes(datasets);
  if (!recipes.empty()) return from_recipes(spec, datasets, std::move(recipes), seed);
  return from_fit(spec, datasets, seed);
}

EstimatedTruth truth_at_estimate(const FitSpec& spec, const std::vector<Dataset>& datasets,
                                 const Observations& data) {
  EstimatedTruth found;
  found.fitted = fit(make_model(spec, datasets), data);
  if (!found.fitted.usable) {
    throw ComputationError("no truth to simulate: " + found.fitted.failure);
  }
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    found.truths.push_back(truth_at(found.fitted.model, found.fitted.theta, d));
  }
  return found;
}

}  // namespace recoil
