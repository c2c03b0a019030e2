// Compiled once for every instruction set (see CMakeLists.txt), each time with its own
// RECOIL_KERNEL and RECOIL_LANES. The numbers of lanes differ, so that the templates have different
// types and the linker cannot replace a function for one instruction set by that for another
// (tests/impact/kernel_symbols.sh checks the symbols).
#include "impact/fast_kernel.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "impact/lanes.hpp"
#include "impact/laws.hpp"
#include "impact/phase_solver.hpp"
#include "impact/step_solver.hpp"
#include "impact/with_dashpot.hpp"

namespace recoil::RECOIL_KERNEL {
namespace {

using Pack = Lanes<RECOIL_LANES>;  // one register

constexpr std::size_t batch = 1024;

/// Indices of impacts, without heap memory.
struct Order {
  std::array<std::uint32_t, batch> entries;
  std::size_t size = 0;

  void add(std::uint32_t entry) { entries[size++] = entry; }
  std::span<const std::uint32_t> all() const { return {entries.data(), size}; }
  std::span<const std::uint32_t> some(std::size_t first, std::size_t at_most) const {
    return all().subspan(first, std::min(at_most, size - first));
  }
};

/// Solves the impacts of `order` with the nodes for `need`; adds those that fail to `failed`.
template <class Solver>
void solve_phases(Solver& solver, PhaseNeed need, std::span<const ImpactGroups> groups,
                  const Order& order, std::span<const CoarseImpact> coarse,
                  std::span<ImpactResult> results, Order& failed) {
  for (std::size_t first = 0; first < order.size; first += Solver::lanes) {
    const auto some = order.some(first, Solver::lanes);
    const auto done = solver.solve(need, groups, some, coarse, results);
    for (std::size_t lane = 0; lane < some.size(); ++lane) {
      if (!done[lane]) failed.add(some[lane]);
    }
  }
}

/// Solves the impacts of `order` phase by phase, in groups that need the same number of nodes. Adds
/// those that fail to `left`.
template <class Law>
void solve_phases(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                  const Order& order, std::span<ImpactResult> results, Order& left) {
  using Solver = PhaseSolver<Law, Pack>;
  Solver solver(options);
  std::array<CoarseImpact, batch> coarse;
  for (std::size_t first = 0; first < order.size; first += Solver::lanes) {
    solver.solve_coarsely(groups, order.some(first, Solver::lanes), coarse);
  }
  Order smooth, fine, captured;
  for (const std::uint32_t entry : order.all()) {
    switch (coarse[entry].need) {
      case PhaseNeed::smooth:
        smooth.add(entry);
        break;
      case PhaseNeed::fine:
        fine.add(entry);
        break;
      case PhaseNeed::capture:
        captured.add(entry);
        break;
    }
  }
  solve_phases(solver, PhaseNeed::smooth, groups, smooth, coarse, results, fine);
  solve_phases(solver, PhaseNeed::fine, groups, fine, coarse, results, left);
  solve_phases(solver, PhaseNeed::capture, groups, captured, coarse, results, left);
}

/// Integrates the impacts of `order` by steps. The law scales the tolerance of a step.
template <class Law, bool with_gradient>
void solve_steps(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                 const Order& order, std::span<ImpactResult> results) {
  if (order.size == 0) return;
  ImpactOptions tighter = options;
  tighter.fast_tolerance *= Law::tolerance_share;
  StepSolver<Law, Pack, with_gradient>(groups, order.all(), tighter, results).solve();
}

template <class Law>
void solve_batch(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                 std::span<ImpactResult> results) {
  Order all, left;
  // StepSolver solves impacts with a dashpot, with a seam of the law (LawPath::seam), and with
  // strong damping under a steep law: there the slope in beta had errors of 1e-7 and more.
  constexpr bool by_phases = Law::places.back() != place_of_kappa;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const bool by_steps =
        !by_phases || Law::path_of(groups[i]).seam ||
        (Law::tolerance_share < 1.0 && groups[i].alpha + groups[i].gamma * groups[i].beta > 0.25);
    (by_steps ? left : all).add(static_cast<std::uint32_t>(i));
  }
  if constexpr (by_phases) solve_phases<Law>(groups, options, all, results, left);
  const auto solve_left = options.gradient ? solve_steps<Law, true> : solve_steps<Law, false>;
  solve_left(groups, options, left, results);
}

template <class Law>
void simulate_under(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                    std::span<ImpactResult> results) {
  for (std::size_t first = 0; first < groups.size(); first += batch) {
    const std::size_t count = std::min(batch, groups.size() - first);
    solve_batch<Law>(groups.subspan(first, count), options, results.subspan(first, count));
  }
}

}  // namespace

std::size_t lanes() { return RECOIL_LANES; }

void simulate(std::span<const ImpactGroups> groups, const ImpactOptions& options,
              std::span<ImpactResult> results) {
  with_law(options.adhesion, [&]<class Law>() {
    if constexpr (Law::has_dashpot) {
      if (options.dashpot) return simulate_under<WithDashpot<Law>>(groups, options, results);
    }
    simulate_under<Law>(groups, options, results);
  });
}

}  // namespace recoil::RECOIL_KERNEL
