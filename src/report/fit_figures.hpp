#pragma once

#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"

/// The pictures of a fit.
namespace recoil {

/// Where points average over sizes.
inline constexpr const char* mean_curve_words =
    "The curve is the mean of the spheres that rebound: it rises again where only the largest do.";

/// e against V of the whole fit: points and curves in one plot, told apart by diameter or, in a fit
/// of several datasets, by dataset.
plot::Picture restitution_overview(const Analysis& analysis, int width, int height);

/// e against V of every diameter: points, fit and its band, two-point calibration, V*.
std::vector<Figure> restitution_figures(const Analysis& analysis);

/// Weighted residuals against V, one picture per dataset.
std::vector<Figure> residual_figures(const Analysis& analysis);

/// V* against diameter beside older capture models, one picture per dataset.
std::vector<Figure> capture_figures(const Analysis& analysis);

}  // namespace recoil
