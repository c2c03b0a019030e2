#include "coverage/coverage_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "core/error.hpp"
#include "core/random.hpp"
#include "coverage/simulated_impacts.hpp"
#include "estimate/shared_settings.hpp"
#include "reconstruction/plan.hpp"
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

Truth truth_at(const ImpactModel& model, std::span<const double> theta, std::size_t dataset) {
  const ContactProperties& contact = model.contacts[dataset];
  const MaterialState materials = materials_under(model, theta, dataset);
  if (model.adhesion != AdhesionLaw::ring) {
    const ParameterSlot& energy = model.slots[model.slot_adhesion[dataset]];
    const bool follows = energy.derived && !energy.free && !model.constants.empty();
    return AdhesiveTruth{model.adhesion == AdhesionLaw::jkr,
                         materials.density,
                         materials.stiffness,
                         follows ? materials.adhesion_energy : theta[model.slot_adhesion[dataset]],
                         theta[model.slot_C_H[dataset]],
                         theta[model.slot_C_A[dataset]],
                         model.phase == AdhesionDampingPhase::both};
  }
  RingAdhesionTruth truth;
  truth.density = materials.density;
  truth.stiffness = materials.stiffness;
  truth.adhesion_force = adhesion_force_under(model, theta, dataset);
  truth.reference_diameter = contact.reference_diameter;
  truth.C_H = theta[model.slot_C_H[dataset]];
  truth.C_A = theta[model.slot_C_A[dataset]];
  truth.damped_in_both_phases = model.phase == AdhesionDampingPhase::both;
  return truth;
}

/// theta with the constants of the materials drawn from their errors about what is stated.
std::vector<double> with_drawn_constants(const ImpactModel& model, std::vector<double> theta,
                                         std::uint64_t seed, std::uint64_t index) {
  RandomStream random(seed, RandomPurpose::constants, ~index);
  for (std::size_t k = 0; k < model.constants.size(); ++k) {
    const UncertainConstant& constant = model.constants[k];
    const double by = constant.sd * random.normal();
    const std::size_t slot = model.first_constant() + k;
    const double value =
        is_positive(constant.constant) ? constant.stated * std::exp(by) : constant.stated + by;
    theta[slot] = std::clamp(value, model.slots[slot].lower, model.slots[slot].upper);
  }
  return theta;
}

std::vector<Truth> truths_at(const ImpactModel& model, std::span<const double> theta) {
  std::vector<Truth> truths;
  for (std::size_t d = 0; d < model.contacts.size(); ++d) {
    truths.push_back(truth_at(model, theta, d));
  }
  return truths;
}

CoverageTruth::At drawn_truth(const ImpactModel& model, const std::vector<double>& theta,
                              const std::vector<Dataset>& datasets, std::uint64_t seed,
                              std::uint64_t index) {
  CoverageTruth drawn;
  drawn.theta = with_drawn_constants(model, theta, seed, index);
  add_capture_velocities(drawn, datasets, truths_at(model, drawn.theta));
  return {drawn.theta, drawn.capture};
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
  }
  add_capture_velocities(truth, datasets, truths);
  const auto shared = std::make_shared<const std::vector<KnownRecipe>>(std::move(recipes));
  truth.simulate = [datasets, shared, seed, model, theta = truth.theta](std::uint64_t index) {
    std::vector<Truth> drawn;
    if (!model.constants.empty()) {
      drawn = truths_at(model, with_drawn_constants(model, theta, seed, index));
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
      return drawn_truth(model, theta, datasets, seed, index);
    };
  }
  return truth;
}

/// A point of the design, to be simulated at the estimate.
struct DesignPoint {
  double restitution = 0.0;                ///< of the typical impact [1]
  double sd = 0.0;                         ///< that the point states or the fit found [1]
  double own_sd = 0.0;                     ///< of that, what the differing impacts do not make [1]
  std::shared_ptr<const TrueCurve> curve;  ///< where impacts differ and captures were counted
  std::shared_ptr<const TrueMixture> mixture;  ///< where the point averages over sizes
};

/// Impacts that differ by the capture velocity: V / V* is what counts.
double differing_velocity(double velocity, double spread, RandomStream& random) {
  return velocity * std::exp(spread * random.normal());
}

/// Variance of the mean that differing impacts make, on average over many such points.
/// @param restitution of one impact
double mean_variance(int events, const std::function<double()>& restitution) {
  constexpr int points = 400;
  double sum = 0.0;
  for (int k = 0; k < points; ++k) sum += count_impacts(events, restitution).variance_of_mean;
  return sum / points;
}

