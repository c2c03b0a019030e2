// Compiled once for every instruction set (see CMakeLists.txt), each time with its own
// RECOIL_KERNEL and RECOIL_LANES. No two of them have the same number of lanes: the templates are
// then of different types, and the linker cannot mistake a function that was compiled for one
// instruction set for that of another (tests/impact/kernel_symbols.sh looks at the symbols).
#include "impact/fast_kernel.hpp"

#include <experimental/simd>

#include "impact/dmt_law.hpp"
#include "impact/flights.hpp"
#include "impact/force_law.hpp"
#include "impact/jkr_law.hpp"
#include "impact/maugis_law.hpp"
#include "impact/with_dashpot.hpp"

namespace recoil::RECOIL_KERNEL {
namespace {

using Pack = std::experimental::fixed_size_simd<double, RECOIL_LANES>;

/// The law decides what a step may err: the path of JKR is longer, out to where the contact parts.
template <class Law>
void fly_under(std::span<const ImpactGroups> groups, ImpactOptions options,
               std::span<ImpactResult> results) {
  options.fast_tolerance *= Law::tolerance_share;
  if (options.gradient) {
    Flights<Law, Pack, true>(groups, options, results).fly();
  } else {
    Flights<Law, Pack, false>(groups, options, results).fly();
  }
}

template <class Law>
void fly_by(std::span<const ImpactGroups> groups, const ImpactOptions& options,
            std::span<ImpactResult> results) {
  if (options.dashpot) return fly_under<WithDashpot<Law>>(groups, options, results);
  fly_under<Law>(groups, options, results);
}

}  // namespace

std::size_t lanes() { return RECOIL_LANES; }

void fly(std::span<const ImpactGroups> groups, const ImpactOptions& options,
         std::span<ImpactResult> results) {
  switch (options.adhesion) {
    case AdhesionLaw::ring:
      return fly_by<RingAdhesionLaw>(groups, options, results);
    case AdhesionLaw::jkr:
      return fly_by<JkrLaw>(groups, options, results);
    case AdhesionLaw::dmt:
      return fly_by<DmtLaw>(groups, options, results);
    case AdhesionLaw::maugis:
      return fly_by<MaugisLaw>(groups, options, results);
  }
}

}  // namespace recoil::RECOIL_KERNEL
