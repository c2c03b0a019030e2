#include "uncertainty/parameter_intervals.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics.hpp"
#include "core/parallel.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/profile.hpp"

namespace recoil {

namespace {

Interval checked(const FitResult& fitted, std::size_t j, const Interval& interval) {
  const ParameterSlot& slot = fitted.model.slots[j];
  return with_both_arms(interval, fitted.theta[j], slot.lower, slot.upper);
}

/// Percentile, BCa and studentized intervals of slot j; no intervals if too many refits failed.
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
  set[IntervalKind::percentile] = checked(fitted, j, percentile_interval(replicates, level));
  set[IntervalKind::bca] =
      checked(fitted, j, bca_interval(replicates, fitted.theta[j], without_one, level));
  if (!replicates.empty() && !without_one.empty()) {
    set.bca_constants = bca_constants(replicates, fitted.theta[j], without_one);
  }
  set[IntervalKind::studentized] =
      checked(fitted, j,
              studentized_interval(replicates, finite_column(boot.std_error, j), fitted.theta[j],
                                   boot.reference_error[j], level, slot.lower, slot.upper));
  set.bound_share = bound_share(boot, slot, j);
}

/// The distances of the ends of an interval from the estimate.
struct Arms {
  double down = 0.0, up = 0.0;
};

/// The profile interval averaged over the alternatives: its ends have the averaged tail areas
/// (Turek & Fletcher 2012, see `averaged_wald_interval`). Under each alternative the distribution
/// has two halves, which have the arms of its profile; an alternative without one, or with a weight
/// of less than `own_profile`, has those of the first, in its standard errors.
Interval averaged_profile(const std::vector<FitAlternative>& alternatives, std::size_t j,
                          double level) {
  constexpr double own_profile = 0.1;
  const FitResult& first = alternatives.front().fitted();
  const ParameterSlot& slot = first.model.slots[j];
  Interval interval = profile_interval(first, j, level);
  if (alternatives.size() == 1 || !interval.available()) return interval;
  const Arms of_first = {first.theta[j] - *interval.lower, *interval.upper - first.theta[j]};
  struct Half {
    double weight, middle;
    Arms arms;
    int dof;
  };
  std::vector<Half> terms;
  double sum = 0.0;
  double least = *interval.lower;
  double most = *interval.upper;
  for (std::size_t k = 0; k < alternatives.size(); ++k) {
    const FitResult& other = alternatives[k].fitted();
    Arms arms = of_first;
    const double ratio = first.std_error[j] > 0.0 ? other.std_error[j] / first.std_error[j] : 0.0;
    Interval own;
    if (k > 0 && (alternatives[k].weight >= own_profile || !(ratio > 0.0))) {
      own = profile_interval(other, j, level);
    }
    if (own.available()) {
      arms = {other.theta[j] - *own.lower, *own.upper - other.theta[j]};
    } else if (k > 0) {
      if (!(ratio > 0.0)) continue;
      arms = {ratio * arms.down, ratio * arms.up};
    }
    terms.push_back({alternatives[k].weight, other.theta[j], arms, degrees_of_freedom(other, j)});
    sum += alternatives[k].weight;
    least = std::min(least, other.theta[j] - arms.down);
    most = std::max(most, other.theta[j] + arms.up);
  }
  const auto end = [&](double p) {
    const auto excess = [&](double value) {
      double below = 0.0;
      for (const Half& term : terms) {
        const double arm = value < term.middle ? term.arms.down : term.arms.up;
        const double z =
            arm > 0.0 ? (value - term.middle) / arm : std::copysign(INFINITY, value - term.middle);
        below += term.weight / sum *
                 student_probability(z * student_quantile(0.5 + level / 2.0, term.dof), term.dof);
      }
      return below - p;
    };
    if (!(excess(least) < 0.0)) return least;
    if (!(excess(most) > 0.0)) return most;
    return find_root(excess, least, most);
  };
  interval.lower = std::max(slot.lower, end(0.5 - level / 2.0));
  interval.upper = std::min(slot.upper, end(0.5 + level / 2.0));
  const bool low = *interval.lower <= slot.lower;
  const bool high = *interval.upper >= slot.upper;
  interval.shape = low && high   ? ProfileShape::flat
                   : low || high ? ProfileShape::one_sided
                                 : ProfileShape::bounded;
  return interval;
}

}  // namespace

