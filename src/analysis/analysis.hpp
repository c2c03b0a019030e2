#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coverage/coverage.hpp"
#include "data/dataset.hpp"
#include "estimate/fit.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/loss_choice.hpp"
#include "predict/capture_comparison.hpp"
#include "predict/law_choice.hpp"
#include "predict/polydisperse.hpp"
#include "predict/validity.hpp"
#include "uncertainty/uncertainty_options.hpp"
#include "uncertainty/uncertainty_result.hpp"

namespace recoil {

/// The result of one fit with its uncertainty. Its page, its text and its JSON have no other input.
struct Analysis {
  FitSpec spec;
  std::vector<Dataset> datasets;
  FitResult fitted;
  std::vector<Validity> validity;  ///< of the model, at the worst point of each dataset
  UncertaintyResult uncertainty;
  std::vector<OwnCoverage> own_design;           ///< empty if it was not simulated
  std::vector<PolydispersePrediction> mixtures;  ///< for datasets with a size distribution
  std::vector<CaptureComparison> captures;       ///< with older models; may be empty
  std::vector<LawFit> laws;     ///< the fit under its own law and others; may be empty
  std::vector<LossFit> losses;  ///< see FitInputs
};

/// A fit file and its datasets.
struct FitInputs {
  FitSpec spec;  ///< with the chosen loss of the dry contact
  std::vector<Dataset> datasets;
  std::vector<LossFit> losses = {};  ///< if the points chose the loss: every law, the best first
};

/// Options that override the fit file.
struct AnalysisOptions {
  std::optional<int> replicates;
  bool replicates_auto = false;
  std::optional<Scheme> scheme;
  std::optional<std::uint64_t> seed;
  int threads = 0;  ///< 0: all cores. No digit depends on it.
  Solver solver = Solver::fast;
  std::shared_ptr<KeptRows> kept;  ///< see UncertaintyOptions
};

/// Reads a fit file and its datasets, and chooses the loss (`choose_loss`).
/// @throws InputError
FitInputs load_inputs(const std::filesystem::path& fit_file);
std::vector<Dataset> load_datasets(const FitSpec& spec);

/// The whole pipeline for one fit: data, fit, uncertainty.
/// @throws InputError if the bootstrap's scheme cannot draw from these data
/// @throws ComputationError if the fit has no usable result
Analysis analyse(FitInputs inputs, const AnalysisOptions& options = {});

/// The pipeline up to the fit: `uncertainty` stays empty.
/// @throws InputError, ComputationError as `analyse`
Analysis analyse_fit(FitInputs inputs, const AnalysisOptions& options = {});

/// Computes `uncertainty` and `own_design` of an analysis with a fit.
void assess(Analysis& analysis, const UncertaintyOptions& options);

/// Intervals, bootstrap, capture velocities, two-point comparison, identifiability, posterior,
/// budgets and curves of a fit.
UncertaintyResult assess_uncertainty(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                     const UncertaintyOptions& options);

/// The bootstrap only, for bands of predictions: all members except `bootstrap`, `capture` and
/// `options` stay empty.
UncertaintyResult bootstrap_only(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                 const UncertaintyOptions& options);

/// The options of the uncertainty stage: those of the fit file, overridden by `options`.
UncertaintyOptions uncertainty_options(const FitSpec& spec, const AnalysisOptions& options);

/// @throws InputError if `scheme` cannot draw from these data
void require_scheme(const FitSpec& spec, Scheme scheme, const Observations& data);

/// Adds the predictions that only a report shows: mixtures for datasets with a size distribution,
/// and the older capture models.
void add_predictions(Analysis& analysis);

/// The mixture of `sizes` under the fit, with bands of its bootstrap.
/// @param height of the measuring plane [m], where it is not that of `sizes`
/// @param midpoints all spheres of a bin are at its midpoint
/// @param dataset id; the first where it is empty
/// @throws InputError
PolydispersePrediction predict_sizes(const Analysis& analysis, const MeasuredSizes& sizes,
                                     std::optional<double> height, bool midpoints,
                                     const std::string& dataset);

/// The index of the dataset named `id`; 0 if `id` is empty.
/// @throws InputError if there is no such dataset
std::size_t choose_dataset(const std::vector<Dataset>& datasets, const std::string& id);

}  // namespace recoil
