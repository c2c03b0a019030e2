#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "report/figures.hpp"

namespace recoil {

/// The answer in one line, without a full stop.
std::string headline(const Diagnosis& diagnosis);

/// `diagnosis.json`. Indented, ends with a newline, no NaN: what has no number is null.
std::string diagnosis_json(const Diagnosis& diagnosis);

/// What `recoil diagnose` prints: the answer, the tests, the map, the ranking, the gain. At most
/// 100 columns.
std::string diagnosis_text(const Diagnosis& diagnosis);

/// One self-contained page for someone who was not there: the answer in words, the misfit, the
/// ranking, the fit before and after, what was gained.
/// @throws ComputationError when gnuplot cannot be run.
std::string diagnosis_html(const Diagnosis& diagnosis);

/// Where the base model is too high or too low, over velocity and diameter; one per dataset.
std::vector<Figure> misfit_figures(const Diagnosis& diagnosis);

/// The candidates by what they gain, with what speaks against them; none without a search.
std::vector<Figure> ranking_figures(const Diagnosis& diagnosis);

/// e(V) of the points under the base and the extended model; one per dataset, none without one.
std::vector<Figure> before_after_figures(const Diagnosis& diagnosis);

}  // namespace recoil
