#include "report/words_materials.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

std::string label_of(const ImpactModel& model, std::size_t constant) {
  return model.slots[model.first_constant() + constant].label();
}

Sentence better_words(const BudgetOf& of, const ImpactModel& model) {
  const ErrorBudget& budget = *of.budget;
  const BudgetEntry& first = budget.entries.front();
  const std::string share = fmt::format("{:.0f} %", 100.0 * first.share);
  Sentence words;
  if (first.source != BudgetSource::constant) {
    words = say("{}: most of the variance ({}) comes from {}", of.quantity, share,
                source_words(first, model));
    words += first.source == BudgetSource::scatter ? ", which more points reduce" : "";
  } else {
    words = say("{}: measure {} first, which accounts for {} of the variance", of.quantity,
                label_of(model, first.constant), share);
    if (budget.sd_without_first_constant) {
      words +=
          say("; if it were known exactly, the standard error would be {:.2g} instead of {:.2g}{}",
              *budget.sd_without_first_constant, budget.sd, unit_after_number(of.unit));
    }
  }
  if (!budget.linear) {
    words +=
        "; it does not depend linearly on the constants, so the shares say which is large, not how "
        "large";
  }
  return words;
}

}  // namespace

std::string source_words(const BudgetEntry& entry, const ImpactModel& model) {
  switch (entry.source) {
    case BudgetSource::scatter:
      return "scatter of the points";
    case BudgetSource::velocity:
      return "errors of the velocities";
    case BudgetSource::diameter:
      return "errors of the diameters";
    case BudgetSource::spread:
      return "the estimated spread of the impacts";
    case BudgetSource::constant:
      return label_of(model, entry.constant);
    case BudgetSource::numerics:
      return "numerics";
  }
  return {};
}

std::vector<BudgetOf> all_budgets(const Analysis& a) {
  std::vector<BudgetOf> all;
  const auto& slots = a.fitted.model.slots;
  for (std::size_t j = 0; j < a.uncertainty.budgets.size(); ++j) {
    const ErrorBudget& budget = a.uncertainty.budgets[j];
    if (!budget.available()) continue;
    all.push_back({symbol(slots[j].label()), std::string(slots[j].parameter->unit), &budget});
  }
  for (std::size_t k = 0; k < a.uncertainty.capture_budgets.size(); ++k) {
    const ErrorBudget& budget = a.uncertainty.capture_budgets[k];
    if (!budget.available()) continue;
    const CaptureEstimate& at = a.uncertainty.capture[k];
    const std::string where = a.datasets.size() > 1 ? ", " + a.datasets[at.dataset].id : "";
    all.push_back({say("{V*}({:.4g} {um}{})", at.diameter / units::um, where), "m/s", &budget});
  }
  return all;
}

std::vector<Sentence> budget_sentences(const Analysis& a) {
  std::vector<Sentence> sentences;
  if (a.fitted.model.constants.empty()) return sentences;
  for (const BudgetOf& of : all_budgets(a)) {
    sentences.push_back(better_words(of, a.fitted.model));
  }
  return sentences;
}

Sentence moved_words(const Analysis& a) {
  Sentence moved;
  for (std::size_t k = 0; k < a.fitted.constants_moved.size(); ++k) {
    const double by = a.fitted.constants_moved[k];
    if (std::abs(by) < 1.0) continue;
    moved += say("{}{} by {:+.1f}", moved.empty() ? "" : ", ", label_of(a.fitted.model, k), by);
  }
  if (moved.empty()) return moved;
  return say(
      "the points pull constants of the materials away from what is stated ({} standard "
      "deviations): either these are their true values, or they make up for something that the "
      "model lacks",
      moved);
}

std::string conditional_words(const Analysis& a) {
  if (!a.uncertainty.conditional) return {};
  return "intervals include the stated errors of the materials; \"materials exact\" is what they "
         "would be with the constants exactly as written (materials = false), which describes the "
         "scatter of the points alone";
}

}  // namespace recoil
