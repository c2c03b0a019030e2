#include "coverage/coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/uncertainty.hpp"

namespace recoil {
namespace {

/// One data set's intervals, kept only as long as it takes to count them.
struct Trial {
  bool usable = false;
  CoverageTruth::At truth;
  int refits_failed = 0;
  std::vector<IntervalSet> intervals;
  std::vector<ParameterIdentifiability> identifiable;
  std::vector<CaptureEstimate> capture;
};

Trial run_trial(const FitSpec& spec, const CoverageTruth& truth, const UncertaintyOptions& options,
                std::uint64_t index) {
  Trial trial;
  const std::vector<Dataset> datasets = truth.simulate(index);
  const FitResult fitted = fit(make_model(spec, datasets), gather(datasets, spec));
  if (!fitted.usable) return trial;
  UncertaintyOptions own = options;
  own.seed = options.seed + index;
  own.threads = 1;  // the data sets themselves run in parallel
  own.curves = false;
  own.budget = false;
  own.posterior = false;
  own.two_point = false;
  const UncertaintyResult result = assess_uncertainty(fitted, datasets, own);
  trial.usable = true;
  trial.truth = truth.at ? truth.at(index) : CoverageTruth::At{truth.theta, truth.capture};
  trial.refits_failed = result.bootstrap.failed;
  trial.intervals = result.intervals;
  trial.identifiable = result.identifiability.parameter;
  for (const CaptureEstimate& at : result.capture) trial.capture.push_back(at);
  return trial;
}

/// Counts over the usable trials; `interval_of` and `identifiable` look into one of them.
template <class TruthOf, class IntervalOf, class Identifiable>
CoverageCell count(const std::vector<Trial>& trials, std::string_view name, const TruthOf& truth_of,
                   const IntervalOf& interval_of, const Identifiable& identifiable) {
  CoverageCell cell;
  cell.interval = name;
  std::vector<double> widths;
  for (const Trial& trial : trials) {
    if (!trial.usable) continue;
    const Interval& interval = interval_of(trial);
    if (!interval.available()) continue;
    const int held = interval.contains(truth_of(trial)) ? 1 : 0;
    ++cell.offered;
    cell.held += held;
    if (identifiable(trial)) {
      ++cell.offered_identifiable;
      cell.held_identifiable += held;
    }
    widths.push_back(*interval.upper - *interval.lower);
  }
  if (!widths.empty()) {
    const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
    std::nth_element(widths.begin(), middle, widths.end());
    cell.median_width = *middle;
  }
  return cell;
}

}  // namespace

CoverageResult measure_coverage(const FitSpec& spec, const CoverageTruth& truth,
                                const CoverageOptions& options) {
  std::vector<Trial> trials(static_cast<std::size_t>(options.datasets));
  {
    Progress progress("coverage", trials.size());
    parallel_over(trials.size(), options.uncertainty.threads, [&](std::size_t i) {
      trials[i] = run_trial(spec, truth, options.uncertainty, i);
      progress.advance();
    });
  }
  CoverageResult result;
  result.datasets = options.datasets;
  result.truth_origin = truth.origin;
  for (const Trial& trial : trials) {
    result.failed += trial.usable ? 0 : 1;
    result.refits_failed += trial.refits_failed;
  }
  const ImpactModel model = make_model(spec, truth.simulate(0));
  for (std::size_t j = 0; j < model.slots.size(); ++j) {
    if (!model.slots[j].free) continue;
    CoverageRow row;
    row.parameter = model.slots[j].label();
    row.unit = model.slots[j].parameter->unit;
    row.truth = truth.theta[j];
    for (const Trial& trial : trials) {
      if (trial.usable && trial.identifiable[j].identifiable) ++row.identifiable;
    }
    const auto add = [&](std::string_view name, const auto& of) {
      row.cells.push_back(count(
          trials, name, [j](const Trial& t) { return t.truth.theta[j]; },
          [&](const Trial& t) -> const Interval& { return of(t.intervals[j]); },
          [&](const Trial& t) { return t.identifiable[j].identifiable; }));
    };
    add("recommended", recommended_interval);
    for (const IntervalKind kind : values_of<IntervalKind>()) {
      add(name_of(kind), [kind](const IntervalSet& set) -> const Interval& { return set[kind]; });
    }
    result.rows.push_back(std::move(row));
  }
  for (std::size_t k = 0; k < truth.capture.size(); ++k) {
    CoverageRow row;
    row.parameter = fmt::format("V*({:.4g} um)", truth.capture[k].diameter / units::um);
    row.unit = "m/s";
    row.truth = truth.capture[k].velocity;
    const auto add = [&](std::string_view name, const auto& of) {
      row.cells.push_back(count(
          trials, name, [k](const Trial& t) { return t.truth.capture[k].velocity; },
          [&](const Trial& t) -> const Interval& { return of(t.capture[k]); },
          // V* has no verdict of its own but what stands beside its interval.
          [&](const Trial& t) { return !t.capture[k].interval.note; }));
    };
    add("recommended", [](const CaptureEstimate& at) -> const Interval& { return at.interval; });
    for (const CaptureIntervalKind kind : values_of<CaptureIntervalKind>()) {
      add(name_of(kind), [kind](const CaptureEstimate& at) -> const Interval& { return at[kind]; });
    }
    row.identifiable = row.cells.front().offered_identifiable;
    result.rows.push_back(std::move(row));
  }
  return result;
}

}  // namespace recoil
