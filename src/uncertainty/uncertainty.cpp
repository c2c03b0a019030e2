#include "uncertainty/uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/curves.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/profile.hpp"

namespace recoil {
namespace {

constexpr double failures_to_warn = 0.01;
constexpr double failures_to_withhold = 0.10;

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

std::vector<CaptureEstimate> capture_estimates(const FitResult& fitted,
                                               const std::vector<Dataset>& datasets) {
  std::vector<CaptureEstimate> estimates;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const double diameter : distinct_diameters(datasets[d])) {
      const CaptureVelocity v = capture_velocity(fitted.model, fitted.theta, d, diameter);
      CaptureEstimate estimate;
      estimate.dataset = d;
      estimate.diameter = diameter;
      estimate.value = v.value;
      estimate.found = v.found;
      if (!v.found) estimate.interval.why = "spheres of this size never rebound under the fit";
      estimates.push_back(std::move(estimate));
    }
  }
  return estimates;
}

void withhold(Interval& interval, const std::string& why) {
  interval = Interval{};
  interval.why = why;
}

/// Fills the intervals of every free slot; fixed ones say so.
std::vector<IntervalSet> all_intervals(const FitResult& fitted, const Observations& data,
                                       const UncertaintyResult& so_far,
                                       const std::vector<std::vector<double>>& delete_one) {
  const UncertaintyOptions& options = so_far.options;
  const BootstrapResult& boot = so_far.bootstrap;
  const bool too_many_failed = boot.failed > failures_to_withhold * boot.replicates;
  std::vector<IntervalSet> sets(fitted.theta.size());
  for (std::size_t j = 0; j < sets.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    IntervalSet& set = sets[j];
    set.recommended = "profile";
    set.recommended_why =
        "it follows the likelihood where that is not a parabola and stops at the bounds; in the "
        "coverage study it did no worse than the others";
    if (!slot.free) {
      for (Interval* interval :
           {&set.wald, &set.profile, &set.percentile, &set.bca, &set.studentized}) {
        withhold(*interval, "fixed in this fit");
      }
      continue;
    }
    set.wald = wald_interval(fitted.theta[j], fitted.std_error[j], options.level,
                             data.sd_stated ? 0 : fitted.dof, slot.lower, slot.upper);
    if (options.profile) {
      set.profile = profile_interval(fitted, data, j, options.level);
    } else {
      set.profile.why = "not asked for";
    }
    if (too_many_failed) {
      const std::string why = fmt::format("{} of {} refits failed", boot.failed, boot.replicates);
      withhold(set.percentile, why);
      withhold(set.bca, why);
      withhold(set.studentized, why);
    } else {
      const std::vector<double> replicates = column(boot.theta, j);
      set.percentile = percentile_interval(replicates, options.level);
      set.bca = bca_interval(replicates, fitted.theta[j], column(delete_one, j), options.level);
      set.studentized =
          studentized_interval(replicates, column(boot.std_error, j), fitted.theta[j],
                               fitted.std_error[j], options.level, slot.lower, slot.upper);
    }
    if (!set.profile.available()) {
      set.recommended = set.percentile.available() ? "percentile" : "wald";
      set.recommended_why = "the profile is not available: " + set.profile.why;
    }
  }
  return sets;
}

/// Points of `data` that belong to `dataset`, split by whether their diameter is `diameter`.
struct Split {
  std::vector<std::size_t> all, seen, unseen;
};
Split split_by_diameter(const Observations& data, std::size_t dataset, double diameter) {
  Split split;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    if (data.points[i].dataset != dataset) continue;
    split.all.push_back(i);
    (data.points[i].diameter == diameter ? split.seen : split.unseen).push_back(i);
  }
  return split;
}

