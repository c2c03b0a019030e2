#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/coverage_grid.hpp"

namespace recoil {

/// One row of a coverage table as it stands in a file.
struct CoverageTableRow {
  std::string design;             ///< "n20 equal stated f0-fixed captures", or the id of a fit
  std::string parameter;          ///< "C_A", "V*(4.9 um)"
  double identifiable = 0.0;      ///< share of the data sets [%]
  double held = 0.0;              ///< by the recommended interval [%]
  std::string held_identifiable;  ///< where the verdict called it identifiable [%], "-": nowhere
  std::string verdict;            ///< "holds", "holds, warned", "warned", "TOO NARROW", "TOO WIDE"
};

/// A table of the coverage study and the file that holds it.
struct CoverageTable {
  std::filesystem::path file;
  int datasets = 0;    ///< per design
  double level = 0.0;  ///< of its intervals
  std::vector<CoverageTableRow> rows;
  std::string markdown;  ///< the table itself, heads included
};

/// The coverage tables in the files coverage-*.md of `folder`, in the order of their names; files
/// without such a table are passed over.
/// @throws InputError where a row has other columns than the heads promise, nothing says how many
///     data sets it counts, or there is no table
std::vector<CoverageTable> read_coverage_tables(const std::filesystem::path& folder);

/// One page of all tables: the designs of the shipped fits whole; of the grid one row per design
/// with its worst parameter, what the verdict warns of, and whether the intervals hold.
/// @param picture the file of the picture, relative to the page; empty: none
std::string coverage_summary(const std::vector<CoverageTable>& tables, const std::string& picture);

/// What the tables say of the recommended intervals of the grid, for `coverage_picture`: shares as
/// counts of their data sets.
std::vector<GridResult> grid_of_tables(const std::vector<CoverageTable>& tables);

}  // namespace recoil
