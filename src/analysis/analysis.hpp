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

/// The result of one fit with its uncertainty, and the only input of its page, its text and its
/// JSON.
struct Analysis {
  FitSpec spec;
  std::vector<Dataset> datasets;
  FitResult fitted;
  std::vector<Validity> validity;  ///< where the model holds, the worst point of each dataset
  UncertaintyResult uncertainty;
  std::vector<OwnCoverage> own_design;           ///< empty where it was not simulated
  std::vector<PolydispersePrediction> mixtures;  ///< of datasets that come with a size distribution
  std::vector<CaptureComparison> captures;       ///< beside the older models; may be empty
  std::vector<LawFit> laws;     ///< the fit under its own law and others; may be empty
  std::vector<LossFit> losses;  ///< see FitInputs
};

/// A fit file and its datasets.
struct FitInputs {
  FitSpec spec;  ///< its loss of the dry contact is decided
  std::vector<Dataset> datasets;
  std::vector<LossFit> losses = {};  ///< where the points chose it: every law, the best first
};

/// What a caller may override in a fit file.
struct AnalysisOptions {
  std::optional<int> replicates;
  bool replicates_auto = false;
  std::optional<Scheme> scheme;
  std::optional<std::uint64_t> seed;
  int threads = 0;  ///< 0: all cores. No digit depends on it.
  Solver solver = Solver::fast;
  std::shared_ptr<KeptRows> kept;  ///< see UncertaintyOptions
};

/// What people state: a number of replicates or "auto", the names of a scheme and of a solver. What
/// is empty is that of the fit file.
AnalysisOptions analysis_options(const std::string& replicates, const std::string& scheme,
                                 std::optional<std::uint64_t> seed, int threads,
                                 const std::string& solver);

/// Reads a fit file and every dataset that it names, and chooses the loss (`choose_loss`).
/// @throws InputError
FitInputs load_inputs(const std::filesystem::path& fit_file);
std::vector<Dataset> load_datasets(const FitSpec& spec);

/// The whole pipeline for one fit: data, fit, uncertainty.
/// @throws InputError when the bootstrap's scheme cannot draw from these data.
/// @throws ComputationError when the fit has no usable answer.
Analysis analyse(FitInputs inputs, const AnalysisOptions& options = {});

/// The pipeline up to the fit: `uncertainty` stays empty.
/// @throws InputError, ComputationError as `analyse`
Analysis analyse_fit(FitInputs inputs, const AnalysisOptions& options = {});

/// `uncertainty` and `own_design` of an analysis that has its fit.
void assess(Analysis& analysis, const UncertaintyOptions& options);

/// Intervals, bootstrap, capture velocities, two points against all, identifiability, posterior,
/// budgets and curves of a fit.
UncertaintyResult assess_uncertainty(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                     const UncertaintyOptions& options);

/// The bootstrap only, for bands of predictions: everything but `bootstrap`, `capture` and
/// `options` stays empty.
UncertaintyResult bootstrap_only(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                 const UncertaintyOptions& options);

/// The options of the uncertainty stage: those of the fit file, unless `options` overrides them.
UncertaintyOptions uncertainty_options(const FitSpec& spec, const AnalysisOptions& options);

/// @throws InputError when `scheme` cannot draw from these data.
void require_scheme(const FitSpec& spec, Scheme scheme, const Observations& data);

/// Adds what only a report shows: the mixtures of the datasets that come with a size distribution,
/// and the older capture models.
void add_predictions(Analysis& analysis);

/// The mixture of `sizes` under the fit, with bands of its bootstrap.
/// @param height_mm of the measuring plane [mm], where it is not that of `sizes`
/// @param midpoints all spheres of a bin are at its midpoint
/// @param dataset id; the first where it is empty
/// @throws InputError
PolydispersePrediction predict_sizes(const Analysis& analysis, const MeasuredSizes& sizes,
                                     std::optional<double> height_mm, bool midpoints,
                                     const std::string& dataset);

/// The index of the dataset named `id`; 0 when `id` is empty.
/// @throws InputError when there is none
std::size_t choose_dataset(const std::vector<Dataset>& datasets, const std::string& id);

}  // namespace recoil
