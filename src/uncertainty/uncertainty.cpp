#include "uncertainty/uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/curves.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/noise_alternatives.hpp"
#include "uncertainty/profile.hpp"
#include "uncertainty/recommend.hpp"

namespace recoil {
namespace {

// `replicates = "auto"` begins with the first and ends with the last.
constexpr int fewest_automatic = 999;
constexpr int most_automatic = 19999;

std::vector<double> column(const std::vector<std::vector<double>>& rows, std::size_t j) {
  std::vector<double> values;
  for (const std::vector<double>& row : rows) {
    if (j < row.size() && std::isfinite(row[j])) values.push_back(row[j]);
  }
  return values;
}

/// NaN, which every writer shows as "none", for fewer than two values.
double standard_deviation(const std::vector<double>& values) {
  if (values.size() < 2) return std::nan("");
  double mean = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  double sum = 0.0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// The intervals that need no replicates: profile and Wald.
std::vector<IntervalSet> likelihood_intervals(const std::vector<NoiseAlternative>& alternatives,
                                              const UncertaintyOptions& options) {
  const FitResult& fitted = alternatives.front().fitted;
  std::vector<IntervalSet> sets(fitted.theta.size());
  parallel_over(sets.size(), options.threads, [&](std::size_t j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    IntervalSet& set = sets[j];
    if (!slot.free) {
      for (const IntervalKind kind : values_of<IntervalKind>()) {
        set[kind] = no_interval(NoInterval::fixed);
      }
      return;
    }
    set[IntervalKind::wald] = wald_over_noise(alternatives, j, options.level);
    if (options.profile) {
      Interval& profile = set[IntervalKind::profile];
      profile = profile_interval(fitted, j, options.level);
      if (options.curves) {
        set.profile_curve = profile_curve(fitted, j, options.level, profile);
      }
    } else {
      set[IntervalKind::profile] = no_interval(NoInterval::not_asked_for);
    }
  });
  return sets;
}

/// Percentile, BCa and studentized intervals of slot j; none when too many refits failed.
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
  const std::vector<double> replicates = column(boot.theta, j);
  const std::vector<double> without_one = column(delete_one, j);
  set[IntervalKind::percentile] = percentile_interval(replicates, level);
  set[IntervalKind::bca] = bca_interval(replicates, fitted.theta[j], without_one, level);
  if (!replicates.empty() && !without_one.empty()) {
    set.bca_constants = bca_constants(replicates, fitted.theta[j], without_one);
  }
  set[IntervalKind::studentized] =
      studentized_interval(replicates, column(boot.std_error, j), fitted.theta[j],
                           boot.reference_error[j], level, slot.lower, slot.upper);
  set.bound_share = bound_share(boot, slot, j);
}

/// The larger Monte-Carlo error of an interval's ends over its width; 0 where nothing is random.
double relative_error(const Interval& interval) {
  if (!interval.available()) return 0.0;
  const double width = *interval.upper - *interval.lower;
  const double error =
      std::max(interval.lower_error.value_or(0.0), interval.upper_error.value_or(0.0));
  return width > 0.0 ? error / width : 0.0;
}

/// The studentized interval of V* of the k-th size, on its logarithm.
Interval studentized_capture(const BootstrapResult& boot, std::size_t k, double value,
                             double level) {
  std::vector<double> logarithms;
  std::vector<double> errors;
  for (std::size_t i = 0; i < boot.capture_velocity.size(); ++i) {
    const double v = boot.capture_velocity[i][k];
    if (!(v > 0.0)) continue;
    logarithms.push_back(std::log(v / value));
    errors.push_back(boot.capture_error[i][k]);
  }
  Interval interval = studentized_interval(logarithms, errors, 0.0, boot.capture_reference_error[k],
                                           level, -INFINITY, INFINITY);
  for (auto* end : {&interval.lower, &interval.upper}) {
    if (*end) *end = value * std::exp(**end);
  }
  for (auto* error : {&interval.lower_error, &interval.upper_error}) {
    if (*error) *error = value * **error;
  }
  return interval;
}

/// What the replicates made so far say about the intervals.
void read_off(const FitResult& fitted, const std::vector<std::vector<double>>& delete_one,
              UncertaintyResult& result) {
  const UncertaintyOptions& options = result.options;
  BootstrapResult& boot = result.bootstrap;
  double worst = 0.0;
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    IntervalSet& set = result.intervals[j];
    if (slot.free) add_resampled(fitted, boot, j, delete_one, options.level, set);
    for (const IntervalKind kind : values_of<IntervalKind>()) note_bounds(set[kind], slot);
    recommend(set, fitted.data.sd_stated);
    if (!slot.free) continue;
    worst = std::max({worst, relative_error(set[IntervalKind::percentile]),
                      relative_error(recommended_interval(set))});
  }
  const auto& slots = fitted.model.slots;
  for (std::size_t j = 0; j < slots.size(); ++j) {
    if (!slots[j].free) continue;
    result.intervals[j].disagreement =
        explain_disagreement(fitted, j, result.intervals, fitted.data.sd_stated, options.level);
  }
  const bool nothing_free =
      std::none_of(slots.begin(), slots.end(), [](const ParameterSlot& slot) { return slot.free; });
  for (std::size_t k = 0; k < result.capture.size(); ++k) {
    CaptureEstimate& capture = result.capture[k];
    if (!capture.found) continue;
    Interval& percentile = capture[CaptureIntervalKind::percentile];
    Interval& studentized = capture[CaptureIntervalKind::studentized];
    if (nothing_free) {
      percentile = no_interval(NoInterval::nothing_free);
    } else if (!options.capture) {
      percentile = no_interval(NoInterval::not_asked_for);
    } else if (boot.withheld()) {
      percentile = no_interval(NoInterval::refits_failed);
    } else {
      percentile = percentile_interval(column(boot.capture_velocity, k), options.level);
      studentized = studentized_capture(boot, k, capture.value, options.level);
    }
    if (!studentized.available() && !studentized.missing) {
      studentized.missing = percentile.missing;
    }
    recommend_capture(fitted, fitted.data.sd_stated, capture);
    worst = std::max(worst, relative_error(capture.interval));
  }
  if (worst > 0.0) boot.relative_error = worst;
}

/// How many replicates bring a relative error down to what is wanted, the error falling like
/// 1 / sqrt(B); one less than a multiple of 1000, so that the quantiles fall on replicates.
int more_replicates(int so_far, double error, double wanted) {
  const double needed = so_far * std::pow(error / wanted, 2);
  const double rounded = 1000.0 * std::ceil((needed + 1.0) / 1000.0) - 1.0;
  return static_cast<int>(
      std::clamp(rounded, static_cast<double>(so_far) + 1000.0, 1.0 * most_automatic));
}

void add_spread(UncertaintyResult& result, std::size_t slots) {
  for (TwoPointComparison& comparison : result.two_point) {
    const auto& replicates = result.bootstrap.two_point_theta[comparison.dataset];
    comparison.failed = result.bootstrap.two_point_failed[comparison.dataset];
    for (std::size_t j = 0; j < slots; ++j) {
      comparison.spread.push_back(standard_deviation(column(replicates, j)));
      comparison.full_spread.push_back(standard_deviation(column(result.bootstrap.theta, j)));
    }
  }
}

/// The fit and its intervals with exact materials; none where they are, or without an answer.
std::optional<ConditionalFit> conditional_fit(const FitResult& fitted,
                                              const UncertaintyOptions& options) {
  if (fitted.model.constants.empty()) return std::nullopt;
  FitResult exact = fit(with_exact_materials(fitted.model), fitted.data);
  if (!exact.usable) return std::nullopt;
  UncertaintyOptions plain = options;
  plain.curves = false;
  const std::vector<NoiseAlternative> alternatives = noise_alternatives(exact);
  return ConditionalFit{std::move(exact), likelihood_intervals(alternatives, plain)};
}

}  // namespace

