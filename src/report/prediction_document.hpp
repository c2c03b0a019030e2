#pragma once

#include <string>
#include <vector>

#include "report/report.hpp"

/// What is said of a mixture of sizes and of the capture models.
namespace recoil {

/// What `recoil predict` prints: the sizes, the three conventions side by side at some velocities,
/// captures, and how far the points lie from each. At most 100 columns.
std::string text_prediction(const Analysis& analysis, const PolydispersePrediction& mixture);

/// In sentences: what the conventions differ by, and which of them the points lie closest to.
std::vector<Sentence> mixture_words(const Analysis& analysis,
                                    const PolydispersePrediction& mixture);

/// What `recoil predict` prints, as sections.
std::vector<Section> prediction_sections(const Analysis& analysis,
                                         const PolydispersePrediction& mixture);

/// The same for a fit's page; empty when there is nothing to show.
std::vector<Block> mixture_blocks(const Analysis& analysis);

std::vector<Block> capture_comparison_blocks(const Analysis& analysis);

}  // namespace recoil
