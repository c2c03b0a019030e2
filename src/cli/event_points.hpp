#pragma once

#include "experiment/averages.hpp"
#include "experiment/events.hpp"
#include "experiment/pairing.hpp"
#include "predict/correction_study.hpp"
#include "reconstruction/reconstruction.hpp"

namespace recoil {

/// What `recoil reconstruct --passages` writes for `recipe`, read as `recoil pair` reads it.
/// @param times with so many times as many spheres.
EventTable recipe_events(const Recipe& recipe, int times = 1);

/// The options of `recoil pair` that the recipe's table [pairing] stands for.
/// @pre recipe.pairing
PairOptions recipe_pairing(const Recipe& recipe);
AverageOptions recipe_averaging(const Recipe& recipe);

/// The points of a recipe by way of its events: the same bytes as `recoil reconstruct DIR
/// --passages FILE` followed by `recoil pair FILE`, see `pair_command_words`.
PairedPoints pair_passages(const Recipe& recipe);

/// The events of a recipe whose truth is the model of a fit, with that truth.
/// @pre true_parameters(recipe) is not empty
KnownEvents known_events(const Recipe& recipe, int times);

/// What each correction of the pairing does: to the points of the recipe themselves, and, where
/// chance is smaller and sizes do not mix, to `many_times` as many spheres in `many_classes` size
/// classes. Empty when the recipe does not go by way of events, or has another truth.
/// @param like the recipe's dataset.
std::vector<CorrectionStudy> study_recipe(const FitSpec& spec, const Recipe& recipe,
                                          const Dataset& like, int many_times = 20,
                                          std::size_t many_classes = 16);

/// These two commands, for people.
std::string pair_command_words(const Recipe& recipe);

}  // namespace recoil
