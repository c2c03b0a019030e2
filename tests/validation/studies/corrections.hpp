#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "experiment/averages.hpp"
#include "experiment/correction_study.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"
#include "validation/recipe/recipe.hpp"

namespace recoil {

/// Every way from events to points that a study compares.
inline constexpr std::array all_ways = values_of<Correction>();

/// Events of which the truth is known, because they were simulated.
struct KnownPassages {
  PassageTable table;
  double rebounds_per_velocity = 0.0;  ///< as many spheres are seen to rebound per velocity
  std::vector<double> velocities;      ///< of the design [m/s], ascending
  double diameter = 0.0;               ///< the mean one, d10 [m]
  double C_H = 0.0;                    ///< [s/m]
  double C_A = 0.0;                    ///< [s/m]
  double capture_velocity = 0.0;       ///< at `diameter` [m/s]
  std::function<double(double diameter, double velocity)> restitution;  ///< [m], [m/s] -> e
};

/// Pairs and averages `events`, fits the points as `spec` says, and does the same again with each
/// correction left out. All rows rest on the same events, so their differences are those of the
/// correction and not of chance.
/// @param like the dataset whose materials the points get.
/// @param ways the rows that are wanted.
CorrectionStudy study_corrections(const FitSpec& spec, const Dataset& like,
                                  const KnownPassages& events, const PairingOptions& pairing,
                                  const AverageOptions& averaging,
                                  std::span<const Correction> ways = all_ways);

/// The events of a recipe whose truth is the model of a fit, with that truth.
/// @pre true_parameters(recipe) is not empty
KnownPassages known_passages(const Recipe& recipe, int times);

/// What each correction of the pairing does: to the points of the recipe themselves, and, where
/// chance is smaller and sizes do not mix, to `many_times` as many spheres in `many_classes` size
/// classes. Empty when the recipe does not go by way of events, or has another truth.
/// @param like the recipe's dataset.
std::vector<CorrectionStudy> study_recipe(const FitSpec& spec, const Recipe& recipe,
                                          const Dataset& like, int many_times = 20,
                                          std::size_t many_classes = 16);

}  // namespace recoil
