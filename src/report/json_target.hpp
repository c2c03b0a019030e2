#pragma once

#include <vector>

#include "diagnosis/next_experiment.hpp"
#include "report/json_values.hpp"

namespace recoil {

/// Puts on what to measure, `target`, and where, `points[]`, into `entry`.
void add_target(Json& entry, const TargetMaterial& material,
                const std::vector<ExperimentPlace>& places);

}  // namespace recoil
