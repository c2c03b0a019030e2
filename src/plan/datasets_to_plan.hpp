#pragma once

#include <vector>

#include "plan/plan_result.hpp"

namespace recoil {

/// The datasets as an experiment will find them: their materials and conditions, one series for
/// each diameter, with one point that stands for it. f0 belongs to the diameter to which it did, or
/// else to the middle one of the plan.
/// @param diameters [m]; empty: those of each dataset's own points
/// @throws InputError where no diameter is known
std::vector<Dataset> datasets_to_plan(std::vector<Dataset> datasets,
                                      const std::vector<double>& diameters);

/// Puts one point for each setting of the plan, as it is expected, into its datasets.
void take_points(ExperimentPlan& plan);

}  // namespace recoil
