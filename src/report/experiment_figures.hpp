#pragma once

#include <string>
#include <vector>

#include "experiment/averages.hpp"
#include "experiment/pairing_files.hpp"
#include "plot/plot.hpp"

namespace recoil {

/// The pictures of an experiment, after those of Li, Dunn & Brach (1999): `sizes` (Fig. 3),
/// `velocities-raw` and `velocities-paired` (Figs 4a to c), and `restitution` (Fig. 5). Bars follow
/// Sturges' rule, the line that of Freedman and Diaconis.
/// @param remark what the reader should know of the data; stands under every title.
std::vector<plot::Picture> experiment_pictures(const Distributions& distributions,
                                               const Averages& averages, const std::string& remark);

}  // namespace recoil
