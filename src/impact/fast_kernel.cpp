// Compiled once for every instruction set (see CMakeLists.txt), each time with its own
// RECOIL_KERNEL and RECOIL_LANES. No two of them have the same number of lanes: the templates are
// then of different types, and the linker cannot mistake a function that was compiled for one
// instruction set for that of another (tests/impact/kernel_symbols.sh looks at the symbols).
#include "impact/fast_kernel.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <experimental/simd>

#include "impact/dmt_law.hpp"
#include "impact/flights.hpp"
#include "impact/force_law.hpp"
#include "impact/jkr_law.hpp"
#include "impact/maugis_law.hpp"
#include "impact/phases.hpp"
#include "impact/with_dashpot.hpp"

namespace recoil::RECOIL_KERNEL {
namespace {

/// A register's own type: of fixed_size_simd, which would do as well, max and min are calls.
using Pack =
    std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, RECOIL_LANES>>;

constexpr std::size_t batch = 1024;

/// Indices of impacts, without memory of the heap.
struct Order {
  std::array<std::uint32_t, batch> entries;
  std::size_t size = 0;

  void add(std::uint32_t entry) { entries[size++] = entry; }
  std::span<const std::uint32_t> all() const { return {entries.data(), size}; }
  std::span<const std::uint32_t> some(std::size_t first, std::size_t at_most) const {
    return all().subspan(first, std::min(at_most, size - first));
  }
};

/// The impacts of `order` by Phases; those that are not done go to `others`.
template <std::size_t nodes, PhaseEnd end, class Solver>
void try_phases(Solver& solver, std::span<const ImpactGroups> groups, const Order& order,
                std::span<const typename Solver::Sketch> sketches, std::span<ImpactResult> results,
                Order& others) {
  for (std::size_t first = 0; first < order.size; first += Solver::lanes) {
    const auto some = order.some(first, Solver::lanes);
    const auto done = solver.template fly<nodes, end>(groups, some, sketches, results);
    for (std::size_t lane = 0; lane < some.size(); ++lane) {
      if (!done[lane]) others.add(some[lane]);
    }
  }
}

/// The impacts of `order` by Phases, those that need the same together; who is not done is `left`.
template <class Solver>
void fly_phases(Solver solver, std::span<const ImpactGroups> groups, const Order& order,
                std::span<ImpactResult> results, Order& left) {
  std::array<typename Solver::Sketch, batch> sketches;
  for (std::size_t first = 0; first < order.size; first += Solver::lanes) {
    solver.sketch(groups, order.some(first, Solver::lanes), sketches);
  }
  Order smooth, difficult, captured;
  for (const std::uint32_t entry : order.all()) {
    switch (sketches[entry].outlook) {
      case Solver::Outlook::smooth:
        smooth.add(entry);
        break;
      case Solver::Outlook::difficult:
        difficult.add(entry);
        break;
      case Solver::Outlook::captured:
        captured.add(entry);
        break;
    }
  }
  try_phases<16, PhaseEnd::release>(solver, groups, smooth, sketches, results, difficult);
  try_phases<24, PhaseEnd::release>(solver, groups, difficult, sketches, results, left);
  try_phases<24, PhaseEnd::outer_turning_point>(solver, groups, captured, sketches, results, left);
}

/// The law decides what a step may err: the path of JKR is longer, out to where the contact parts.
template <class Law, bool with_gradient>
void fly_batch(std::span<const ImpactGroups> groups, const ImpactOptions& options,
               std::span<ImpactResult> results) {
  Order all, left;
  // A dashpot and a seam of the law (LawPath::seam) are for Flights alone; and strong damping where
  // the law is steep: above 0.5 the slope in beta had errors of 1e-7 and more.
  constexpr bool by_phases = Law::places.back() != 3;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const bool apart =
        !by_phases || Law::path_of(groups[i]).seam ||
        (Law::tolerance_share < 1.0 && groups[i].alpha + groups[i].gamma * groups[i].beta > 0.25);
    (apart ? left : all).add(static_cast<std::uint32_t>(i));
  }
  if constexpr (by_phases) {
    using Solver = Phases<Law, Pack, with_gradient>;
    fly_phases(Solver(options.phase, options.fast_tolerance), groups, all, results, left);
  }
  if (left.size == 0) return;
  ImpactOptions flight = options;
  flight.fast_tolerance *= Law::tolerance_share;
  Flights<Law, Pack, with_gradient>(groups, left.all(), flight, results).fly();
}

template <class Law>
void fly_under(std::span<const ImpactGroups> groups, const ImpactOptions& options,
               std::span<ImpactResult> results) {
  for (std::size_t first = 0; first < groups.size(); first += batch) {
    const std::size_t count = std::min(batch, groups.size() - first);
    const auto fly = options.gradient ? fly_batch<Law, true> : fly_batch<Law, false>;
    fly(groups.subspan(first, count), options, results.subspan(first, count));
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
      return fly_under<MaugisLaw>(groups, options, results);
  }
}

}  // namespace recoil::RECOIL_KERNEL
