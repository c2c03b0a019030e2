#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"

namespace recoil {

/// The block report that `recoil fit` prints: provenance, fit statistics, variables, correlations,
/// derived quantities, two-point comparison, warnings. At most 100 columns. An unusable fit gets
/// the blocks that it has, and its failure.
std::string text_report(const Analysis& analysis);

/// One self-contained page: plots (inline SVG by gnuplot), tables, provenance; no network, about
/// 1 MB at most. Its scripts save the pictures and explore e(V); without them it is complete.
/// @param diagnosis the section on what the model gets wrong; empty: there is none
/// @pre analysis.fitted.usable
/// @throws ComputationError when gnuplot cannot be run.
std::string html_report(const Analysis& analysis, std::vector<Block> diagnosis = {});

/// A small e(V) picture of the whole fit as SVG, for the index.
/// @throws ComputationError when gnuplot cannot be run.
std::string thumbnail(const Analysis& analysis);
/// The numbers in it, as comma-separated values.
std::string thumbnail_csv(const Analysis& analysis);

}  // namespace recoil
