#pragma once

#include <filesystem>
#include <optional>

#include "report/report.hpp"

namespace recoil {

/// What the command line may override in a fit file.
struct AnalysisOptions {
  std::optional<int> replicates;
  std::optional<std::uint64_t> seed;
  int threads = 0;
  Solver solver = Solver::fast;
};

/// Reads every dataset of a fit.
std::vector<Dataset> load_datasets(const FitSpec& spec);

/// The whole pipeline for one fit: data, fit, uncertainty.
/// @throws ComputationError when the fit has no usable answer.
Analysis analyse(const std::filesystem::path& fit_file, const AnalysisOptions& options);

}  // namespace recoil
