#pragma once

#include <string>

#include "document/document.hpp"
#include "plan/experiment_plan.hpp"

/// The result of `recoil plan`.
namespace recoil {

/// The output of `recoil plan`: the answer, the points to measure and the expected errors.
/// @param assumed source of the values of the parameters
/// @param least answer: settings that only check the model share a row
std::string plan_text(const ExperimentPlan& plan, const std::string& assumed, Importance least);

std::string plan_html(const ExperimentPlan& plan, const std::string& assumed);

std::string json_plan(const ExperimentPlan& plan);

/// The planned points of a dataset as a CSV file to be filled in. It has the columns and units of
/// the dataset; series, diameter, velocity and events are set, the other cells are empty.
std::string csv_points_to_make(const ExperimentPlan& plan, std::size_t dataset);

}  // namespace recoil
