#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coverage/coverage.hpp"

namespace recoil {

/// How the scatter of a point depends on where it is.
enum class GridNoise {
  equal,         ///< 0.02 everywhere
  near_capture,  ///< 0.01 far above the capture velocity, five times that at it
  proportional,  ///< 10 % of e
};

std::string to_string(GridNoise noise);

/// One kind of data set that people bring: points of one diameter, evenly spaced in log V from just
/// above the capture velocity (below it, where there are captures) to fifty times that.
struct GridDesign {
  int points = 20;
  GridNoise noise = GridNoise::equal;
  bool sd_stated = true;       ///< every point comes with its standard deviation
  bool adhesion_free = false;  ///< f0 is fitted, too
  bool captures = false;       ///< every point averages 40 impacts whose velocities scatter by 3 %;
                               ///< those below the capture velocity stay and are counted

  /// "n20 equal stated f0-fixed captures"
  std::string name() const;
};

/// n = 10, 20, 60 x three kinds of noise x stated or not x f0 fixed or free x with or without
/// captures.
std::vector<GridDesign> coverage_grid();

/// The designs of the grid whose names have all these words ("n20", "near-capture", "captures").
/// @throws InputError for a word of no design, and where no design has all of them
std::vector<GridDesign> designs_named(const std::vector<std::string>& words);

/// Data sets of `design` with the system of `base` and the parameters `theta` as truth, simulated
/// by the independent integrator of the reconstructions (see coverage_truth).
CoverageTruth grid_truth(const FitSpec& spec, const Dataset& base, const GridDesign& design,
                         std::uint64_t seed);

/// `spec` with f0 free or fixed as `design` has it.
FitSpec grid_spec(const FitSpec& spec, const GridDesign& design);

struct GridResult {
  GridDesign design;
  CoverageResult coverage;
};

/// Measures every design in turn. A finished one is kept as a file in `kept` (unless that is empty)
/// and taken from there by the next run of the same version, so that a stopped study goes on.
std::vector<GridResult> measure_grid(const FitSpec& spec, const Dataset& base,
                                     const std::vector<GridDesign>& designs,
                                     const CoverageOptions& options,
                                     const std::filesystem::path& kept);

/// The whole grid as Markdown: a summary, then one row per design and parameter.
std::string grid_markdown(const std::vector<GridResult>& results, const FitSpec& spec,
                          const CoverageOptions& options);

/// The coverage in the design of one fit.
struct DesignResult {
  std::string id;  ///< of the fit
  CoverageResult coverage;
};

/// Measures the design of a fit (see coverage_truth); kept as those of the grid.
DesignResult measure_design(const FitSpec& spec, const std::vector<Dataset>& datasets,
                            const CoverageOptions& options, const std::filesystem::path& kept);

/// The designs of several fits as one Markdown table like that of the grid.
std::string designs_markdown(const std::vector<DesignResult>& results,
                             const CoverageOptions& options);

}  // namespace recoil