std::vector<DesignPoint> design_points(const FitResult& fitted,
                                       const std::vector<Dataset>& datasets,
                                       const std::vector<Truth>& truths, RandomStream& random) {
  const double spread = fitted.data.noise.event_spread;
  const double reach = std::exp(6.0 * spread);
  std::map<std::pair<std::size_t, double>, double> fastest;
  for (const Observation& point : fitted.data.points) {
    double& most = fastest[{point.dataset, point.diameter}];
    most = std::max(most, point.velocity * reach);
  }
  std::map<std::pair<std::size_t, double>, std::shared_ptr<const TrueCurve>> curves;
  std::vector<DesignPoint> design;
  for (const Observation& point : fitted.data.points) {
    const Truth& truth = truths[point.dataset];
    DesignPoint made{true_restitution(truth, point.diameter, point.velocity), point.weights.sd,
                     point.weights.sd, nullptr, nullptr};
    const auto without = [&](double variance) {
      return std::sqrt(std::max(0.0, point.weights.sd * point.weights.sd - variance));
    };
    if (averages_over_sizes(fitted.model, point.dataset)) {
      made.mixture = std::make_shared<const TrueMixture>(
          truth, *datasets[point.dataset].mixed_sizes, point.diameter, point.velocity);
      made.own_sd =
          without(mean_variance(point.events, [&] { return made.mixture->draw(random); }));
    } else if (spread > 0.0 && point.counted) {
      auto& curve = curves[{point.dataset, point.diameter}];
      if (!curve) {
        curve = std::make_shared<const TrueCurve>(truth, point.diameter,
                                                  true_capture_velocity(truth, point.diameter),
                                                  fastest[{point.dataset, point.diameter}]);
      }
      made.curve = curve;
      made.own_sd = without(mean_variance(point.events, [&] {
        return (*curve)(differing_velocity(point.velocity, spread, random));
      }));
    }
    design.push_back(std::move(made));
  }
  return design;
}

/// The point as an experiment at the truth would find it another time.
/// @param other_truth whether spheres may be captured here that were not, and the other way round
void simulate_point(const DesignPoint& design, double spread, bool other_truth, bool sd_stated,
                    RandomStream& random, ImpactPoint& point) {
  const double noise = random.normal();
  const bool differing = design.curve || design.mixture;
  if (!differing && other_truth) {
    const bool back = design.restitution > 0.0;
    point.captured = back ? 0 : point.events;
    point.restitution = back ? std::max(0.0, design.restitution + design.sd * noise) : 0.0;
    if (back && sd_stated) point.restitution_sd = design.sd;
    return;
  }
  if (!differing) {
    if (!point.all_captured()) {
      point.restitution = std::max(0.0, design.restitution + design.sd * noise);
    }
    return;
  }
  const CountedImpacts found = count_impacts(point.events, [&] {
    return design.mixture
               ? design.mixture->draw(random)
               : (*design.curve)(differing_velocity(point.incident_velocity, spread, random));
  });
  const bool stated = point.restitution_sd.has_value();
  point.captured = found.captured;
  point.restitution = 0.0;
  point.restitution_sd.reset();
  if (point.all_captured()) return;
  point.restitution = std::max(0.0, found.restitution + design.own_sd * noise);
  if (stated) {
    point.restitution_sd = std::sqrt(design.own_sd * design.own_sd + found.variance_of_mean);
  }
}

CoverageTruth from_fit(const FitSpec& spec, const std::vector<Dataset>& datasets,
                       std::uint64_t seed) {
  const auto [fitted, truths] = truth_at_estimate(spec, datasets, gather(datasets, spec));
  CoverageTruth truth;
  truth.origin = TruthOrigin::estimate;
  truth.theta = fitted.theta;
  add_capture_velocities(truth, datasets, truths);
  RandomStream random(seed, RandomPurpose::coverage, ~std::uint64_t{0});
  const double spread = fitted.data.noise.event_spread;
  const auto known = std::make_shared<const std::vector<DesignPoint>>(
      design_points(fitted, datasets, truths, random));
  truth.simulate = [datasets, seed, spread, known, fit = fitted](std::uint64_t index) {
    std::vector<DesignPoint> design = *known;
    const bool other_truth = !fit.model.constants.empty();
    if (other_truth) {
      const auto theta = with_drawn_constants(fit.model, fit.theta, seed, index);
      RandomStream own(seed, RandomPurpose::coverage, ~index);
      design = design_points(fit, datasets, truths_at(fit.model, theta), own);
    }
    auto next = design.begin();
    RandomStream noise(seed, RandomPurpose::coverage, index);
    RandomStream of_settings(seed, RandomPurpose::settings, index);
    const std::vector<double> shared = draw_setting_errors(fit.data, of_settings);
    auto off = shared.begin();
    std::vector<Dataset> made = datasets;
    for (Dataset& dataset : made) {
      for (ImpactPoint& point : dataset.points) {
        simulate_point(*next++, spread, other_truth, fit.data.sd_stated, noise, point);
        const double error = *off++;
        if (!point.all_captured()) point.restitution = std::max(0.0, point.restitution + error);
      }
    }
    return made;
  };
  if (!fitted.model.constants.empty()) {
    truth.at = [datasets, seed, fit = fitted](std::uint64_t index) {
      return drawn_truth(fit.model, fit.theta, datasets, seed, index);
    };
  }
  return truth;
}

}  // namespace

CoverageTruth coverage_truth(const FitSpec& spec, const std::vector<Dataset>& datasets,
                             std::uint64_t seed) {
  if (spec.adhesion == AdhesionLaw::maugis) {
    throw InputError({spec.file.string()},
                     "coverage can simulate no truth with adhesion = \"maugis\"",
                     "its independent simulator knows the ring law, jkr and dmt",
                     "take jkr or dmt, whichever is closer to your Tabor parameter");
  }
  if (!spec.mechanisms.empty()) {
    throw InputError(
        {spec.file.string()}, "coverage can simulate no truth with mechanisms",
        "its simulator, which shares no code with the fitter, knows the base model only",
        "leave 'mechanisms' out");
  }
  // Recipes have the ring law's truth.
  std::vector<KnownRecipe> recipes;
  if (spec.adhesion == AdhesionLaw::ring) recipes = known_recipes(datasets);
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
  found.truths = truths_at(found.fitted.model, found.fitted.theta);
  return found;
}

}  // namespace recoil
