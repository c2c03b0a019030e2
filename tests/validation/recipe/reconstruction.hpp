#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "validation/recipe/facts.hpp"
#include "validation/recipe/recipe.hpp"

namespace recoil {

/// points.csv of the recipe with the random numbers of `seed`; the committed file is the one of
/// `recipe.seed`.
std::string generate_points(const Recipe& recipe, std::uint64_t seed);

/// The same design and system with new noise, for coverage studies. Cheap (about 0.1 ms): the
/// noiseless truth is already in the recipe.
/// @throws InputError when `original` does not have the design of the recipe.
Dataset regenerate(const Dataset& original, const Recipe& recipe, std::uint64_t seed);

/// C_H [s/m], C_A [s/m] and f0 [N/m] at `reference_diameter` [m] of a truth made by the
/// ring-adhesion model, by these names; empty when the truth is another model.
std::map<std::string, double> true_parameters(const Recipe& recipe);

/// What `./run study reconstruct` found or made.
struct ReconstructionResult {
  std::string id;
  std::filesystem::path folder;
  std::uint64_t seed = 0;
  bool written = false;    ///< points.csv was written anew
  bool identical = false;  ///< points.csv is byte for byte what the recipe makes
  std::string difference;  ///< where it is not
  std::size_t points = 0;
  bool from_events = false;  ///< made by pairing simulated events; else means were drawn
  std::vector<FactCheck> facts;
  std::vector<std::string> assumptions;

  /// The file is the recipe's and every fact holds.
  bool good() const;
};

/// Makes points.csv of `folder` from its recipe, or with `check_only` compares the file that is
/// there; then checks every fact of the recipe.
/// @throws InputError for a mistake in the recipe, or a missing points.csv when only checking.
ReconstructionResult reconstruct(const std::filesystem::path& folder, bool check_only);

}  // namespace recoil
