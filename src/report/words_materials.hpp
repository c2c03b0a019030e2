#pragma once

#include <string>
#include <vector>

#include "report/report.hpp"

/// What the errors of the materials' constants make of a fit, in words.
namespace recoil {

/// "scatter of the points", "particle.youngs_modulus".
std::string source_words(const BudgetEntry& entry, const ImpactModel& model);

/// A quantity with a budget: "C_A", "V*(4.9 um)".
struct BudgetOf {
  Sentence quantity;
  std::string unit;
  const ErrorBudget* budget = nullptr;
};

/// All budgets that there are, parameters first.
std::vector<BudgetOf> all_budgets(const Analysis& analysis);

/// What to measure better first and what that would gain, one sentence for each budget.
std::vector<Sentence> budget_sentences(const Analysis& analysis);

/// Constants that the points moved by more than one standard deviation, and what that means; empty
/// when there is none.
Sentence moved_words(const Analysis& analysis);

/// Which of the two intervals is which.
std::string conditional_words(const Analysis& analysis);

}  // namespace recoil
