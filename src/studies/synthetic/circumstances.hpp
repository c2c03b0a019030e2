#pragma once

#include <string>
#include <vector>

#include "studies/synthetic/effects.hpp"

namespace hidden {

struct Case;

/// A condition as a table states it, in SI.
struct StatedCondition {
  std::string name;
  double value = 0.0;
};

/// What somebody who knows how it was done could state, where `effect` acts in `effects`: the
/// pressure of the gas and the height of the measuring plane, the humidity at which a meniscus has
/// that radius, the thickness of the plate, the roughness, and that nothing was neutralised or
/// checked. Empty where no condition belongs to it.
std::vector<StatedCondition> conditions_behind(const std::string& effect, const Base& base,
                                               const Effects& effects);

/// The change that takes `effect` away; its name is empty where there is none.
StatedCondition change_against(const std::string& effect);

/// What is left of `effects` under a changed condition.
Effects under(const StatedCondition& condition, Effects effects);

/// Impacts that somebody takes after a first answer.
struct FurtherImpacts {
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  int events = 0;
  StatedCondition changed;  ///< that they were taken under; of no name: as the others
};

/// Adds one point with the mean of so many further impacts, its noise drawn by `round`. A diameter
/// that no row has makes a row.
void take_further(Case& made, const FurtherImpacts& further, std::uint64_t round);

}  // namespace hidden
