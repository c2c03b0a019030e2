#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"
#include "validation/synthetic/effects.hpp"

namespace recoil::hidden {

/// A condition as a table states it, in SI.
struct StatedCondition {
  std::string name;
  double value = 0.0;
  RECOIL_FIELDS(name, value)
};

/// What the experimenter could state where `effect` acts in `effects`: the
/// pressure of the gas and the height of the measuring plane, the humidity at which a meniscus has
/// that radius, the thickness of the plate, the roughness, and that nothing was neutralised or
/// checked. Empty where no condition belongs to it.
std::vector<StatedCondition> conditions_behind(const std::string& effect, const Base& base,
                                               const Effects& effects);

/// The change that takes `effect` away; its name is empty where there is none.
StatedCondition change_against(const std::string& effect);

/// What is left of `effects` under a changed condition.
Effects under(const StatedCondition& condition, Effects effects);

}  // namespace recoil::hidden