UncertaintyResult assess_uncertainty(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                     const UncertaintyOptions& options) {
  UncertaintyResult result;
  result.options = options;
  const std::vector<NoiseAlternative> alternatives = noise_alternatives(fitted);
  result.capture = capture_estimates(alternatives, options.level, datasets);
  std::vector<TwoPointResult> two_points;
  // Two points are for C_H and C_A: without adhesion there is no C_A.
  bool adheres = false;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    adheres = adheres || !without_adhesion(fitted.model, d);
  }
  for (std::size_t d = 0; options.two_point && adheres && d < datasets.size(); ++d) {
    result.two_point.push_back(compare_two_point(fitted, d));
    two_points.push_back(result.two_point.back().result);
  }
  result.intervals = likelihood_intervals(alternatives, options);
  Bootstrap boot(fitted, result.capture, options);
  const auto delete_one = jackknife(boot.plan(), options.threads);
  for (int count = options.replicates_auto ? fewest_automatic : options.replicates;;) {
    boot.extend(count);
    result.bootstrap = boot.result();
    read_off(fitted, delete_one, result);
    const double error = result.bootstrap.relative_error.value_or(0.0);
    if (!options.replicates_auto || error <= options.wanted_error || count >= most_automatic) break;
    count = more_replicates(count, error, options.wanted_error);
  }
  bootstrap_two_point(boot.plan(), two_points, options, result.bootstrap);
  add_spread(result, fitted.theta.size());
  result.identifiability =
      judge_identifiability(fitted, result.intervals, result.capture, alternatives);
  if (options.posterior) {
    PosteriorOptions sampling = options.sampling;
    sampling.level = options.level;
    sampling.seed = options.seed;
    sampling.threads = options.threads;
    result.posterior = sample_posterior(alternatives, result.capture, sampling);
  }
  if (options.budget) {
    result.budgets = parameter_budgets(fitted);
    result.capture_budgets = capture_budgets(fitted, result.capture);
    result.conditional = conditional_fit(fitted, options);
  }
  if (options.curves) {
    result.curves = restitution_curves(fitted, datasets, result.capture, result.two_point,
                                       {result.bootstrap.theta, options.level, options.threads});
  }
  return result;
}

std::size_t replicates_at_most(const UncertaintyOptions& options) {
  return static_cast<std::size_t>(options.replicates_auto ? most_automatic : options.replicates);
}

ReplicateTable shard_of_bootstrap(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                  const UncertaintyOptions& options) {
  Bootstrap boot(fitted, capture_estimates(noise_alternatives(fitted), options.level, datasets),
                 options);
  boot.extend(static_cast<int>(replicates_at_most(options)));
  return boot.table();
}

}  // namespace recoil
