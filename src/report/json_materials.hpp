#pragma once

#include "core/json.hpp"
#include "report/report.hpp"

namespace recoil {

/// `constants`: what is stated of each uncertain constant of the materials, and what the fit found.
Json constants_json(const Analysis& analysis);

/// Adds `budget` (and what belongs to it) to the entry of a quantity; nothing where there is none.
void put_budget(Json& entry, const ErrorBudget& budget, const ImpactModel& model);

/// `conditional` of a parameter: its fit with exact materials; nothing where they are.
void put_conditional(Json& entry, const Analysis& analysis, std::size_t slot);

}  // namespace recoil
