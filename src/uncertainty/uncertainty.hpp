#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "estimate/fit.hpp"
#include "estimate/point_conditions.hpp"
#include "estimate/scheme.hpp"
#include "estimate/two_point.hpp"
#include "uncertainty/information.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/two_point_pairs.hpp"
#include "uncertainty/uncertainty_result.hpp"

namespace recoil {

/// Everything that follows a fit: bootstrap, intervals, capture velocities, bands, two-point
/// spread.
UncertaintyResult assess_uncertainty(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                     const UncertaintyOptions& options);

}  // namespace recoil
