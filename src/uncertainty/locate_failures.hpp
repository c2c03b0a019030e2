#pragma once

#include <cstdint>
#include <vector>

#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {

/// Finds out which data made the replicates of `index` fail: the points whose mean disturbance in
/// them is furthest, in its standard errors, from that in the other replicates below `replicates`.
FailedReplicates locate_failures(const ResamplingPlan& plan, std::uint64_t seed, int replicates,
                                 std::vector<std::uint64_t> index);

}  // namespace recoil
