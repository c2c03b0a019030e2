#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"

/// Restitution of a mixture of sizes, for `recoil predict` and the page of a fit.
namespace recoil {

/// "captured spheres count as e = 0", ...
std::string words_of(CaptureConvention convention);

/// "this fit", "JKR", ...: short enough for the key of a picture.
std::string words_of(CaptureModel model);

/// The averages under the three conventions beside d10 alone (Figs. 11 and 12 of Li, Dunn & Brach
/// 1999).
Figure mixture_figure(const Analysis& analysis, const PolydispersePrediction& mixture);

/// Sizes, averages by convention, captures, and the distance of the points from each average: the
/// output of `recoil predict`, at most 100 columns.
std::string text_prediction(const Analysis& analysis, const PolydispersePrediction& mixture);

/// The averages of every mixture of a fit, for its page.
std::vector<Block> mixture_blocks(const Analysis& analysis);

/// `predict.csv`: one row per velocity, units in the column names; a cell is empty where there is
/// no value.
std::string csv_prediction(const PolydispersePrediction& mixture);

/// `predict.json`: everything, no NaN.
std::string json_prediction(const Analysis& analysis, const PolydispersePrediction& mixture);

}  // namespace recoil
