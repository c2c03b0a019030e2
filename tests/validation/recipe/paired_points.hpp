#pragma once

#include <string>
#include <vector>

#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"
#include "validation/recipe/facts.hpp"
#include "validation/recipe/recipe.hpp"

/// The points of a recipe by way of simulated passages and the tool's own pairing. With
/// reconstruction.cpp the only code of this folder that uses what is tried on a truth.
namespace recoil {

/// What `./run study reconstruct --passages` writes for `recipe`, read as `recoil pair` reads it.
/// @param times with so many times as many spheres.
PassageTable recipe_passages(const Recipe& recipe, int times = 1);

/// The options of `recoil pair` that the recipe's table [pairing] stands for.
/// @pre recipe.pairing
PairingOptions recipe_pairing(const Recipe& recipe);
AverageOptions recipe_averaging(const Recipe& recipe);

struct PairedPoints {
  std::string csv;                     ///< points.csv
  std::vector<GeneratedPoint> points;  ///< the same, for the facts
};

/// The same bytes as `./run study reconstruct DIR --passages FILE` followed by `recoil pair FILE`
/// with the options above.
/// @pre recipe.pairing
PairedPoints pair_passages(const Recipe& recipe);

}  // namespace recoil
