#pragma once

#include <map>
#include <string>

#include "document/document.hpp"
#include "validation/studies/paper_comparison.hpp"
#include "validation/studies/paper_statements.hpp"

namespace recoil::paper {

/// How many statements of one part, or of all, agree.
struct Tally {
  int agree = 0, disagree = 0, obstacles = 0;

  int compared() const { return agree + disagree; }
};

/// Does recoil agree with a statement that can be compared?
/// @throws std::out_of_range if nothing was found for it
bool holds(const Statement& statement, const Comparison& comparison);

/// @param part Part::id; empty: all
Tally tally(const Comparison& comparison, std::string_view part = "");

/// The page "The paper, figure by figure": for each table and figure what agrees, what the fit to
/// all points adds, recoil's picture, and every statement beside what recoil gives.
Document paper_document(const Comparison& comparison);

}  // namespace recoil::paper
