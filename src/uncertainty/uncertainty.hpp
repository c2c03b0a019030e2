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
#include "uncertainty/replicate_table.hpp"
#include "uncertainty/uncertainty_result.hpp"

namespace recoil {

/// Everything that follows a fit: bootstrap, intervals, capture velocities, bands, two-point
/// spread.
UncertaintyResult assess_uncertainty(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                     const UncertaintyOptions& options);

/// How many replicates a bootstrap can take: as many as stated, and for `replicates_auto`, which
/// stops when it has enough, the most that it may ask for.
std::size_t replicates_at_most(const UncertaintyOptions& options);

/// The replicates that `options.shard` has to run of `replicates_at_most`.
/// @throws Interrupted as `Bootstrap::extend` does
ReplicateTable shard_of_bootstrap(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                  const UncertaintyOptions& options);

}  // namespace recoil
