#include "coverage/coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "coverage/coverage_truth.hpp"
#include "estimate/law_average.hpp"
#include "estimate/noise_doubt.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/fit_alternatives.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/parameter_intervals.hpp"
#include "uncertainty/posterior.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {
namespace {

CoverageTrial::Row trial_row(bool identifiable, double deviation, double truth,
                             const std::vector<const Interval*>& intervals) {
  CoverageTrial::Row row{identifiable, deviation, {}};
  for (const Interval* interval : intervals) {
    auto& cell = row.cells.emplace_back();
    if (interval->available()) {
      cell = {interval->contains(truth), *interval->upper - *interval->lower};
    }
  }
  return row;
}

/// Names of the cells of a row: the recommended interval, every kind, and the posterior.
template <NamedEnum Kind>
std::vector<std::string> cell_names() {
  std::vector<std::string> names = {"recommended"};
  for (const Kind kind : values_of<Kind>()) names.emplace_back(name_of(kind));
  names.emplace_back("posterior");
  return names;
}

/// The 68.27 % quantile of the deviations of the estimates from the truth over the usable trials.
template <class RowOf>
double actual_error(const std::vector<CoverageTrial>& trials, const RowOf& row_of) {
  constexpr double one_sigma = 0.6827;
  std::vector<double> deviations;
  for (const CoverageTrial& trial : trials) {
    if (trial.usable) deviations.push_back(row_of(trial).deviation);
  }
  std::sort(deviations.begin(), deviations.end());
  return deviations.empty() ? 0.0 : sorted_quantile(deviations, one_sigma);
}

/// Counts over the usable trials; `row_of` selects the row of a trial.
template <class RowOf>
std::vector<CoverageCell> count(const std::vector<CoverageTrial>& trials,
                                const std::vector<std::string>& names, const RowOf& row_of) {
  std::vector<CoverageCell> cells;
  for (std::size_t c = 0; c < names.size(); ++c) {
    CoverageCell cell;
    cell.interval = names[c];
    std::vector<double> widths;
    for (const CoverageTrial& trial : trials) {
      if (!trial.usable) continue;
      const CoverageTrial::Row& row = row_of(trial);
      if (!row.cells.at(c)) continue;
      const int held = row.cells[c]->held ? 1 : 0;
      ++cell.offered;
      cell.held += held;
      if (row.identifiable) {
        ++cell.offered_identifiable;
        cell.held_identifiable += held;
      }
      widths.push_back(row.cells[c]->width);
    }
    if (!widths.empty()) {
      const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
      std::nth_element(widths.begin(), middle, widths.end());
      cell.median_width = *middle;
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace

CoverageTrial run_coverage_trial(const FitSpec& spec, const CoverageTruth& truth,
                                 const CoverageOptions& options, std::uint64_t index) {
  CoverageTrial trial;
  const std::vector<Dataset> datasets = truth.simulate(index);
  const FitResult fitted = fit_as_stated(spec, make_model(spec, datasets), gather(datasets, spec));
  if (!fitted.usable) return trial;
  if (scheme_obstacle(options.uncertainty.scheme, fitted.data)) return trial;
  UncertaintyOptions own = options.uncertainty;
  own.seed = options.uncertainty.seed + index;
  own.threads = 1;  // the data sets themselves run in parallel
  const std::vector<FitAlternative> alternatives = fit_alternatives(fitted);
  std::vector<IntervalSet> sets = likelihood_intervals(alternatives, own.level, own.threads);
  std::vector<CaptureEstimate> captures = capture_estimates(alternatives, own.level, datasets);
  const BootstrapResult replicates = bootstrap(fitted, captures, own);
  add_resampled_intervals(fitted, replicates, own.level, own.threads, sets);
  add_resampled_captures(fitted, replicates, own.level, captures);
  const Identifiability identifiability =
      judge_identifiability(fitted, sets, captures, own.level, alternatives);
  PosteriorResult posterior;
  if (own.posterior)
    posterior = sample_posterior(noise_alternatives(fitted), captures, sampling_options(own));
  const CoverageTruth::At at =
      truth.at ? truth.at(index) : CoverageTruth::At{truth.theta, truth.capture};
  const Interval none = no_interval(NoInterval::not_assessed);
  const auto posterior_of = [&](const auto& marginals, std::size_t k) {
    return k < marginals.size() ? &marginals[k].interval : &none;
  };
  trial.usable = true;
  trial.refits_failed = replicates.failed;
  for (std::size_t j = 0; j < fitted.model.slots.size(); ++j) {
    if (!fitted.model.slots[j].free) continue;
    const IntervalSet& set = sets[j];
    std::vector<const Interval*> intervals = {&recommended_interval(set)};
    for (const IntervalKind kind : values_of<IntervalKind>()) intervals.push_back(&set[kind]);
    intervals.push_back(posterior_of(posterior.parameters, j));
    const ParameterIdentifiability& verdict = identifiability.parameter[j];
    const double off = std::abs(fitted.theta[j] - at.theta[j]);
    // Over the truth; a truth of zero is missed by all of the estimate.
    const double scale = std::abs(at.theta[j] != 0.0 ? at.theta[j] : fitted.theta[j]);
    trial.parameters.push_back(
        trial_row(verdict.identifiable, off > 0.0 ? off / scale : 0.0, at.theta[j], intervals));
  }
  for (std::size_t k = 0; k < truth.capture.size(); ++k) {
    const CaptureEstimate& capture = captures[k];
    std::vector<const Interval*> intervals = {&capture.interval};
    for (const CaptureIntervalKind kind : values_of<CaptureIntervalKind>()) {
      intervals.push_back(&capture[kind]);
    }
    intervals.push_back(posterior_of(posterior.capture, k));
    // The verdict on V* is whether its interval has a caution.
    const double velocity = at.capture[k].velocity;
    trial.capture.push_back(trial_row(
        !capture.interval.note, std::abs(capture.value / velocity - 1.0), velocity, intervals));
  }
  return trial;
}

CoverageResult count_coverage(const FitSpec& spec, const CoverageTruth& truth,
                              const CoverageOptions& options,
                              const std::vector<CoverageTrial>& trials) {
  CoverageResult result;
  result.datasets = options.datasets;
  result.truth_origin = truth.origin;
  for (const CoverageTrial& trial : trials) {
    result.failed += trial.usable ? 0 : 1;
    result.refits_failed += trial.refits_failed;
  }
  const ImpactModel model = make_model(spec, truth.simulate(0));
  std::size_t free = 0;
  for (std::size_t j = 0; j < model.slots.size(); ++j) {
    if (!model.slots[j].free) continue;
    CoverageRow row;
    row.parameter = model.slots[j].label();
    row.unit = model.slots[j].parameter->unit;
    row.truth = truth.theta[j];
    const auto row_of = [free](const CoverageTrial& trial) -> const CoverageTrial::Row& {
      return trial.parameters.at(free);
    };
    for (const CoverageTrial& trial : trials) {
      if (trial.usable && row_of(trial).identifiable) ++row.identifiable;
    }
    row.actual_error = actual_error(trials, row_of);
    row.cells = count(trials, cell_names<IntervalKind>(), row_of);
    result.rows.push_back(std::move(row));
    ++free;
  }
  for (std::size_t k = 0; k < truth.capture.size(); ++k) {
    if (!truth.capture[k].captures()) continue;
    CoverageRow row;
    row.parameter = fmt::format("V*({:.4g} um)", truth.capture[k].diameter / units::um);
    row.unit = "m/s";
    row.truth = truth.capture[k].velocity;
    const auto row_of = [k](const CoverageTrial& trial) -> const CoverageTrial::Row& {
      return trial.capture.at(k);
    };
    row.actual_error = actual_error(trials, row_of);
    row.cells = count(trials, cell_names<CaptureIntervalKind>(), row_of);
    row.identifiable = row.cells.front().offered_identifiable;
    result.rows.push_back(std::move(row));
  }
  return result;
}

std::string digits_of(const CoverageTruth& truth) {
  std::string digits{name_of(truth.origin)};
  for (const double value : truth.theta) digits += fmt::format("|{:a}", value);
  for (const CoverageTruth::Capture& capture : truth.capture) {
    digits += fmt::format("|{:a} {:a}", capture.diameter, capture.velocity);
  }
  return digits;
}

CoverageResult measure_coverage(const FitSpec& spec, const CoverageTruth& truth,
                                const CoverageOptions& options) {
  std::vector<CoverageTrial> trials(static_cast<std::size_t>(options.datasets));
  {
    Progress progress("coverage", trials.size());
    parallel_over(trials.size(), options.uncertainty.threads, [&](std::size_t i) {
      trials[i] = run_coverage_trial(spec, truth, options, i);
      progress.advance();
    });
  }
  return count_coverage(spec, truth, options, trials);
}

int own_design_datasets(const FitSpec& spec, const FitResult& fitted, int replicates) {
  if (!fitted.weights.noise.known || !noise_doubts(fitted).empty()) return 0;
  if (spec.uncertainty.own_design) return *spec.uncertainty.own_design;
  if (replicates == 0 || fitted.noise_verdict == NoiseVerdict::exceeded) return 0;
  constexpr int usual = 200;
  constexpr double most_seconds = 10.0;
  // Seconds on one core per point of a data set; measured, see docs/speed.md.
  const bool mixtures = !fitted.model.chain.empty() || averages_over_sizes(fitted.model);
  double seconds = fitted.data.weights_depend_on_fit() ? 2.5e-3 : 5e-4;
  if (fitted.weights.noise.event_spread > 0.0) seconds = 5e-3;
  if (mixtures || fitted.model.adhesion != AdhesionLaw::ring) seconds *= 10.0;
  if (!fitted.laws.empty()) seconds *= 20.0;
  const double cost = usual * seconds * static_cast<double>(fitted.data.points.size());
  return cost < most_seconds ? usual : 0;
}

std::vector<OwnCoverage> own_design_coverage(const FitSpec& spec, const FitResult& fitted,
                                             const std::vector<Dataset>& data,
                                             const std::vector<IntervalSet>& sets,
                                             const std::vector<CaptureEstimate>& captures,
                                             const UncertaintyOptions& options, int datasets) {
  CoverageOptions own;
  own.datasets = datasets;
  own.uncertainty.replicates = 0;
  own.uncertainty.level = options.level;
  own.uncertainty.seed = options.seed;
  own.uncertainty.threads = options.threads;
  const CoverageTruth truth = coverage_truth(fitted, data, options.seed);
  const CoverageResult counted = measure_coverage(spec, truth, own);
  std::vector<OwnCoverage> rows;
  auto next = counted.rows.begin();
  const auto take = [&](bool quoted, std::string_view method) {
    const CoverageRow& row = *next++;
    const auto cell = std::find_if(row.cells.begin(), row.cells.end(),
                                   [&](const CoverageCell& one) { return one.interval == method; });
    if (quoted && cell->offered > 0) {
      rows.push_back({row.parameter, std::string(method), cell->offered, cell->held});
    }
  };
  for (std::size_t j = 0; j < sets.size(); ++j) {
    if (!fitted.model.slots[j].free) continue;
    const bool profile = sets[j][IntervalKind::profile].available();
    take(recommended_interval(sets[j]).available(),
         name_of(profile ? IntervalKind::profile : IntervalKind::wald));
  }
  for (std::size_t k = 0; k < captures.size(); ++k) {
    if (!truth.capture[k].captures()) continue;
    take(captures[k].found && captures[k].interval.available(),
         name_of(CaptureIntervalKind::delta));
  }
  return rows;
}

}  // namespace recoil
