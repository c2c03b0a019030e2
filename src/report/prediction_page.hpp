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
/// 1999), the smallest, mean and largest size (Fig. 10), and the captured part of the spheres.
std::vector<Figure> mixture_figures(const Analysis& analysis,
                                    const PolydispersePrediction& mixture);

/// Sizes, averages by convention, captures, and the distance of the points from each average.
std::vector<Section> prediction_sections(const Analysis& analysis,
                                         const PolydispersePrediction& mixture);

/// The output of `recoil predict`, at most 100 columns.
std::string text_prediction(const Analysis& analysis, const PolydispersePrediction& mixture);

/// The averages of every mixture of a fit, for its page.
std::vector<Block> mixture_blocks(const Analysis& analysis);

}  // namespace recoil