std::vector<IntervalSet> likelihood_intervals(const std::vector<FitAlternative>& alternatives,
                                              double level, int threads) {
  const FitResult& fitted = alternatives.front().fitted();
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
    if (!free || !fitted.weights.noise.known) {
      for (const IntervalKind kind : values_of<IntervalKind>()) {
        set[kind] = no_interval(free ? NoInterval::noise_unknown : NoInterval::fixed);
      }
      return;
    }
    set[IntervalKind::wald] = checked(fitted, j, averaged_wald(alternatives, j, level));
    set[IntervalKind::profile] = checked(fitted, j, averaged_profile(alternatives, j, level));
  });
  return sets;
}

void add_profile_curves(const FitResult& fitted, double level, int threads,
                        std::vector<IntervalSet>& sets) {
  parallel_over(sets.size(), threads, [&](std::size_t j) {
    if (!fitted.model.slots[j].free || !fitted.weights.noise.known) return;
    sets[j].profile_curve = profile_curve(fitted, j, level, sets[j][IntervalKind::profile]);
  });
}

void add_resampled_intervals(const FitResult& fitted, const BootstrapResult& replicates,
                             double level, int threads, std::vector<IntervalSet>& sets) {
  const auto& slots = fitted.model.slots;
  const bool sd_stated = fitted.data.noise.sd_stated;
  std::vector<std::vector<double>> delete_one;
  if (!replicates.theta.empty()) {
    delete_one = jackknife(plan_resampling(fitted, replicates.scheme), threads);
  }
  for (std::size_t j = 0; j < slots.size(); ++j) {
    IntervalSet& set = sets[j];
    if (slots[j].free && fitted.weights.noise.known)
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
      likelihood_intervals(fit_alternatives(exact), level, threads);
  return ConditionalFit{std::move(exact), std::move(intervals)};
}

namespace {

// Smallest difference reported, over the recommended width.
constexpr double clear_difference = 0.15;
constexpr double many_at_bound = 0.05;
constexpr double coupled = 0.5;  // correlation above which another parameter's bound matters
constexpr double clear_acceleration = 0.05;
constexpr double clear_bias = 0.15;
constexpr double clear_asymmetry = 1.25;
constexpr double clear_student = 1.1;

/// The larger distance of the two ends from those of `reference`, minus two Monte-Carlo errors,
/// over the width of `reference`.
double difference(const Interval& interval, const Interval& reference) {
  const double width = *reference.upper - *reference.lower;
  if (!(width > 0.0)) return 0.0;
  const double low =
      std::abs(*interval.lower - *reference.lower) -
      2.0 * (interval.lower_error.value_or(0.0) + reference.lower_error.value_or(0.0));
  const double high =
      std::abs(*interval.upper - *reference.upper) -
      2.0 * (interval.upper_error.value_or(0.0) + reference.upper_error.value_or(0.0));
  return std::max(low, high) / width;
}

/// Correlation of two free parameters; 0 if either has no standard error.
double correlation_of(const FitResult& fitted, std::size_t a, std::size_t b) {
  const double scale = fitted.std_error[a] * fitted.std_error[b];
  if (fitted.covariance.empty() || !(scale > 0.0)) return 0.0;
  return fitted.covariance[a * fitted.theta.size() + b] / scale;
}

std::optional<Disagreement::OnBound> replicates_on_bound(const FitResult& fitted, std::size_t slot,
                                                         const std::vector<IntervalSet>& sets) {
  const double own = sets[slot].bound_share.value_or(0.0);
  if (own > many_at_bound) return Disagreement::OnBound{slot, own, 1.0};
  for (std::size_t j = 0; j < sets.size(); ++j) {
    const double share = sets[j].bound_share.value_or(0.0);
    const double r = j == slot ? 0.0 : correlation_of(fitted, slot, j);
    if (share > many_at_bound && std::abs(r) > coupled) return Disagreement::OnBound{j, share, r};
  }
  return std::nullopt;
}

std::optional<Disagreement::Ridge> ridge_of(const FitResult& fitted, std::size_t slot) {
  Disagreement::Ridge ridge{slot, 0.0};
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const double r = j == slot ? 0.0 : correlation_of(fitted, slot, j);
    if (std::abs(r) > std::abs(ridge.correlation)) ridge = {j, r};
  }
  if (std::abs(ridge.correlation) <= strong_correlation) return std::nullopt;
  return ridge;
}

/// See `Disagreement::arms`.
std::optional<double> skewed_arms(const Interval& profile, double estimate) {
  if (!profile.available() || profile.shape != ProfileShape::bounded) return std::nullopt;
  const double up = *profile.upper - estimate;
  const double down = estimate - *profile.lower;
  if (!(down > 0.0)) return std::nullopt;
  if (up / down > clear_asymmetry || down / up > clear_asymmetry) return up / down;
  return std::nullopt;
}

std::optional<Disagreement::FewPoints> few_points_of(const FitResult& fitted, double level) {
  if (fitted.quantile_dof == 0) return std::nullopt;
  const double p = 0.5 + level / 2.0;
  const double ratio = gsl_cdf_tdist_Pinv(p, fitted.quantile_dof) / gsl_cdf_ugaussian_Pinv(p);
  if (ratio <= clear_student) return std::nullopt;
  return Disagreement::FewPoints{fitted.quantile_dof, ratio};
}

}  // namespace

