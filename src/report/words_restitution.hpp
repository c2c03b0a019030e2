#pragma once

#include <vector>

#include "data/dataset.hpp"
#include "document/document.hpp"
#include "estimate/restitution_summary.hpp"

/// The mean restitution of every series, in words and as a table.
namespace recoil {

/// The mean e of every series, the dependence of e on V, and the difference between series. Empty
/// if nothing rebounded.
std::vector<Sentence> restitution_sentences(const RestitutionSummary& summary,
                                            const std::vector<Dataset>& datasets);

/// The mean e of every series and setting; empty if there is only one.
Table restitution_table(const RestitutionSummary& summary, const std::vector<Dataset>& datasets);

}  // namespace recoil
