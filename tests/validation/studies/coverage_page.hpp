#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"
#include "validation/studies/coverage_study.hpp"

namespace recoil {

/// The page of one study: how its rows stand to what the intervals promise, and all of them.
/// @param picture the file's name without its ending; empty: none
Document coverage_page(const CoverageStudy& study, const std::string& picture);

/// One page of several studies: the designs of fits whole; of the grid one row per design with its
/// worst parameter, what the verdict warns of, and whether the intervals are as promised.
Document coverage_summary(const std::vector<CoverageStudy>& studies, const std::string& picture);

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

}  // namespace recoil
