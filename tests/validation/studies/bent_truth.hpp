#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "coverage/coverage.hpp"
#include "estimate/fit_spec.hpp"

namespace recoil {

/// Where the true loss of energy differs from that of the laws.
enum class BendShape {
  velocity,      ///< a sin(1.3 ln V + p), the same for all sizes
  by_size,       ///< the same with another p for every size
  near_capture,  ///< +- a (V* / V)^2
  other_law,     ///< no factor: the impacts are those of JKR, with the work of the materials
};
constexpr auto names_of_values(BendShape) {
  return name_list("velocity", "by_size", "near_capture", "other_law");
}

/// Data sets of the design of `datasets` in which the laws are wrong: the independent simulator
/// makes the impacts at `damping` with material constants drawn from their stated errors, and the
/// loss of every impact is multiplied by 1 + g with g of the given shape and amplitude. p and the
/// sign are drawn for every data set. A point has the stated sd, or `unstated_sd`. Below capture,
/// where the simulator has no e^2, e^2 V^2 continues as a straight line in V^2.
struct BentTruth {
  double C_H = 3e-3, C_A = 3e-2;  ///< [s/m]
  double amplitude = 0.0;         ///< a [1]
  BendShape shape = BendShape::velocity;
  double unstated_sd = 0.01;  ///< [1]
};
/// A design whose fits are averaged over the error of the laws.
struct LawDesign {
  std::string name;
  FitSpec spec;
  std::vector<Dataset> datasets;
  double C_H = 3e-3, C_A = 3e-2;  ///< true [s/m]
};
/// Those of three shipped fits (in `fits`), of polystyrene of two sizes on fused silica, and of ten
/// points of one size.
std::vector<LawDesign> law_designs(const std::filesystem::path& fits);

CoverageTruth bent_truth(const FitSpec& spec, const std::vector<Dataset>& datasets,
                         const BentTruth& bent, std::uint64_t seed);

}  // namespace recoil
