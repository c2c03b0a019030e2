#pragma once

#include <vector>

#include "report/report.hpp"

namespace recoil {

/// The smallest and largest size beside d10 (Fig. 10 of Li, Dunn & Brach 1999), the three weighted
/// averages beside d10 (Figs. 11 and 12), and the part of the spheres that is captured.
std::vector<Figure> mixture_figures(const Analysis& analysis,
                                    const PolydispersePrediction& mixture);
/// The same of every mixture of an analysis.
std::vector<Figure> mixture_figures(const Analysis& analysis);

}  // namespace recoil
