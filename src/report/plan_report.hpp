#pragma once

#include <string>

#include "plan/experiment_plan.hpp"

/// A plan of an experiment: text, page, JSON and the points to be measured.
namespace recoil {

/// What `recoil plan` prints: the answer, what to measure, the errors.
/// @param assumed where the values of the parameters come from
std::string plan_text(const ExperimentPlan& plan, const std::string& assumed);

/// The same as a page.
std::string plan_html(const ExperimentPlan& plan, const std::string& assumed);

/// plan.json.
std::string json_plan(const ExperimentPlan& plan);

/// The points of a dataset as a CSV file to be filled in: the columns of its schema in their units,
/// one row for each point to be made, with series, diameter, velocity and events; the rest empty.
std::string csv_points_to_make(const ExperimentPlan& plan, std::size_t dataset);

}  // namespace recoil
