#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "impact/impact.hpp"

namespace recoil {

/// Fills outcome, restitution_squared, steps and, when asked for, the gradient of every impact. The
/// caller hands impacts whose outcome is not usable() over to the reference solver.
using KernelFunction = void(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                            std::span<ImpactResult> results);

// One per instruction set, all compiled from fast_kernel.cpp; which of the last two there are is
// decided in CMakeLists.txt.
namespace baseline {
std::size_t lanes();
KernelFunction simulate;
}  // namespace baseline
namespace avx2 {
std::size_t lanes();
KernelFunction simulate;
}  // namespace avx2
namespace avx512 {
std::size_t lanes();
KernelFunction simulate;
}  // namespace avx512

/// The inner loop of the fast solver for one instruction set. All of them give the same digits:
/// every lane does the same IEEE operations in the same order, and none of them is fused.
struct FastKernel {
  const char* name;   ///< "avx512", "avx2", "baseline"
  std::size_t lanes;  ///< impacts at a time
  KernelFunction* simulate;
};

/// The kernels that this machine can run, the widest first.
const std::vector<FastKernel>& fast_kernels();

}  // namespace recoil
