#pragma once

#include <filesystem>
#include <optional>

#include "report/report.hpp"

namespace recoil {

/// What the command line may override in a fit file.
struct AnalysisOptions {
  std::optional<int> replicates;
  bool replicates_auto = false;
  std::optional<Scheme> scheme;
  std::optional<std::uint64_t> seed;
  int threads = 0;
  Solver solver = Solver::fast;
  /// Folder in which a run that is stopped keeps its finished replicates; empty: nowhere.
  std::filesystem::path folder;
};

/// SHA-256 of the file of this program: another build may give other digits. Empty when it cannot
/// be read.
std::string program_stamp();

/// The options of the uncertainty stage: the fit file's, unless the command line says otherwise.
UncertaintyOptions uncertainty_options(const FitSpec& spec, const AnalysisOptions& options);

/// @throws InputError when the scheme that was asked for cannot draw from these data.
void require_scheme(const FitSpec& spec, Scheme scheme, const Observations& data);

/// Removes what a stopped run has left in `folder`, once the results are written.
void forget_replicates(const std::filesystem::path& folder);

/// Reads every dataset of a fit.
std::vector<Dataset> load_datasets(const FitSpec& spec);

/// A fit file and its datasets as they were read.
struct FitInputs {
  FitSpec spec;
  std::vector<Dataset> datasets;
};
FitInputs load_inputs(const std::filesystem::path& fit_file);

/// Which of `datasets` --dataset names; the first when `id` is empty. @throws InputError
std::size_t choose_dataset(const std::vector<Dataset>& datasets, const std::string& id);

/// The pipeline up to the fit: `uncertainty` stays empty.
/// @throws ComputationError when the fit has no usable answer.
Analysis analyse_fit(FitInputs inputs, const AnalysisOptions& options);

/// What a report adds: the mixtures of the datasets that come with a size distribution, and the
/// older capture models.
void add_predictions(Analysis& analysis);

/// And for the fit of one reconstruction whose points come from simulated events: what each
/// correction on the way does.
void add_corrections(Analysis& analysis);

/// The whole pipeline for one fit: data, fit, uncertainty.
/// @throws Interrupted when the user stops it and `options.folder` keeps what was finished.
/// @throws ComputationError when the fit has no usable answer.
Analysis analyse(FitInputs inputs, const AnalysisOptions& options);

}  // namespace recoil
