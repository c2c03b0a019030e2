#pragma once

#include "uncertainty/uncertainty_result.hpp"

namespace recoil {

/// Everything that follows a fit: bootstrap, intervals, capture velocities, bands, two-point
/// spread.
UncertaintyResult assess_uncertainty(const FitResult& fitted, const Observations& data,
                                     const std::vector<Dataset>& datasets,
                                     const UncertaintyOptions& options);

}  // namespace recoil
