#pragma once

#include <optional>
#include <string>
#include <vector>

#include "estimate/model.hpp"

namespace recoil {

/// One parameter of a fit.json.
struct FittedValue {
  double value = 0.0;
  std::optional<double> std_error;
};

/// Replaces the fit file's initial values by the values of a fit.json, and returns them [slots].
/// @throws InputError when it is none, or that of another fit
std::vector<FittedValue> take_fitted_values(ImpactModel& model, const std::string& path);

}  // namespace recoil
