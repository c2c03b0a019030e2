#pragma once

#include <string>
#include <vector>

#include "report/figures.hpp"

/// What is said and drawn of a mixture of sizes and of the capture models.
namespace recoil {

/// What `recoil predict` prints: the sizes, the three conventions side by side at some velocities,
/// captures, and how far the points lie from each. At most 100 columns.
std::string text_prediction(const Analysis& analysis, const PolydispersePrediction& mixture);

/// `predict.csv`: one row per velocity, units in the column names; a cell is empty where there is
/// no value.
std::string csv_prediction(const PolydispersePrediction& mixture);

/// `predict.json`: everything, no NaN.
std::string json_prediction(const Analysis& analysis, const PolydispersePrediction& mixture);

/// The smallest and largest size beside d10 (Fig. 10 of Li, Dunn & Brach 1999), the three weighted
/// averages beside d10 (Figs. 11 and 12), and the part of the spheres that is captured.
std::vector<Figure> mixture_figures(const Analysis& analysis,
                                    const PolydispersePrediction& mixture);

/// The same of every mixture of an analysis.
std::vector<Figure> mixture_figures(const Analysis& analysis);

/// Capture velocity against diameter by this fit and by the older models, one picture per dataset.
std::vector<Figure> capture_comparison_figures(const Analysis& analysis);

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
