#include "report/json_materials.hpp"

#include "report/json_values.hpp"
#include "report/words_materials.hpp"

namespace recoil {

Json constants_json(const Analysis& a) {
  Json all = Json::object();
  const ImpactModel& model = a.fitted.model;
  if (a.fitted.theta.size() != model.slots.size()) return all;
  for (std::size_t k = 0; k < model.constants.size(); ++k) {
    const UncertainConstant& constant = model.constants[k];
    const std::size_t j = model.first_constant() + k;
    Json datasets = Json::array();
    for (const std::size_t d : constant.datasets) datasets.push_back(a.datasets[d].id);
    const bool positive = is_positive(constant.constant);
    all[model.slots[j].label()] = {
        {"value", number_or_null(a.fitted.theta[j])},
        {"unit", model.slots[j].parameter->unit},
        {"meaning", model.slots[j].parameter->meaning},
        {"std_error", number_or_null(j < a.fitted.std_error.size() ? a.fitted.std_error[j] : 0.0)},
        {"stated", number_or_null(constant.stated)},
        {"stated_sd", number_or_null(constant.sd)},
        {"distribution", positive ? "lognormal" : "normal"},
        {"moved_sd", number_or_null(a.fitted.constants_moved[k])},
        {"datasets", datasets}};
  }
  return all;
}

void put_budget(Json& entry, const ErrorBudget& budget, const ImpactModel& model) {
  if (!budget.available()) return;
  Json rows = Json::array();
  for (const BudgetEntry& source : budget.entries) {
    Json row = {{"source", source.source == BudgetSource::constant ? source_words(source, model)
                                                                   : to_string(source.source)},
                {"sd", number_or_null(source.sd)},
                {"share", number_or_null(source.share)}};
    if (source.lower && source.upper) {
      row["move"] = Json::array({number_or_null(*source.lower), number_or_null(*source.upper)});
    }
    rows.push_back(std::move(row));
  }
  entry["budget"] = std::move(rows);
  entry["budget_linear"] = budget.linear;
  entry["budget_sd_without_first_constant"] =
      budget.sd_without_first_constant ? number_or_null(*budget.sd_without_first_constant)
                                       : Json(nullptr);
}

void put_conditional(Json& entry, const Analysis& a, std::size_t slot) {
  if (!a.uncertainty.conditional) return;
  const ConditionalFit& exact = *a.uncertainty.conditional;
  if (slot >= exact.fitted.theta.size() || !exact.fitted.model.slots[slot].free) return;
  Json intervals;
  for (const IntervalKind kind : {IntervalKind::wald, IntervalKind::profile}) {
    intervals[to_string(kind)] = interval_json(exact.intervals[slot][kind]);
  }
  entry["materials_exact"] = {{"value", number_or_null(exact.fitted.theta[slot])},
                              {"std_error", number_or_null(exact.fitted.std_error[slot])},
                              {"intervals", intervals}};
}

}  // namespace recoil
