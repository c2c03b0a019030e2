#pragma once

#include <vector>

#include "document/document.hpp"
#include "plan/experiment_plan.hpp"

namespace recoil {

/// One picture for each dataset: what e(V) is expected to be for every size, and where the plan has
/// points, with one standard deviation of the mean of all of them.
std::vector<Figure> plan_figures(const ExperimentPlan& plan);

}  // namespace recoil
