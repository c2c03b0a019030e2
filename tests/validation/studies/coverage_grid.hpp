#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "coverage/coverage.hpp"

namespace recoil {

/// How the scatter of a point depends on where it is.
enum class GridNoise {
  equal,         ///< 0.02 everywhere
  near_capture,  ///< 0.01 far above the capture velocity, five times that at it
  proportional,  ///< 10 % of e
};

constexpr auto names_of_values(GridNoise) { return name_list("equal", "near-capture", "10 %"); }

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

}  // namespace recoil
