#include "analysis/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/units.hpp"
#include "data/dataset.hpp"
#include "estimate/law_average.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/fit_alternatives.hpp"
#include "uncertainty/parameter_intervals.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {

UncertaintyOptions uncertainty_options(const FitSpec& spec, const AnalysisOptions& options) {
  UncertaintyOptions assess;
  assess.replicates = options.replicates.value_or(spec.uncertainty.replicates);
  assess.replicates_auto =
      options.replicates_auto || (spec.uncertainty.replicates_auto && !options.replicates);
  assess.scheme = options.scheme.value_or(spec.uncertainty.scheme);
  assess.level = spec.uncertainty.level;
  assess.posterior = spec.uncertainty.posterior;
  assess.seed = options.seed.value_or(spec.uncertainty.seed);
  assess.threads = options.threads;
  assess.kept = options.kept;
  return assess;
}

void require_scheme(const FitSpec& spec, Scheme scheme, const Observations& data) {
  const std::optional<std::string> obstacle = scheme_obstacle(scheme, data);
  if (!obstacle) return;
  throw InputError({spec.file.string()},
                   fmt::format("the scheme \"{}\" cannot be used", to_string(scheme)), *obstacle,
                   "scheme = \"auto\" chooses one that can");
}

std::vector<Dataset> load_datasets(const FitSpec& spec) {
  std::vector<Dataset> datasets;
  for (const std::filesystem::path& folder : spec.datasets)
    datasets.push_back(load_dataset(folder));
  return datasets;
}

std::size_t choose_dataset(const std::vector<Dataset>& datasets, const std::string& id) {
  if (id.empty()) return 0;
  std::vector<std::string> known;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    if (datasets[d].id == id) return d;
    known.push_back(datasets[d].id);
  }
  const std::string near = nearest_word(id, known);
  throw InputError(
      {}, fmt::format("--dataset {} is not a dataset of this fit", id), "",
      near.empty() ? "leave the option out for the first one" : "did you mean " + near + "?");
}

void add_predictions(Analysis& analysis) {
  const UncertaintyResult& assessed = analysis.uncertainty;
  CaptureComparisonOptions compare;
  compare.level = assessed.options.level;
  compare.threads = assessed.options.threads;
  for (std::size_t d = 0; d < analysis.datasets.size(); ++d) {
    const auto sizes = sizes_of_dataset(analysis.datasets[d].folder);
    if (!sizes) continue;
    analysis.mixtures.push_back(
        predict_sizes(analysis, *sizes, std::nullopt, false, analysis.datasets[d].id));
    compare.include.emplace_back(d, sizes->smallest);
    compare.include.emplace_back(d, sizes->largest);
  }
  analysis.captures =
      compare_captures(analysis.fitted, analysis.datasets, assessed.bootstrap, compare);
}

PolydispersePrediction predict_sizes(const Analysis& analysis, const MeasuredSizes& sizes,
                                     std::optional<double> height, bool midpoints,
                                     const std::string& dataset) {
  PolydisperseOptions mix;
  mix.level = analysis.uncertainty.options.level;
  mix.threads = analysis.uncertainty.options.threads;
  if (sizes.probe_height) mix.probe_height = *sizes.probe_height;
  if (height) mix.probe_height = *height;
  if (midpoints) mix.parts = 1;
  return predict_mixture(analysis.fitted, choose_dataset(analysis.datasets, dataset),
                         analysis.uncertainty.bootstrap, sizes, mix);
}

FitInputs load_inputs(const std::filesystem::path& fit_file) {
  FitSpec spec = load_fit(fit_file);
  std::vector<Dataset> datasets = load_datasets(spec);
  LossChoice choice = choose_loss(spec, datasets);
  return {std::move(choice.spec), std::move(datasets), std::move(choice.laws)};
}

Analysis analyse(FitInputs inputs, const AnalysisOptions& options) {
  Analysis analysis = analyse_fit(std::move(inputs), options);
  assess(analysis, uncertainty_options(analysis.spec, options));
  return analysis;
}

void assess(Analysis& a, const UncertaintyOptions& options) {
  a.uncertainty = assess_uncertainty(a.fitted, a.datasets, options);
  const int replicates = options.replicates_auto ? 1 : options.replicates;
  const int datasets = own_design_datasets(a.spec, a.fitted, replicates);
  if (datasets == 0) return;
  a.own_design = own_design_coverage(a.spec, a.fitted, a.datasets, a.uncertainty.intervals,
                                     a.uncertainty.capture, options, datasets);
}

