#pragma once

#include <vector>

#include "diagnosis/candidate_result.hpp"
#include "diagnosis/search.hpp"

namespace recoil {

/// Sets `set_aside` of every candidate that is not accepted as a cause. Held-out gains are computed
/// for candidates that pass all other tests and are within `reach` (in the criterion) of the best
/// explanation; candidates further behind explain without that test.
void judge(const SearchBase& base, std::vector<CandidateResult>& candidates, double reach,
           const std::vector<Fold>& folds);

/// Does every series hold one diameter, and every diameter one series? A batch effect then cannot
/// be distinguished from an effect of size.
bool series_are_sizes(const Observations& data);

/// Are the offsets of `candidate`, a batch effect, equivalent to an unknown law of size? They are
/// if series are sizes and if a parabola in ln d for each dataset describes the offsets within
/// their errors (chi^2, p > 0.001); for three diameters it always does.
/// @param noise_scale factor on the standard deviations of the sample
bool batch_is_size(const Observations& data, const CandidateResult& candidate, double noise_scale);

/// Allowed distance outside the plausible range [standard errors].
inline constexpr double allowed_errors = 2.0;

/// The parameters of the mechanisms that `candidate` adds, as `refit` has them, and whether they
/// are possible: within the plausible range of the catalogue, or no more than `errors` standard
/// errors outside, and within their limit relative to the reduced modulus, where they have one.
/// @param noise_scale factor on the standard deviations of the sample
std::vector<FoundParameter> found_parameters(const Candidate& candidate, const Refit& refit,
                                             double noise_scale, double errors = allowed_errors);

/// (J'J)^-1/2 of every moving slot; 0 elsewhere and where J'J is singular [slots].
std::vector<double> standard_errors(const Refit& refit, double noise_scale);

}  // namespace recoil
