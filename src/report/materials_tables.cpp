#include "report/materials_tables.hpp"

#include <algorithm>
#include <map>

#include "report/fit_tables.hpp"
#include "report/format.hpp"
#include "report/words_intervals.hpp"
#include "report/words_materials.hpp"

namespace recoil {
namespace {

Cell range_cell(const Interval& interval) {
  if (!interval.available()) return {};
  return Sentence(NumberRange{*interval.lower, *interval.upper});
}

}  // namespace

Table constants_table(const Analysis& a) {
  Table table;
  const ImpactModel& model = a.fitted.model;
  if (model.constants.empty() || a.fitted.std_error.empty()) return table;
  table.caption =
      "Constants that are known with an error: they are parameters of the fit, and each stated "
      "value is one more observation";
  table.columns = {
      {"constant", "", true}, {"unit", "", true}, {"stated"}, {"fitted"}, {"moved", "sd"}};
  for (std::size_t k = 0; k < model.constants.size(); ++k) {
    const std::size_t j = model.first_constant() + k;
    const UncertainConstant& constant = model.constants[k];
    const double sd = constant.sd * (is_positive(constant.constant) ? constant.stated : 1.0);
    table.rows.push_back({Sentence(model.slots[j].label()), unit(model.slots[j].parameter->unit),
                          Number{constant.stated, significant(4), sd},
                          Number{a.fitted.theta[j], significant(4), a.fitted.std_error[j]},
                          Number{a.fitted.constants_moved[k], signed_fixed(2)}});
  }
  return table;
}

Table budget_table(const Analysis& a) {
  Table table;
  const std::vector<BudgetOf> budgets = all_budgets(a);
  if (a.fitted.model.constants.empty() || budgets.empty()) return table;
  table.caption =
      "What the errors come from: share of each source in the variance, in per cent "
      "(JCGM 100:2008, 5.1)";
  table.columns = {{"source", "", true}};
  // Sources in the order of their largest share.
  std::vector<std::pair<double, std::string>> sources;
  for (const BudgetOf& of : budgets) {
    table.columns.push_back({of.quantity});
    for (const BudgetEntry& entry : of.budget->entries) {
      const std::string name = source_words(entry, a.fitted.model);
      const auto found = std::find_if(sources.begin(), sources.end(),
                                      [&](const auto& source) { return source.second == name; });
      if (found == sources.end()) {
        sources.emplace_back(entry.share, name);
      } else {
        found->first = std::max(found->first, entry.share);
      }
    }
  }
  std::stable_sort(sources.begin(), sources.end(),
                   [](const auto& one, const auto& other) { return one.first > other.first; });
  constexpr double least_share = 5e-4;
  for (const auto& [largest, name] : sources) {
    if (largest < least_share) continue;
    std::vector<Cell> row = {Sentence(name)};
    for (const BudgetOf& of : budgets) {
      Cell cell;
      for (const BudgetEntry& entry : of.budget->entries) {
        if (source_words(entry, a.fitted.model) != name) continue;
        cell = Number{100.0 * entry.share, fixed(1)};
      }
      row.push_back(cell);
    }
    table.rows.push_back(std::move(row));
  }
  std::vector<Cell> total = {"standard error"};
  for (const BudgetOf& of : budgets) {
    total.push_back(Number{of.budget->sd, significant(2), 0.0, of.unit == "1" ? "" : of.unit});
  }
  table.rows.push_back(std::move(total));
  return table;
}

Table conditional_table(const Analysis& a) {
  Table table;
  if (!a.uncertainty.conditional) return table;
  const ConditionalFit& exact = *a.uncertainty.conditional;
  table.caption =
      say("{} profile intervals with the errors of the materials, and with exact "
          "materials",
          percent(a.uncertainty.options.level));
  table.columns = {{"parameter"},
                   {"estimate"},
                   {"interval"},
                   {"estimate, materials exact"},
                   {"interval, materials exact"}};
  for (std::size_t j = 0; j < exact.fitted.model.slots.size(); ++j) {
    const ParameterSlot& slot = exact.fitted.model.slots[j];
    if (!slot.free) continue;
    table.rows.push_back({labelled(slot), Number{a.fitted.theta[j], significant(4)},
                          range_cell(intervals_of(a, j)[IntervalKind::profile]),
                          Number{exact.fitted.theta[j], significant(4)},
                          range_cell(exact.intervals[j][IntervalKind::profile])});
  }
  return table;
}

}  // namespace recoil
