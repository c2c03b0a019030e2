#include "uncertainty/parameter_intervals.hpp"

#include <algorithm>
#include <utility>

#include "core/parallel.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/profile.hpp"
#include "uncertainty/recommend.hpp"

namespace recoil {
namespace {

/// Percentile, BCa and studentized intervals of slot j; no intervals when too many refits failed.
void add_resampled(const FitResult& fitted, const BootstrapResult& boot, std::size_t j,
                   const std::vector<std::vector<double>>& delete_one, double level,
                   IntervalSet& set) {
  if (boot.withheld()) {
    for (const IntervalKind kind :
         {IntervalKind::percentile, IntervalKind::bca, IntervalKind::studentized}) {
      set[kind] = no_interval(NoInterval::refits_failed);
    }
    return;
  }
  const ParameterSlot& slot = fitted.model.slots[j];
  const std::vector<double> replicates = finite_column(boot.theta, j);
  const std::vector<double> without_one = finite_column(delete_one, j);
  set[IntervalKind::percentile] = percentile_interval(replicates, level);
  set[IntervalKind::bca] = bca_interval(replicates, fitted.theta[j], without_one, level);
  if (!replicates.empty() && !without_one.empty()) {
    set.bca_constants = bca_constants(replicates, fitted.theta[j], without_one);
  }
  set[IntervalKind::studentized] =
      studentized_interval(replicates, finite_column(boot.std_error, j), fitted.theta[j],
                           boot.reference_error[j], level, slot.lower, slot.upper);
  set.bound_share = bound_share(boot, slot, j);
}

}  // namespace

std::vector<IntervalSet> likelihood_intervals(const std::vector<NoiseAlternative>& alternatives,
                                              double level, int threads) {
  const FitResult& fitted = alternatives.front().fitted;
  std::vector<IntervalSet> sets(fitted.theta.size());
  parallel_over(sets.size(), threads, [&](std::size_t j) {
    IntervalSet& set = sets[j];
    const bool free = fitted.model.slots[j].free;
    if (std::find(fitted.flat.begin(), fitted.flat.end(), j) != fitted.flat.end()) {
      for (const IntervalKind kind : values_of<IntervalKind>()) {
        set[kind] = no_interval(NoInterval::no_standard_error);
      }
      return;
    }
    if (!free || !fitted.data.noise.known) {
      for (const IntervalKind kind : values_of<IntervalKind>()) {
        set[kind] = no_interval(free ? NoInterval::noise_unknown : NoInterval::fixed);
      }
      return;
    }
    set[IntervalKind::wald] = wald_over_noise(alternatives, j, level);
    set[IntervalKind::profile] = profile_interval(fitted, j, level);
  });
  return sets;
}

void add_profile_curves(const FitResult& fitted, double level, int threads,
                        std::vector<IntervalSet>& sets) {
  parallel_over(sets.size(), threads, [&](std::size_t j) {
    if (!fitted.model.slots[j].free || !fitted.data.noise.known) return;
    sets[j].profile_curve = profile_curve(fitted, j, level, sets[j][IntervalKind::profile]);
  });
}

void add_resampled_intervals(const FitResult& fitted, const BootstrapResult& replicates,
                             double level, int threads, std::vector<IntervalSet>& sets) {
  const auto& slots = fitted.model.slots;
  const bool sd_stated = fitted.data.sd_stated;
  std::vector<std::vector<double>> delete_one;
  if (!replicates.theta.empty()) {
    delete_one = jackknife(plan_resampling(fitted, replicates.scheme), threads);
  }
  for (std::size_t j = 0; j < slots.size(); ++j) {
    IntervalSet& set = sets[j];
    if (slots[j].free && fitted.data.noise.known)
      add_resampled(fitted, replicates, j, delete_one, level, set);
    for (const IntervalKind kind : values_of<IntervalKind>()) note_bounds(set[kind], slots[j]);
    recommend(set, sd_stated);
  }
  for (std::size_t j = 0; j < slots.size(); ++j) {
    if (!slots[j].free) continue;
    sets[j].disagreement = explain_disagreement(fitted, j, sets, level);
  }
}

std::optional<ConditionalFit> conditional_fit(const FitResult& fitted, double level, int threads) {
  if (fitted.model.constants.empty()) return std::nullopt;
  FitResult exact = fit(with_exact_materials(fitted.model), fitted.data);
  if (!exact.usable) return std::nullopt;
  std::vector<IntervalSet> intervals =
      likelihood_intervals(noise_alternatives(exact), level, threads);
  return ConditionalFit{std::move(exact), std::move(intervals)};
}

}  // namespace recoil
