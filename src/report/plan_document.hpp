#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"
#include "plan/experiment_plan.hpp"

namespace recoil {

/// What `recoil plan` prints: the answer, what to measure, the errors.
/// @param assumed where the values of the parameters come from
std::vector<Section> plan_sections(const ExperimentPlan& plan, const std::string& assumed);
std::string plan_text(const ExperimentPlan& plan, const std::string& assumed);

/// The same as a page, with its pictures.
/// @throws ComputationError when gnuplot cannot be run.
std::string plan_html(const ExperimentPlan& plan, const std::string& assumed);

}  // namespace recoil
