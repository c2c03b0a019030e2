#pragma once

#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "document/document.hpp"

namespace recoil {

/// Where the base model is too high or too low, over velocity and diameter; one per dataset.
std::vector<Figure> misfit_figures(const Diagnosis& diagnosis);

/// The candidates by what they gain, with what speaks against them; none without a search.
std::vector<Figure> ranking_figures(const Diagnosis& diagnosis);

/// e(V) of the points under the base and the extended model; one per dataset, none without one.
std::vector<Figure> before_after_figures(const Diagnosis& diagnosis);

}  // namespace recoil
