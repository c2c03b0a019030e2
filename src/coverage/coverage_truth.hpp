#pragma once

#include "coverage/coverage.hpp"
#include "reconstruction/truth.hpp"

namespace recoil {

/// The truth of a coverage study of `spec`.
///
/// Where every dataset is a reconstruction whose recipe uses the model of the fit, it is the
/// recipe's: its parameters, its simulator and its noise, with another seed for every data set.
/// Otherwise the fit's own estimate becomes the truth; the points are simulated at it by the
/// independent simulator of the reconstructions, with the noise that the points state and an error
/// for every setting, where settings share one. Where
/// captures were counted, every impact is simulated, at a velocity that differs from the stated one
/// as much as the estimated spread says (log-normal), and counted again. Where points average over
/// sizes, every impact is that of a sphere of its own size.
/// @throws ComputationError when that fit has no usable answer.
/// @throws InputError when the fit has mechanisms, of which the simulator knows nothing.
CoverageTruth coverage_truth(const FitSpec& spec, const std::vector<Dataset>& datasets,
                             std::uint64_t seed);

/// The fit's own estimate for `datasets`, and the independent simulator's truth of each there.
/// @throws ComputationError when the fit has no usable answer.
struct EstimatedTruth {
  FitResult fitted;
  std::vector<Truth> truths;
};
EstimatedTruth truth_at_estimate(const FitSpec& spec, const std::vector<Dataset>& datasets,
                                 const Observations& data);

}  // namespace recoil
