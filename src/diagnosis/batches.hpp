#pragma once

#include "diagnosis/candidate_result.hpp"

namespace recoil {

/// Does every series hold one diameter, and every diameter one series? A batch then cannot be told
/// from an effect of size.
bool series_are_sizes(const Observations& data);

/// Are the offsets of `candidate`, a batch effect, the same thing as an unknown law of size? They
/// are where series are sizes and a parabola in ln d, one for each dataset, describes the offsets
/// within their errors (chi^2, p > 0.001): three diameters always have one.
/// @param noise_scale what the standard deviations of the sample are to be multiplied by
bool batch_is_size(const Observations& data, const CandidateResult& candidate, double noise_scale);

}  // namespace recoil
