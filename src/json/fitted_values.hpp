#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/model.hpp"

namespace recoil {

/// One parameter of a fit.json.
struct FittedValue {
  double value = 0.0;
  std::optional<double> std_error;
};

/// `spec` with the loss of the dry contact that the fit.json `path` has, where the fit file leaves
/// it to the points. An empty path changes nothing.
/// @throws InputError when it is no fit.json
FitSpec with_fitted_loss(FitSpec spec, const std::string& path);

/// Replaces the fit file's initial values by the values of a fit.json, and returns them [slots].
/// @param datasets those of the fit file: the values have to be fitted to these very files
/// @throws InputError when it is none, or that of another fit
std::vector<FittedValue> take_fitted_values(ImpactModel& model,
                                            const std::vector<Dataset>& datasets,
                                            const std::string& path);

}  // namespace recoil
