#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/model.hpp"
#include "export/export_job.hpp"

namespace recoil {

/// A parameter of the fit that is exported, as it was found.
struct ExportedParameter {
  std::string label;
  std::string unit;
  double value = 0.0;
  bool free = false;
  std::optional<double> std_error;  ///< none for a fixed one, or one at a bound
};

/// Where the numbers of an export come from.
struct ExportSource {
  std::string fit;         ///< the fit file
  std::string parameters;  ///< "fitted now", or the fit.json
  std::string dataset;     ///< id
  Provenance provenance = Provenance::measured;
  std::vector<ExportedParameter> values;
  double rmse = 0.0;              ///< of e against the points of the fit [1]
  std::optional<double> p_value;  ///< of a misfit that rejects the model
  std::string mean_restitution;   ///< of the points, as a sentence
};

/// What stands at the top of an exported file: which fit, which parameters, what they were fitted
/// to, and what is lost on the way. Plain lines without marks of a comment.
std::vector<std::string> export_heading(ExportTarget target, const ExportSource& source,
                                        const ExportJob& job);

/// What e(V) elsewhere is, as whole sentences: exact or how far off, and what becomes of captures.
std::vector<std::string> export_losses(ExportTarget target, const ExportJob& job);

/// How to run what was written: one line.
std::string export_use(ExportTarget target);

}  // namespace recoil
