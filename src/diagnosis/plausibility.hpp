#pragma once

#include <vector>

#include "diagnosis/candidate_result.hpp"

namespace recoil {

inline constexpr double allowed_errors = 2.0;  ///< outside of what is possible [standard errors]

/// The parameters of the mechanisms that `candidate` adds, as `refit` has them, and whether they
/// are possible: within the plausible range of the catalogue, or no more than `errors` standard
/// errors outside, and within their limit relative to the reduced modulus, where they have one.
/// @param noise_scale what the standard deviations of the sample are to be multiplied by
std::vector<FoundParameter> found_parameters(const Candidate& candidate, const Refit& refit,
                                             double noise_scale, double errors = allowed_errors);

/// (J'J)^-1/2 of every moving slot; 0 elsewhere and where J'J is singular [slots].
std::vector<double> standard_errors(const Refit& refit, double noise_scale);

}  // namespace recoil
