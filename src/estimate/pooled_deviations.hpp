#pragma once

#include <optional>
#include <span>

#include "estimate/observations.hpp"
#include "estimate/weights.hpp"

namespace recoil {

/// Is the stated sd of this point, an average of several impacts, one of those that are pooled?
/// Not if some spheres were captured: their spread describes how impacts differ there.
bool pools_deviation(const Observation& point);

/// The noise of one impact, pooled from the standard deviations of the points.
struct PooledNoise {
  VarianceFunction variance = VarianceFunction::constant;
  double scale = 0.0;  ///< as Noise::scale
  int dof = 0;         ///< impacts minus points
};

/// Pools sds that were computed from n_i impacts each: s_i^2 n_i / sigma_i^2 is chi-squared with
/// n_i - 1 degrees of freedom over these, where sigma_i follows a variance function. The function
/// is the likeliest, its scale is s^2 = sum (n_i - 1) (s_i / f_i)^2 / sum (n_i - 1).
/// @param weights their proximities are used
/// @param predicted predicted e^2 [points]
/// @return nullopt if the sds differ by more than so few impacts explain (Bartlett 1937, Proc. R.
///   Soc. A 160, 268-282; p < 0.01): they are then used as stated
std::optional<PooledNoise> pool_deviations(const Observations& data, const Weights& weights,
                                           std::span<const double> predicted);

}  // namespace recoil
