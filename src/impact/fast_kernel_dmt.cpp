// A further law of fast_kernel.cpp, compiled like it; apart, so that they compile at the same time.
#include <experimental/simd>

#include "impact/dmt_law.hpp"
#include "impact/flights.hpp"

namespace recoil::RECOIL_KERNEL {

using Pack = std::experimental::fixed_size_simd<double, RECOIL_LANES>;

void fly_by_dmt(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                std::span<ImpactResult> results) {
  if (options.gradient) {
    Flights<DmtLaw, Pack, true>(groups, options, results).fly();
  } else {
    Flights<DmtLaw, Pack, false>(groups, options, results).fly();
  }
}

}  // namespace recoil::RECOIL_KERNEL
