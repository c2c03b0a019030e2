#pragma once

#include <map>
#include <string>

#include "experiment/averages.hpp"
#include "experiment/pairing_files.hpp"

namespace recoil {

/// The pictures of an experiment as SVG files by name, after those of Li, Dunn & Brach (1999):
/// `sizes.svg` (Fig. 3), `velocities-raw.svg` and `velocities-paired.svg` (Figs 4a to c), and
/// `restitution.svg` (Fig. 5). Bars follow Sturges' rule, the line that of Freedman and Diaconis.
/// @param remark what the reader should know of the data; stands under every title.
std::map<std::string, std::string> experiment_figures(const Distributions& distributions,
                                                      const Averages& averages,
                                                      const std::string& remark);

}  // namespace recoil
