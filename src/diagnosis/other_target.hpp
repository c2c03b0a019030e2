#pragma once

#include <string_view>
#include <vector>

#include "data/dataset.hpp"

namespace recoil {

/// A material of which a thick, polished block can be had.
struct TargetMaterial {
  std::string_view name;
  double youngs_modulus = 0.0;  ///< [Pa]
  double poisson_ratio = 0.0;   ///< [1]
  double density = 0.0;         ///< [kg/m3]
};

/// Handbook values, the stiffest first. Those of a piece in hand differ by some 5 % (of plastics by
/// 20 %), and replace them.
const std::vector<TargetMaterial>& target_materials();

/// Those that would change what the contact of the spheres of `dataset` depends on, K or the
/// estimate of W_A, by more than a fifth. None is softer than the spheres: it would yield, or lose
/// energy, in their place, and bring effects of its own.
std::vector<TargetMaterial> other_targets(const Dataset& dataset);

/// A dataset without points: the spheres, the instrument and the conditions of `dataset`, and a
/// thick, polished block of `material` in the place of the target. What `dataset` states of the
/// pair instead of deriving it is scaled as it would follow from the materials: K by eq. 6, W_A by
/// eq. 11, f0 by eq. 12.
Dataset on_target(const Dataset& dataset, const TargetMaterial& material);

/// How well the adhesion on another target can be told beforehand: standard deviation of ln f0
/// about what eq. 12 makes of it, two thirds of that of ln W_A [1]. Gilman's estimate misses a
/// surface energy by 0.46 in its logarithm (`material_constants.cpp`); of W_A = 2 sqrt(gamma1
/// gamma2) on two targets the quotient misses by 0.46 / sqrt(2).
inline constexpr double log_sd_of_other_adhesion = 0.22;

}  // namespace recoil
