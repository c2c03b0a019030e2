// Compiled once for every instruction set (see CMakeLists.txt), each time with its own
// RECOIL_KERNEL and RECOIL_LANES. No two of them have the same number of lanes: the templates are
// then of different types, and the linker cannot mistake a function that was compiled for one
// instruction set for that of another (tests/impact/kernel_symbols.sh looks at the symbols).
#include <experimental/simd>

#include "impact/flights.hpp"
#include "impact/force_law.hpp"

namespace recoil::RECOIL_KERNEL {

using Pack = std::experimental::fixed_size_simd<double, RECOIL_LANES>;

void fly_with_dashpot(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                      std::span<ImpactResult> results);
void fly_by_jkr(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                std::span<ImpactResult> results);
void fly_by_dmt(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                std::span<ImpactResult> results);

std::size_t lanes() { return RECOIL_LANES; }

void fly(std::span<const ImpactGroups> groups, const ImpactOptions& options,
         std::span<ImpactResult> results) {
  if (options.adhesion == AdhesionLaw::jkr) {
    fly_by_jkr(groups, options, results);
  } else if (options.adhesion == AdhesionLaw::dmt) {
    fly_by_dmt(groups, options, results);
  } else if (options.dashpot) {
    fly_with_dashpot(groups, options, results);
  } else if (options.gradient) {
    Flights<RingAdhesionLaw, Pack, true>(groups, options, results).fly();
  } else {
    Flights<RingAdhesionLaw, Pack, false>(groups, options, results).fly();
  }
}

}  // namespace recoil::RECOIL_KERNEL