TwoPointComparison compare_two_point(const FitResult& fitted, const Observations& data,
                                     std::size_t dataset) {
  TwoPointComparison comparison;
  comparison.dataset = dataset;
  const double diameter = fitted.model.contacts[dataset].reference_diameter;
  comparison.result = two_point(fitted.model, data, dataset, diameter);
  const Split split = split_by_diameter(data, dataset, comparison.result.diameter);
  comparison.full_rmse = root_mean_square(fitted.model, fitted.theta, data, split.all);
  const bool answered = comparison.result.status != TwoPointStatus::too_few_points;
  if (answered) {
    comparison.rmse = root_mean_square(fitted.model, comparison.result.theta, data, split.all);
  }
  if (split.unseen.empty()) {
    comparison.held_out_why = "the dataset has a single diameter: nothing is held out";
    return comparison;
  }
  if (answered) {
    comparison.held_out_rmse =
        root_mean_square(fitted.model, comparison.result.theta, data, split.unseen);
  }
  Observations seen = data;
  seen.points.clear();
  for (const std::size_t i : split.seen) seen.points.push_back(data.points[i]);
  // Parameters of other datasets stay out of this: only what this diameter can tell is refitted.
  ImpactModel alone = fitted.model;
  for (std::size_t j = 0; j < alone.slots.size(); ++j) {
    const bool used =
        j == alone.slot_C_H[dataset] || j == alone.slot_C_A[dataset] || j == alone.slot_f0[dataset];
    alone.slots[j].free = alone.slots[j].free && used;
  }
  const FitResult on_one = fit(alone, seen);
  if (on_one.usable) {
    comparison.full_held_out_rmse =
        root_mean_square(fitted.model, on_one.theta, data, split.unseen);
  } else {
    comparison.held_out_why = "the full fit of that diameter alone failed: " + on_one.failure;
  }
  return comparison;
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

void add_warnings(UncertaintyResult& result, const std::vector<Dataset>& datasets) {
  const BootstrapResult& boot = result.bootstrap;
  if (boot.failed > failures_to_warn * boot.replicates) {
    result.warnings.push_back(fmt::format(
        "{} of {} bootstrap refits failed{}", boot.failed, boot.replicates,
        boot.failed > failures_to_withhold * boot.replicates ? ": their intervals are withheld"
                                                             : ""));
  }
  for (const TwoPointComparison& comparison : result.two_point) {
    if (comparison.result.status == TwoPointStatus::converged) continue;
    result.warnings.push_back(fmt::format("two-point iteration on {}: {}",
                                          datasets[comparison.dataset].id, comparison.result.text));
  }
  for (const CaptureEstimate& capture : result.capture) {
    if (capture.found) continue;
    result.warnings.push_back(fmt::format("no capture velocity at d = {:.4g} um: {}",
                                          capture.diameter / units::um, capture.interval.why));
  }
}

}  // namespace

UncertaintyResult assess_uncertainty(const FitResult& fitted, const Observations& data,
                                     const std::vector<Dataset>& datasets,
                                     const UncertaintyOptions& options) {
  UncertaintyResult result;
  result.options = options;
  result.capture = capture_estimates(fitted, datasets);
  std::vector<TwoPointResult> two_points;
  for (std::size_t d = 0; options.two_point && d < datasets.size(); ++d) {
    result.two_point.push_back(compare_two_point(fitted, data, d));
    two_points.push_back(result.two_point.back().result);
  }
  result.bootstrap = bootstrap(fitted, data, result.capture, two_points, options);
  const auto delete_one = jackknife(fitted, data, options.threads);
  result.intervals = all_intervals(fitted, data, result, delete_one);
  const auto& slots = fitted.model.slots;
  const bool nothing_free =
      std::none_of(slots.begin(), slots.end(), [](const ParameterSlot& slot) { return slot.free; });
  for (std::size_t k = 0; k < result.capture.size(); ++k) {
    CaptureEstimate& capture = result.capture[k];
    if (!capture.found) continue;
    if (nothing_free) {
      capture.interval.why = "nothing was free in this fit";
      continue;
    }
    capture.interval =
        percentile_interval(column(result.bootstrap.capture_velocity, k), options.level);
  }
  add_spread(result, fitted.theta.size());
  result.identifiability = judge_identifiability(fitted, data, result.intervals, result.capture);
  if (options.curves) result.curves = restitution_curves(fitted, data, datasets, result);
  add_warnings(result, datasets);
  return result;
}

}  // namespace recoil
