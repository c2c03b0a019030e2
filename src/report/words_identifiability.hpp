#pragma once

#include <vector>

#include "document/sentence.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/uncertainty_result.hpp"

namespace recoil {

/// "f0^0.97 C_A^0.25 (the capture velocity: ...)": the product that a direction stands for.
Sentence direction_words(const FitResult& fitted, const InformationDirection& direction);

/// Which parameter cannot be told, why, and what to measure.
Sentence identifiability_words(const FitResult& fitted, const UncertaintyResult& uncertainty);

/// What has to be known of the whole assessment, one sentence each.
std::vector<Sentence> uncertainty_warnings(const UncertaintyResult& uncertainty,
                                           const Observations& data);

}  // namespace recoil
