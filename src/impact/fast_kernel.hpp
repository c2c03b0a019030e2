#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "impact/impact.hpp"

namespace recoil {

/// Fills outcome, restitution_squared, steps and, if requested, the gradient of every impact. The
/// caller solves impacts whose outcome is not usable() by the reference solver.
using KernelFunction = void(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                            std::span<ImpactResult> results);

// One per instruction set, all compiled from fast_kernel.cpp. CMakeLists.txt decides whether the
// last two exist.
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

/// The inner loop of the fast solver for one instruction set. All kernels give the same digits,
/// because every lane does the same IEEE operations in the same order, without fused ones.
struct FastKernel {
  const char* name;   ///< "avx512", "avx2", "baseline"
  std::size_t lanes;  ///< impacts at a time
  KernelFunction* simulate;
};

/// The kernels that this machine can run, the widest first.
const std::vector<FastKernel>& fast_kernels();

}  // namespace recoil
