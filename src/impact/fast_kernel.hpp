#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "impact/impact.hpp"

namespace recoil {

/// The inner loop of the fast solver, compiled once per instruction set from one source. All of
/// them give the same digits: every lane does the same IEEE operations in the same order, and none
/// of them is fused.
struct FastKernel {
  const char* name;   ///< "avx512", "avx2", "baseline"
  std::size_t lanes;  ///< impacts per register
  /// Fills outcome, restitution_squared, steps and, when asked for, the gradient of every impact.
  /// An outcome that is not usable() is for the caller to hand over.
  void (*fly)(std::span<const ImpactGroups> groups, AdhesionDampingPhase phase, bool gradient,
              std::span<ImpactResult> results);
};

/// The kernels that this machine can run, the widest first.
const std::vector<FastKernel>& fast_kernels();

}  // namespace recoil
