#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"

/// The mean restitution of a mixture of sizes, for `recoil predict` and the page of a fit.
namespace recoil {

/// The averages under the three conventions and the curve of the mean diameter d10 (Figs. 11 and 12
/// of Li, Dunn & Brach 1999).
Figure mixture_figure(const Analysis& analysis, const PolydispersePrediction& mixture);

/// The output of `recoil predict`: sizes, averages by convention, captures, and the distance of the
/// points from each average.
std::string text_prediction(const Analysis& analysis, const PolydispersePrediction& mixture);

/// The averages of every mixture of a fit, for its page.
std::vector<Block> mixture_blocks(const Analysis& analysis);

/// The content of predict.csv: one row for each velocity. The names of the columns include units; a
/// cell without a value is empty.
std::string csv_prediction(const PolydispersePrediction& mixture);

std::string json_prediction(const Analysis& analysis, const PolydispersePrediction& mixture);

}  // namespace recoil
