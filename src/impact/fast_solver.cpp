#include "impact/fast_solver.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include "impact/fast_kernel.hpp"
#include "impact/force_law.hpp"

namespace recoil {

namespace {

std::atomic<long> handovers{0};

bool admissible(const ImpactGroups& g) {
  return std::isfinite(g.alpha) && std::isfinite(g.beta) && std::isfinite(g.gamma) &&
         g.alpha >= 0.0 && g.beta >= 0.0 && g.gamma >= 0.0;
}

/// What is known without flying: true when `result` holds the answer.
bool answer_at_once(const ImpactGroups& groups, ImpactResult& result) {
  if (!admissible(groups)) {
    result.outcome = ImpactOutcome::integration_failure;
    return true;
  }
  if (!creeps_into_the_well(groups)) return false;
  result.outcome = ImpactOutcome::captured;
  result.restitution_squared = 2.0 * well_depth(groups.beta);
  result.gradient[1] = 2.5 * result.restitution_squared / groups.beta;
  return true;
}

long fly_some(std::span<const ImpactGroups> groups, const ImpactOptions& options,
              std::span<ImpactResult> results) {
  fast_kernels().front().fly(groups, options, results);
  long handed_over = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (results[i].usable() && std::isfinite(results[i].restitution_squared)) continue;
    ++handed_over;
    results[i] = simulate_impact(groups[i], options);
  }
  handovers += handed_over;
  return handed_over;
}

}  // namespace

const std::vector<FastKernel>& fast_kernels() {
  static const std::vector<FastKernel> kernels = [] {
    std::vector<FastKernel> list;
#ifdef RECOIL_X86_64_KERNELS
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")) {
      list.push_back({"avx512", avx512::lanes(), avx512::fly});
    }
    if (__builtin_cpu_supports("avx2")) list.push_back({"avx2", avx2::lanes(), avx2::fly});
#endif
    list.push_back({"baseline", baseline::lanes(), baseline::fly});
    return list;
  }();
  return kernels;
}

long simulate_impacts_fast(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                           std::span<ImpactResult> results) {
  assert(!options.budget && results.size() == groups.size());
  // Runs of impacts between those that are answered at once fly together.
  std::size_t begin = 0;
  long handed_over = 0;
  for (std::size_t i = 0; i <= groups.size(); ++i) {
    if (i < groups.size()) {
      results[i] = ImpactResult{};
      if (!answer_at_once(groups[i], results[i])) continue;
    }
    if (i > begin)
      handed_over +=
          fly_some(groups.subspan(begin, i - begin), options, results.subspan(begin, i - begin));
    begin = i + 1;
  }
  return handed_over;
}

ImpactResult simulate_impact_fast(const ImpactGroups& groups, const ImpactOptions& options) {
  ImpactResult result;
  simulate_impacts_fast({&groups, 1}, options, {&result, 1});
  return result;
}

long reference_handovers() { return handovers; }

}  // namespace recoil
