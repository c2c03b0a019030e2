#include "report/figures_budget.hpp"

#include <algorithm>

#include "report/format.hpp"
#include "report/words_materials.hpp"

namespace recoil {
namespace {

// Of what is less than a hundredth of every variance nothing would be seen.
constexpr double least_seen = 0.01;

/// The sources that can be seen, the largest first.
std::vector<std::string> sources_of(const std::vector<BudgetOf>& budgets,
                                    const ImpactModel& model) {
  std::vector<std::pair<double, std::string>> found;
  for (const BudgetOf& of : budgets) {
    for (const BudgetEntry& entry : of.budget->entries) {
      if (entry.share < least_seen) continue;
      const std::string name = source_words(entry, model);
      const auto known = std::find_if(found.begin(), found.end(),
                                      [&](const auto& source) { return source.second == name; });
      if (known == found.end()) {
        found.emplace_back(entry.share, name);
      } else {
        known->first += entry.share;
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& one, const auto& other) { return one.first > other.first; });
  std::vector<std::string> names;
  for (auto& [share, name] : found) names.push_back(std::move(name));
  return names;
}

}  // namespace

std::vector<Figure> budget_figures(const Analysis& a) {
  const std::vector<BudgetOf> budgets = all_budgets(a);
  if (a.fitted.model.constants.empty() || budgets.empty()) return {};
  const std::vector<std::string> sources = sources_of(budgets, a.fitted.model);
  plot::Plot shown;
  shown.x.label = "share of the variance";
  shown.x.unit = "%";
  shown.x.set_range({0.0, 100.0});
  shown.y.grid = false;
  shown.key.place = plot::KeyPlace::above;
  std::vector<double> reached(budgets.size(), 0.0);
  for (std::size_t k = 0; k < sources.size(); ++k) {
    plot::Spans spans;
    spans.stroke = {plot::marker(k).colour, 14.0};
    spans.name = sources[k];
    spans.stops = false;
    for (std::size_t q = 0; q < budgets.size(); ++q) {
      for (const BudgetEntry& entry : budgets[q].budget->entries) {
        if (source_words(entry, a.fitted.model) != sources[k]) continue;
        spans.y.push_back(-static_cast<double>(q));
        spans.lower.push_back(reached[q]);
        reached[q] += 100.0 * entry.share;
        spans.upper.push_back(reached[q]);
      }
    }
    shown.layers.push_back(std::move(spans));
  }
  for (std::size_t q = 0; q < budgets.size(); ++q) {
    shown.y.ticks.push_back({-static_cast<double>(q), plain_text(budgets[q].quantity), false});
  }
  shown.y.set_range({-static_cast<double>(budgets.size()) + 0.4, 0.6});
  plot::Picture picture;
  picture.name = "budget";
  picture.title = "What the errors come from";
  picture.height = static_cast<int>(130 + 34 * budgets.size());
  picture.plots = {std::move(shown)};
  return {figure_of(
      std::move(picture),
      "Share of each source in the variance of a parameter or a capture velocity, by the law of "
      "propagation (JCGM 100:2008). The longest bar shows what to measure better first.")};
}

}  // namespace recoil
