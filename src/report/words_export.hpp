#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/model.hpp"
#include "export/export_job.hpp"

namespace recoil {

/// A parameter of the exported fit.
struct ExportedParameter {
  std::string label;
  std::string unit;
  double value = 0.0;
  bool free = false;
  std::optional<double> std_error;  ///< nullopt for a fixed parameter, or one at a bound
};

/// The source of an export.
struct ExportSource {
  std::string fit;         ///< the fit file
  std::string parameters;  ///< "fitted by all of its points", or "from FIT.json"
  std::string dataset;     ///< id
  Provenance provenance = Provenance::measured;
  std::vector<ExportedParameter> values;
  double rmse = 0.0;   ///< rms residual of e [1]
  std::string misfit;  ///< if the points reject exact laws: the verdict and what was measured
};

/// The heading of an exported file: fit, parameters, dataset, and the error of the export. Lines
/// without comment marks.
std::vector<std::string> export_heading(ExportTarget target, const ExportSource& source,
                                        const ExportJob& job);

/// How to use the exported files, in one line.
std::string export_use(ExportTarget target);

}  // namespace recoil
