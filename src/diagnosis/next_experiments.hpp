#pragma once

#include <vector>

#include "diagnosis/candidate_result.hpp"
#include "diagnosis/next_experiment.hpp"
#include "diagnosis/search.hpp"

namespace recoil {

/// For every two of `rivals` (the best four): the impacts that tell them apart with the fewest
/// events (over the grid of `next_measurements`), and, where the catalogue knows a condition that
/// takes a mechanism away which only one of them has, the same under a change of that condition;
/// and impacts on another target (`target_experiments`). The least effort first, an effort being
/// the number of impacts, of a changed condition `effort_of_a_change` and of another target
/// `effort_of_a_target` more.
///
/// Both predict the mean of n impacts with an error: what the points leave open of their
/// parameters, and how wrong their laws may be there (`predicted_spread`). The expected log odds of
/// the right one of the two is the Kullback-Leibler divergence of the two normal distributions (Box
/// & Hill 1967, Technometrics 9, 57-71), the smaller of both directions; it does not grow without
/// end with n. What takes more than a million impacts is left out.
std::vector<NextExperiment> next_experiments(const SearchBase& base,
                                             const std::vector<const CandidateResult*>& rivals);

inline constexpr int effort_of_a_change = 100;  ///< impacts
/// Mounting a target, and learning what damps the spheres on it beside what is asked [impacts].
inline constexpr int effort_of_a_target = 300;

}  // namespace recoil
