#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "impact/creep_limit.hpp"
#include "impact/fast_kernel.hpp"
#include "impact/impact.hpp"
#include "impact/law_lanes.hpp"
#include "impact/laws.hpp"

namespace recoil {
namespace {

/// True if the kernel gives the digits of `baseline` for a rebound, a capture and a strongly damped
/// impact. This guards against errors of compilers with wide registers.
bool agrees_with(const FastKernel& baseline, const FastKernel& kernel) {
  std::array<ImpactGroups, 3> impacts = {ImpactGroups{0.01, 0.1, 0.4, 0.0, 0.4},
                                         ImpactGroups{0.02, 3.0, 0.02, 0.0, 2.0},
                                         ImpactGroups{2.0, 0.4, 1.5, 0.0, 20.0}};
  const auto same = [](const ImpactResult& a, const ImpactResult& b) {
    return a.outcome == b.outcome && a.restitution_squared == b.restitution_squared &&
           a.gradient == b.gradient;
  };
  ImpactOptions options;
  options.gradient = true;
  const auto agrees = [&] {
    std::array<ImpactResult, impacts.size()> expected, found;
    baseline.simulate(impacts, options, expected);
    kernel.simulate(impacts, options, found);
    return std::equal(expected.begin(), expected.end(), found.begin(), same);
  };
  for (const double kappa : {0.0, 0.1}) {
    options.dashpot = kappa > 0.0;
    for (ImpactGroups& impact : impacts) impact.kappa = kappa;
    for (const AdhesionLaw law : values_of<AdhesionLaw>()) {
      if (options.dashpot && !traits(law).has_dashpot) continue;
      options.adhesion = law;
      if (!agrees()) return false;
    }
  }
  return true;
}

/// True if a sphere creeps into the well of `Law`, see CreepLimit. The ring and JKR laws know more.
/// A sphere that does not reach the bottom on its way in is always pulled inward.
template <class Law>
bool creeps(const ImpactGroups& groups, const LawPath& path) {
  if constexpr (requires { Law::overdamped(groups); }) {
    return Law::overdamped(groups);
  } else {
    return CreepLimit<Law>(groups, path).is_certain(path.deepest, 0.0);
  }
}

/// The same where elastic force and dashpot together never pull.
template <class Law>
bool creeps_behind_dashpot(const ImpactGroups& groups) {
  constexpr double strong = 12.0;
  if constexpr (Law::has_dashpot) {
    if (!Law::holds(groups)) return false;
    if (groups.kappa > strong) return true;
    if constexpr (requires { Law::overdamped(groups); }) return Law::overdamped(groups);
  }
  return false;
}

/// Sets the result of a sphere that creeps into the well of `Law`: e^2 is twice the depth. Returns
/// false for any other sphere.
template <class Law>
bool rests_at_once(const ImpactGroups& groups, const ImpactOptions& options, ImpactResult& result) {
  const LawPath path = Law::path_of(groups);
  if (options.never_pulls && groups.kappa > 0.0) {
    if (!creeps_behind_dashpot<Law>(groups)) return false;
  } else if (!creeps<Law>(groups, path)) {
    return false;
  }
  LawLanes<Law, std::array<double, 1>> law;
  law.set(0, groups);
  if constexpr (Law::constants > 0) law.constants.back() = {0.0};
  constexpr auto no_area = [](unsigned) { return 0.0; };
  law.write(0, groups, path.resting, 0.0, true, no_area, result);
  return true;
}

/// Sets `result` and returns true if it is known without integration.
bool closed_form_result(const ImpactGroups& groups, const ImpactOptions& options,
                        ImpactResult& result) {
  if (!is_admissible(groups, options)) {
    result.outcome = ImpactOutcome::integration_failure;
    return true;
  }
  if (const auto simpler = without_adhesion(groups, options)) {
    result = simulate_impact_fast(simpler->first, simpler->second);
    result.gradient[1] = 0.0;
    return true;
  }
  return with_law(options.adhesion,
                  [&]<class Law>() { return rests_at_once<Law>(groups, options, result); });
}

long simulate_run(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                  std::span<ImpactResult> results) {
  fast_kernels().front().simulate(groups, options, results);
  long handed_over = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (results[i].usable() && std::isfinite(results[i].restitution_squared)) continue;
    ++handed_over;
    results[i] = simulate_impact(groups[i], options);
  }
  return handed_over;
}

}  // namespace

const std::vector<FastKernel>& fast_kernels() {
  static const std::vector<FastKernel> kernels = [] {
    std::vector<FastKernel> list;
#ifdef RECOIL_AVX512_KERNEL
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")) {
      list.push_back({"avx512", avx512::lanes(), avx512::simulate});
    }
#endif
#ifdef RECOIL_AVX2_KERNEL
    if (__builtin_cpu_supports("avx2")) list.push_back({"avx2", avx2::lanes(), avx2::simulate});
#endif
    list.push_back({"baseline", baseline::lanes(), baseline::simulate});
    const FastKernel baseline_kernel = list.back();
    std::erase_if(list,
                  [&](const FastKernel& kernel) { return !agrees_with(baseline_kernel, kernel); });
    return list;
  }();
  return kernels;
}

long simulate_impacts_fast(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                           std::span<ImpactResult> results) {
  assert(!options.budget && results.size() == groups.size());
  // Consecutive impacts that need integration are simulated together.
  std::size_t begin = 0;
  long handed_over = 0;
  for (std::size_t i = 0; i <= groups.size(); ++i) {
    if (i < groups.size()) {
      results[i] = ImpactResult{};
      if (!closed_form_result(groups[i], options, results[i])) continue;
    }
    if (i > begin)
      handed_over += simulate_run(groups.subspan(begin, i - begin), options,
                                  results.subspan(begin, i - begin));
    begin = i + 1;
  }
  return handed_over;
}

ImpactResult simulate_impact_fast(const ImpactGroups& groups, const ImpactOptions& options) {
  ImpactResult result;
  simulate_impacts_fast({&groups, 1}, options, {&result, 1});
  return result;
}

}  // namespace recoil
