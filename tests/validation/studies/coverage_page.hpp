#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"
#include "plot/plot.hpp"
#include "validation/studies/coverage_study.hpp"

namespace recoil {

/// The page of one study: how its rows stand to what the intervals promise, and all of them.
Document page_of(const CoverageStudy& study);

/// One page of several studies: the designs of fits whole; of the grid one row per design with its
/// worst parameter, what the verdict warns of, and whether the intervals are as promised.
Document coverage_summary(const std::vector<CoverageStudy>& studies);

/// How many rows are what.
struct CoverageTally {
  int rows = 0;
  PerValue<CoverageVerdict, int> of;

  void add(const ParameterCoverage& row);
  int nominal() const;  ///< warned of or not
};
CoverageTally tally_of(const std::vector<ParameterCoverage>& rows);

/// The row of a design that is worst: misses first, then rows without a warning, then by distance.
/// @pre rows is not empty
const ParameterCoverage& worst_of(const std::vector<const ParameterCoverage*>& rows);

/// The rows of a grid as one picture: a row per design in the order of the grid,
/// for each parameter the share of data sets whose verdict calls it identifiable and a column per
/// kind of interval. Cells have the measured coverage in percent and are white within two percent
/// of the level, orange below and blue above, deeper the further away; pale where the verdict
/// warned in nine data sets of ten.
/// @param level of the intervals [1]
/// @param remark stands under the picture: where the design comes from
plot::Picture coverage_picture(const std::vector<ParameterCoverage>& rows, double level,
                               const std::string& title, const std::string& remark);

/// That of one study of a grid.
plot::Picture coverage_picture(const CoverageStudy& study);

/// The colours of the cells by the share of data sets [1].
plot::ColourScale coverage_colours(double level);

}  // namespace recoil
