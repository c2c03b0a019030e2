#include "validation/studies/independent_coverage.hpp"

#include <set>

#include "core/error.hpp"
#include "validation/recipe/recipe.hpp"
#include "validation/recipe/reconstruction.hpp"

namespace recoil {
namespace {

/// The recipes of all datasets, or nothing when one has none or another model.
std::vector<Recipe> known_recipes(const std::vector<Dataset>& datasets) {
  std::vector<Recipe> recipes;
  for (const Dataset& dataset : datasets) {
    if (!std::filesystem::exists(dataset.folder / "recipe.toml")) return {};
    recipes.push_back(load_recipe(dataset.folder));
    // Mixed sizes are not the model of a fit, either.
    if (recipes.back().sizes || !has_model_of_fit(recipes.back())) return {};
  }
  return recipes;
}

CoverageTruth from_recipes(const FitSpec& spec, const std::vector<Dataset>& datasets,
                           const std::vector<Recipe>& recipes, std::uint64_t seed) {
  CoverageTruth truth;
  truth.origin = TruthOrigin::recipe;
  const ImpactModel model = make_model(spec, datasets);
  truth.theta = model.initial();
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    const Truth& known = recipes[d].truth;
    truth.theta[model.slot_C_H[d]] = known.C_H;
    truth.theta[model.slot_C_A[d]] = known.C_A;
    truth.theta[model.slot_adhesion[d]] = known.adhesion_force;
    for (const double diameter : distinct_diameters(datasets[d])) {
      truth.capture.push_back({diameter, true_capture_velocity(known, diameter)});
    }
  }
  truth.simulate = [datasets, recipes, seed, model, theta = truth.theta](std::uint64_t index) {
    std::vector<double> drawn;
    if (!model.constants.empty()) drawn = with_drawn_constants(model, theta, seed, index);
    std::vector<Dataset> made;
    for (std::size_t d = 0; d < datasets.size(); ++d) {
      Recipe recipe = recipes[d];
      if (!drawn.empty()) {
        recipe.truth = truth_at(model, drawn, d);
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
  if (spec.adhesion == AdhesionLaw::ring && spec.mechanisms.empty()) {
    const std::vector<Recipe> recipes = known_recipes(datasets);
    if (!recipes.empty()) return from_recipes(spec, datasets, recipes, seed);
  }
  return coverage_truth(spec, datasets, seed, independent_impacts);
}

}  // namespace recoil