void recommend(IntervalSet& set, bool sd_stated) {
  set.student = !sd_stated;
  for (const IntervalKind kind :
       {IntervalKind::profile, IntervalKind::percentile, IntervalKind::wald}) {
    set.recommended = kind;
    if (set[kind].available()) return;
  }
}

std::optional<Disagreement> explain_disagreement(const FitResult& fitted, std::size_t slot,
                                                 const std::vector<IntervalSet>& sets,
                                                 double level) {
  const IntervalSet& set = sets[slot];
  const Interval& reference = recommended_interval(set);
  if (!reference.available()) return std::nullopt;
  Disagreement found;
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    if (!set[kind].available()) continue;
    const double by = difference(set[kind], reference);
    if (by > clear_difference) found.differing.push_back({kind, by});
  }
  if (found.differing.empty()) return std::nullopt;
  found.estimate_at_bound = fitted.at_bound[slot];
  if (!found.estimate_at_bound) found.on_bound = replicates_on_bound(fitted, slot, sets);
  found.ridge = ridge_of(fitted, slot);
  if (set.bca_constants) {
    const auto [bias, acceleration] = *set.bca_constants;
    if (std::abs(acceleration) > clear_acceleration) found.acceleration = acceleration;
    if (std::abs(bias) > clear_bias) found.bias = bias;
  }
  found.arms = skewed_arms(set[IntervalKind::profile], fitted.theta[slot]);
  found.few_points = few_points_of(fitted, level);
  return found;
}

std::optional<double> bound_share(const BootstrapResult& boot, const ParameterSlot& slot,
                                  std::size_t index) {
  if (boot.theta.empty()) return std::nullopt;
  std::size_t resting = 0;
  for (const std::vector<double>& theta : boot.theta) {
    if (theta[index] <= slot.lower || theta[index] >= slot.upper) ++resting;
  }
  return static_cast<double>(resting) / static_cast<double>(boot.theta.size());
}

void note_bounds(Interval& interval, const ParameterSlot& slot) {
  if (!interval.available()) return;
  const bool low = *interval.lower <= slot.lower;
  const bool high = *interval.upper >= slot.upper;
  if (low && high) {
    interval.note = {Caution::spans_both_bounds, slot.lower};
  } else if (low) {
    interval.note = {Caution::begins_at_bound, slot.lower};
  } else if (high) {
    interval.note = {Caution::ends_at_bound, slot.upper};
  }
}

}  // namespace recoil
