#pragma once

#include <string>

#include "plan/experiment_plan.hpp"

namespace recoil {

/// plan.json.
std::string json_plan(const ExperimentPlan& plan);

/// The points of a dataset as a CSV file to be filled in: the columns of its schema in their units,
/// one row for each point to be made, with series, diameter, velocity and events; the rest empty.
std::string csv_points_to_make(const ExperimentPlan& plan, std::size_t dataset);

}  // namespace recoil
