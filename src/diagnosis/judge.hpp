#pragma once

#include <vector>

#include "diagnosis/candidate_result.hpp"
#include "diagnosis/search.hpp"

namespace recoil {

/// Says of every candidate why it is not a cause, or nothing. Held-out gains are computed for those
/// that pass everything else and are no more than `reach` (of the criterion) behind the best
/// explanation; what is further behind explains without that test.
void judge(const SearchBase& base, std::vector<CandidateResult>& candidates, double reach,
           const std::vector<Fold>& folds);

/// Does every series hold one diameter, and every diameter one series? A batch then cannot be told
/// from an effect of size.
bool series_are_sizes(const Observations& data);

/// Are the offsets of `candidate`, a batch effect, the same thing as an unknown law of size? They
/// are where series are sizes and a parabola in ln d, one for each dataset, describes the offsets
/// within their errors (chi^2, p > 0.001): three diameters always have one.
/// @param noise_scale what the standard deviations of the sample are to be multiplied by
bool batch_is_size(const Observations& data, const CandidateResult& candidate, double noise_scale);

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
