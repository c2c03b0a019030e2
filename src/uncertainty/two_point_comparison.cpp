#include "uncertainty/two_point_comparison.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "estimate/misfit.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {
namespace {

// The two-point iteration costs several refits, and only its spread is needed, which this number
// determines to 2 %.
constexpr int most_replicates = 999;

/// The points of one dataset, split into those with the calibrated diameter (seen) and the others.
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

/// NaN for fewer than two values.
double standard_deviation(const std::vector<double>& values) {
  if (values.size() < 2) return std::nan("");
  double mean = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  double sum = 0.0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// Repeats the fit with the points of one diameter; only the base parameters of this dataset are
/// free.
FitResult fit_of_diameter(const FitResult& fitted, std::size_t dataset, const Split& split) {
  ImpactModel alone = fitted.model;
  for (std::size_t j = 0; j < alone.slots.size(); ++j) {
    const bool used = j == alone.slot_C_H[dataset] || j == alone.slot_C_A[dataset] ||
                      j == alone.slot_adhesion[dataset];
    alone.slots[j].free = alone.slots[j].free && used;
  }
  return fit(alone, fitted.data.subset(split.seen));
}

/// Is the adhesion of every dataset free (or fixed, if not `free`)?
bool adhesion_is(const ImpactModel& model, bool free) {
  return std::all_of(model.slot_adhesion.begin(), model.slot_adhesion.end(),
                     [&](std::size_t slot) { return model.slots[slot].free == free; });
}

/// Repeats the fit with the adhesion of every dataset free or fixed. A fixed one has the value of
/// the fit file, or that of the materials if the fit file frees it.
FitResult with_adhesion(const FitResult& fitted, bool free) {
  ImpactModel model = fitted.model;
  for (std::size_t d = 0; d < model.contacts.size(); ++d) {
    ParameterSlot& slot = model.slots[model.slot_adhesion[d]];
    if (slot.free && !free) slot.initial = derived_adhesion(model, d);
    slot.free = free;
  }
  return fit(model, fitted.data);
}

/// Standard errors [slots] of a fit whose constants are exact: its own without `constant_effects`.
std::vector<double> errors_with_exact_constants(const FitResult& fitted) {
  std::vector<double> covariance = fitted.covariance;
  add_constant_effects(fitted.constant_effects, covariance, -1.0);
  const std::size_t slots = fitted.theta.size();
  std::vector<double> errors;
  for (std::size_t j = 0; j < slots && covariance.size() == slots * slots; ++j) {
    errors.push_back(std::sqrt(std::max(0.0, covariance[j * slots + j])));
  }
  return errors;
}

}  // namespace

TwoPointComparison compare_two_point(const FitResult& fitted, std::size_t dataset) {
  const Observations& data = fitted.data;
  TwoPointComparison comparison;
  comparison.dataset = dataset;
  const double diameter = fitted.model.contacts[dataset].reference_diameter;
  comparison.result = two_point(fitted.model, data, dataset, diameter);
  const Split split = split_by_diameter(data, dataset, comparison.result.diameter);
  comparison.full_rmse =
      root_mean_square(fitted.model, fitted.theta, data, fitted.weights, split.all);
  const bool answered = comparison.result.status != TwoPointStatus::too_few_points;
  if (answered) {
    comparison.rmse =
        root_mean_square(fitted.model, comparison.result.theta, data, fitted.weights, split.all);
  }
  if (split.unseen.empty()) {
    comparison.nothing_held_out = true;
    return comparison;
  }
  if (answered) {
    comparison.held_out_rmse =
        root_mean_square(fitted.model, comparison.result.theta, data, fitted.weights, split.unseen);
  }
  const FitResult on_one = fit_of_diameter(fitted, dataset, split);
  comparison.handovers = on_one.handovers;
  if (on_one.usable) {
    comparison.full_held_out_rmse =
        root_mean_square(fitted.model, on_one.theta, data, fitted.weights, split.unseen);
  } else {
    comparison.nothing_held_out = true;
    comparison.refit_failure = on_one.failure;
  }
  return comparison;
}

std::vector<TwoPointComparison> compare_two_points(const FitResult& fitted) {
  const std::size_t datasets = fitted.model.contacts.size();
  std::vector<TwoPointComparison> comparisons;
  bool adheres = false;
  for (std::size_t d = 0; d < datasets; ++d) {
    adheres = adheres || !without_adhesion(fitted.model, d);
  }
  for (std::size_t d = 0; adheres && d < datasets; ++d) {
    comparisons.push_back(compare_two_point(fitted, d));
  }
  return comparisons;
}

void add_comparison_rows(const FitResult& fitted, std::vector<TwoPointComparison>& comparisons) {
  for (TwoPointComparison& comparison : comparisons) {
    ComparisonRow two;
    if (comparison.result.status == TwoPointStatus::too_few_points) {
      two.failure = "too few points";
    } else {
      two.theta = comparison.result.theta;
      two.rmse = comparison.rmse;
      two.held_out_rmse = comparison.held_out_rmse;
    }
    comparison.rows = {std::move(two)};
  }
  for (const CalibrationKind calibration : {CalibrationKind::full, CalibrationKind::full_f0_free}) {
    const bool free = calibration == CalibrationKind::full_f0_free;
    std::optional<FitResult> other;
    if (!adhesion_is(fitted.model, free)) other = with_adhesion(fitted, free);
    if (other && !comparisons.empty()) comparisons.front().handovers += other->handovers;
    for (TwoPointComparison& comparison : comparisons) {
      ComparisonRow& row = comparison.rows.emplace_back();
      row.row = calibration;
      row.headline = !other;
      if (other && !other->usable) {
        row.failure = other->failure;
        continue;
      }
      const TwoPointComparison own =
          other ? compare_two_point(*other, comparison.dataset) : comparison;
      if (other) comparison.handovers += own.handovers;
      const FitResult& full = other ? *other : fitted;
      row.theta = full.theta;
      row.standard_errors = errors_with_exact_constants(full);
      row.noise_known = full.weights.noise.known;
      row.rmse = own.full_rmse;
      row.held_out_rmse = own.full_held_out_rmse;
    }
  }
}

void add_headline_row(const FitResult& fitted, std::vector<TwoPointComparison>& comparisons) {
  for (TwoPointComparison& comparison : comparisons) {
    for (ComparisonRow& row : comparison.rows) row.headline = false;
    const TwoPointComparison own = compare_two_point(fitted, comparison.dataset);
    comparison.handovers += own.handovers;
    comparison.rows.push_back({.row = CalibrationKind::fit,
                               .theta = fitted.theta,
                               .failure = {},
                               .rmse = own.full_rmse,
                               .held_out_rmse = own.full_held_out_rmse,
                               .standard_errors = fitted.std_error,
                               .headline = true});
  }
}

void bootstrap_two_points(const FitResult& fitted, const UncertaintyOptions& options,
                          std::vector<TwoPointComparison>& comparisons, BootstrapResult& result) {
  const std::size_t datasets = comparisons.size();
  const auto count = static_cast<std::size_t>(std::min(result.replicates, most_replicates));
  result.two_point_replicates = datasets == 0 ? 0 : static_cast<int>(count);
  result.two_point_theta.resize(datasets);
  result.two_point_failed.assign(datasets, 0);
  if (datasets == 0) return;
  const ResamplingPlan plan = plan_resampling(fitted, result.scheme);
  // theta [replicates][datasets]; empty: not converged
  std::vector<std::vector<std::vector<double>>> found(count);
  tbb::enumerable_thread_specific<Observations> samples;
  Progress progress("two points", count);
  parallel_over(count, options.threads, [&](std::size_t i) {
    Observations& sample = samples.local();
    resample(plan, options.seed, i, sample);
    for (std::size_t d = 0; d < datasets; ++d) {
      const TwoPointResult& original = comparisons[d].result;
      TwoPointResult run = two_point(fitted.model, sample, d, original.diameter, original.theta);
      found[i].push_back(run.status == TwoPointStatus::converged ? std::move(run.theta)
                                                                 : std::vector<double>{});
    }
    progress.advance();
  });
  for (auto& replicate : found) {
    for (std::size_t d = 0; d < datasets; ++d) {
      if (replicate[d].empty()) {
        ++result.two_point_failed[d];
      } else {
        result.two_point_theta[d].push_back(std::move(replicate[d]));
      }
    }
  }
  for (std::size_t d = 0; d < datasets; ++d) {
    TwoPointComparison& comparison = comparisons[d];
    comparison.failed = result.two_point_failed[d];
    for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
      comparison.spread.push_back(standard_deviation(finite_column(result.two_point_theta[d], j)));
      comparison.full_spread.push_back(standard_deviation(finite_column(result.theta, j)));
    }
  }
}

}  // namespace recoil
