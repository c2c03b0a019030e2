#pragma once

#include <string>
#include <vector>

#include "estimate/fit.hpp"
#include "uncertainty/uncertainty_result.hpp"

namespace recoil {

/// "f0^0.97 C_A^0.25 (the capture velocity: ...)": the product that a direction stands for.
std::string direction_words(const FitResult& fitted, const InformationDirection& direction);

/// Which parameter cannot be told, why, and what to measure.
std::string identifiability_words(const FitResult& fitted, const UncertaintyResult& uncertainty);

/// What has to be known of the whole assessment, one sentence each.
std::vector<std::string> uncertainty_warnings(const UncertaintyResult& uncertainty,
                                              const Observations& data);

}  // namespace recoil