namespace {

/// Completes values of the base parameters by the stated constants and exact laws.
void complete(std::vector<double>& values, const ImpactModel& model, bool errors = false) {
  if (values.empty()) return;
  for (std::size_t j = values.size(); j < model.slots.size(); ++j) {
    values.push_back(errors ? 0.0 : model.slots[j].initial);
  }
}

/// The two-point calibrations and what they are compared with: fits with the stated constants and
/// exact laws, like the calibration itself.
std::vector<TwoPointComparison> comparisons_with(const FitResult& fitted,
                                                 const std::optional<ConditionalFit>& exact) {
  const FitResult& alike = exact && !fitted.laws.empty() ? exact->fitted : fitted;
  const auto& points = fitted.data.points;
  std::vector<TwoPointComparison> comparisons;
  if (std::any_of(points.begin(), points.end(), [](const Observation& p) { return !p.censored; })) {
    comparisons = compare_two_points(alike);
  }
  add_comparison_rows(alike, comparisons);
  for (TwoPointComparison& comparison : comparisons) {
    complete(comparison.result.theta, fitted.model);
    for (ComparisonRow& row : comparison.rows) {
      complete(row.theta, fitted.model);
      complete(row.standard_errors, fitted.model, true);
    }
  }
  if (&alike != &fitted) add_headline_row(fitted, comparisons);
  return comparisons;
}

}  // namespace

UncertaintyResult assess_uncertainty(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                     const UncertaintyOptions& options) {
  const auto [level, threads] = std::pair(options.level, options.threads);
  const std::vector<FitAlternative> alternatives = fit_alternatives(fitted);
  UncertaintyResult result;
  result.options = options;
  result.intervals = likelihood_intervals(alternatives, level, threads);
  add_profile_curves(fitted, level, threads, result.intervals);
  result.capture = capture_estimates(alternatives, level, datasets);
  result.bootstrap = bootstrap(fitted, result.capture, options);
  add_resampled_intervals(fitted, result.bootstrap, level, threads, result.intervals);
  add_resampled_captures(fitted, result.bootstrap, level, result.capture);
  const auto& points = fitted.data.points;
  result.conditional = conditional_fit(fitted, level, threads);
  result.two_point = comparisons_with(fitted, result.conditional);
  bootstrap_two_points(fitted, options, result.two_point, result.bootstrap);
  result.identifiability =
      judge_identifiability(fitted, result.intervals, result.capture, level, alternatives);
  if (options.posterior) {
    result.posterior =
        sample_posterior(noise_alternatives(fitted), result.capture, sampling_options(options));
  }
  result.odd_point = odd_point(with_laws_exact(fitted));
  result.budgets = parameter_budgets(fitted);
  result.capture_budgets = capture_budgets(fitted, result.capture);
  result.curves = restitution_curves(fitted, datasets, result.capture, result.two_point,
                                     {result.bootstrap.theta, level, threads});
  if (std::all_of(points.begin(), points.end(),
                  [](const Observation& p) { return p.censored && !p.mixed(); })) {
    // The parameters still have their initial values, and so has everything that follows from them.
    limit_by_captures(fitted.data, result.capture);
    result.curves.clear();
    result.capture_budgets.clear();
  }
  return result;
}

UncertaintyResult bootstrap_only(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                 const UncertaintyOptions& options) {
  UncertaintyResult result;
  result.options = options;
  result.capture = capture_estimates(fit_alternatives(fitted), options.level, datasets);
  result.bootstrap = bootstrap(fitted, result.capture, options);
  return result;
}

Analysis analyse_fit(FitInputs inputs, const AnalysisOptions& options) {
  Analysis analysis;
  analysis.spec = std::move(inputs.spec);
  analysis.datasets = std::move(inputs.datasets);
  analysis.losses = std::move(inputs.losses);
  Observations gathered = gather(analysis.datasets, analysis.spec);
  const Scheme scheme = options.scheme.value_or(analysis.spec.uncertainty.scheme);
  require_scheme(analysis.spec, scheme, gathered);
  ImpactModel model = make_model(analysis.spec, analysis.datasets);
  model.solver.kind = options.solver;
  FitOptions fitting;
  fitting.threads = options.threads;
  analysis.fitted = fit_as_stated(analysis.spec, model, std::move(gathered), fitting);
  if (!analysis.fitted.usable) {
    throw ComputationError(fmt::format("{}: the fit has no usable answer: {}",
                                       analysis.spec.file.string(), analysis.fitted.failure));
  }
  // The fit may have estimated an error that the points of a setting share.
  require_scheme(analysis.spec, scheme, analysis.fitted.data);
  analysis.validity = fit_validity(analysis.fitted, analysis.datasets);
  return analysis;
}

}  // namespace recoil
