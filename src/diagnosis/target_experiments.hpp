#pragma once

#include <vector>

#include "diagnosis/candidate_result.hpp"
#include "diagnosis/next_experiment.hpp"
#include "diagnosis/search.hpp"

namespace recoil {

/// For every two of `rivals` the target (`other_targets`) on which the fewest impacts of the same
/// spheres tell them apart; none where a million would not do.
///
/// On a new target nobody knows C_H, C_A and the adhesion (`RivalElsewhere`), and one impact by
/// itself says nothing. The smallest and the largest spheres are therefore made to hit it at six
/// velocities each, evenly spaced in ln V from where all rivals expect e of 0.3 up to the fastest
/// that was measured, as often at each. Both rivals predict the means of n impacts as normal
/// vectors with covariance; the expected log odds of the right one are the Kullback-Leibler
/// divergence of the two, the smaller of both directions, as in `next_experiments`.
std::vector<NextExperiment> target_experiments(const SearchBase& base,
                                               const std::vector<const CandidateResult*>& rivals);

}  // namespace recoil
