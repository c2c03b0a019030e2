#include "cli/analysis.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace recoil {

std::vector<Dataset> load_datasets(const FitSpec& spec) {
  std::vector<Dataset> datasets;
  for (const std::filesystem::path& folder : spec.datasets)
    datasets.push_back(load_dataset(folder));
  return datasets;
}

Analysis analyse(const std::filesystem::path& fit_file, const AnalysisOptions& options) {
  Analysis analysis;
  analysis.spec = load_fit(fit_file);
  UncertaintySpec& uncertainty = analysis.spec.uncertainty;
  uncertainty.replicates = options.replicates.value_or(uncertainty.replicates);
  uncertainty.seed = options.seed.value_or(uncertainty.seed);
  analysis.datasets = load_datasets(analysis.spec);
  ImpactModel model = make_model(analysis.spec, analysis.datasets);
  model.solver = options.solver;
  analysis.fitted = fit(model, gather(analysis.datasets, analysis.spec.noise));
  if (!analysis.fitted.usable) {
    throw ComputationError(fmt::format("{}: the fit has no usable answer: {}", fit_file.string(),
                                       analysis.fitted.failure));
  }
  analysis.data = analysis.fitted.data;
  UncertaintyOptions assess;
  assess.replicates = uncertainty.replicates;
  assess.level = uncertainty.level;
  assess.seed = uncertainty.seed;
  assess.threads = options.threads;
  analysis.uncertainty =
      assess_uncertainty(analysis.fitted, analysis.data, analysis.datasets, assess);
  return analysis;
}

}  // namespace recoil
