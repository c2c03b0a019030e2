#include "validation/studies/independent_coverage.hpp"

#include <map>
#include <memory>
#include <set>
#include <string>

#include "core/error.hpp"
#include "validation/recipe/plan.hpp"
#include "validation/recipe/reconstruction.hpp"

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

CoverageTruth from_recipes(const FitSpec& spec, const std::vector<Dataset>& datasets,
                           std::vector<KnownRecipe> recipes, std::uint64_t seed) {
  CoverageTruth truth;
  truth.origin = TruthOrigin::recipe;
  const ImpactModel model = make_model(spec, datasets);
  truth.theta = model.initial();
  std::vector<Truth> truths;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    truth.theta[model.slot_C_H[d]] = recipes[d].parameters.at("C_H");
    truth.theta[model.slot_C_A[d]] = recipes[d].parameters.at("C_A");
    truth.theta[model.slot_adhesion[d]] = recipes[d].parameters.at("f0");
    truths.push_back(recipes[d].recipe.truth);
    for (const double diameter : distinct_diameters(datasets[d])) {
      truth.capture.push_back({diameter, true_capture_velocity(truths[d], diameter)});
    }
  }
  const auto shared = std::make_shared<const std::vector<KnownRecipe>>(std::move(recipes));
  truth.simulate = [datasets, shared, seed, model, theta = truth.theta](std::uint64_t index) {
    std::vector<Truth> drawn;
    if (!model.constants.empty()) {
      const auto with_constants = with_drawn_constants(model, theta, seed, index);
      for (std::size_t d = 0; d < datasets.size(); ++d) {
        drawn.push_back(truth_at(model, with_constants, d));
      }
    }
    std::vector<Dataset> made;
    for (std::size_t d = 0; d < datasets.size(); ++d) {
      Recipe recipe = (*shared)[d].recipe;
      if (!drawn.empty()) {
        recipe.truth = drawn[d];
        recipe.plan = make_plan(recipe);
      }
      made.push_back(regenerate(datasets[d], recipe, seed + 1 + index));
    }
    return made;
  };
  if (!model.constants.empty()) {
    truth.at = [datasets, model, seed, theta = truth.theta](std::uint64_t index) {
      const auto drawn = with_drawn_constants(model, theta, seed, index);
      return CoverageTruth::At{drawn, true_captures(independent_impacts(model), drawn, datasets)};
    };
  }
  return truth;
}

}  // namespace

Truth truth_at(const ImpactModel& model, std::span<const double> theta, std::size_t dataset) {
  const MaterialState materials = materials_under(model, theta, dataset);
  Truth truth;
  truth.density = materials.density;
  truth.stiffness = materials.stiffness;
  if (model.adhesion != AdhesionLaw::ring) {
    const ParameterSlot& energy = model.slots[model.slot_adhesion[dataset]];
    const bool follows = energy.derived && !energy.free && !model.constants.empty();
    truth.law = model.adhesion == AdhesionLaw::jkr ? TrueAdhesion::jkr : TrueAdhesion::dmt;
    truth.work = follows ? materials.adhesion_energy : theta[model.slot_adhesion[dataset]];
  } else {
    truth.adhesion_force = adhesion_force_under(model, theta, dataset);
    truth.reference_diameter = model.contacts[dataset].reference_diameter;
  }
  truth.C_H = theta[model.slot_C_H[dataset]];
  truth.C_A = theta[model.slot_C_A[dataset]];
  truth.damped_in_both_phases = model.phase == AdhesionDampingPhase::both;
  return truth;
}

TrueImpacts independent_impacts(const ImpactModel& model) {
  const std::set<AdhesionLaw> known = {AdhesionLaw::ring, AdhesionLaw::jkr, AdhesionLaw::dmt};
  if (known.count(model.adhesion) == 0 || !model.chain.empty()) {
    throw InputError({}, "the independent simulator does not know this model",
                     "it has the ring law, jkr and dmt, and no mechanisms",
                     "leave 'mechanisms' out, and take one of these laws");
  }
  TrueImpacts impacts;
  impacts.restitution = [model](TrueImpacts::Theta theta, const PointConditions& sphere) {
    return true_restitution(truth_at(model, theta, sphere.dataset), sphere.diameter,
                            sphere.velocity);
  };
  impacts.capture_velocity = [model](TrueImpacts::Theta theta, std::size_t dataset,
                                     double diameter) {
    return true_capture_velocity(truth_at(model, theta, dataset), diameter);
  };
  return impacts;
}

CoverageTruth independent_truth(const FitSpec& spec, const std::vector<Dataset>& datasets,
                                std::uint64_t seed) {
  // Recipes have the ring law's truth.
  std::vector<KnownRecipe> recipes;
  if (spec.adhesion == AdhesionLaw::ring && spec.mechanisms.empty()) {
    recipes = known_recipes(datasets);
  }
  if (!recipes.empty()) return from_recipes(spec, datasets, std::move(recipes), seed);
  return coverage_truth(spec, datasets, seed, independent_impacts);
}

}  // namespace recoil
