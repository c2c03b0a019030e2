#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "validation/recipe/recipe.hpp"

/// The points of a recipe. The only code of this folder that uses what is tried on a truth: points
/// may come by way of simulated passages and the tool's own pairing.
namespace recoil {

/// The points of a recipe with a table [pairing].
struct PairedPoints {
  std::string csv;                     ///< points.csv
  std::vector<GeneratedPoint> points;  ///< the same, for the facts
};

/// The same bytes as `./run study reconstruct DIR --passages FILE` followed by `recoil pair FILE`
/// with the options of that table.
/// @pre recipe.pairing
PairedPoints pair_passages(const Recipe& recipe);

/// The same design and system with new noise, for coverage studies. Cheap (about 0.1 ms): the
/// noiseless truth is already in the recipe.
/// @throws InputError when `original` does not have the design of the recipe.
Dataset regenerate(const Dataset& original, const Recipe& recipe, std::uint64_t seed);

/// Is the truth made by the ring-adhesion model, with one C_A for all sizes? Then its C_H, C_A and
/// f0 are those of a fit.
bool has_model_of_fit(const Recipe& recipe);

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
