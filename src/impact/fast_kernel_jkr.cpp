// A further law of fast_kernel.cpp, compiled like it; apart, so that they compile at the same time.
#include <experimental/simd>

#include "impact/flights.hpp"
#include "impact/jkr_law.hpp"

namespace recoil::RECOIL_KERNEL {

using Pack = std::experimental::fixed_size_simd<double, RECOIL_LANES>;

void fly_by_jkr(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                std::span<ImpactResult> results) {
  // The path is longer than that of the ring law: out to where the contact parts.
  ImpactOptions tighter = options;
  tighter.fast_tolerance *= 0.1;
  if (options.gradient) {
    Flights<JkrLaw, Pack, true>(groups, tighter, results).fly();
  } else {
    Flights<JkrLaw, Pack, false>(groups, tighter, results).fly();
  }
}

}  // namespace recoil::RECOIL_KERNEL
