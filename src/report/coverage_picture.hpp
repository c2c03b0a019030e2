#pragma once

#include <string>
#include <vector>

#include "plot/plot.hpp"
#include "uncertainty/coverage_grid.hpp"

namespace recoil {

/// The coverage study as one picture: a row per design, for each parameter the
/// share of data sets whose verdict calls it identifiable and a column per kind of interval. Cells
/// hold the measured coverage in percent and are white within two percent of the level, orange
/// below and blue above, deeper the further away; pale where the verdict warned in nine data sets
/// of ten.
/// @param remark stands under the picture: where the design comes from
plot::Picture coverage_picture(const std::vector<GridResult>& results, const FitSpec& spec,
                               const CoverageOptions& options, const std::string& remark);

/// The same under another title.
/// @param level of the intervals [1]
plot::Picture coverage_picture(const std::vector<GridResult>& results, double level,
                               const std::string& title, const std::string& remark);

/// The colour of a cell [#rrggbb]: `held` and `level` are shares [1].
std::string coverage_colour(double held, double level);

}  // namespace recoil
