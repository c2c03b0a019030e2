#pragma once

#include "coverage/coverage_truth.hpp"
#include "validation/truth/truth.hpp"

namespace recoil {

/// The independent simulator's truth of one dataset at `theta`.
Truth truth_at(const ImpactModel& model, std::span<const double> theta, std::size_t dataset);

/// Spheres of the independent simulator, which shares no code with the fitter, in place of those of
/// the model. @throws InputError for a model that it does not know
TrueImpacts independent_impacts(const ImpactModel& model);

/// `coverage_truth` by the independent simulator. Where every dataset is a reconstruction whose
/// recipe uses the model of the fit, the truth is the recipe's: its parameters, its simulator and
/// its noise, with another seed for every data set. Otherwise it is the fit's own estimate.
/// @throws InputError when the fit has mechanisms or a law that the simulator does not know
CoverageTruth independent_truth(const FitSpec& spec, const std::vector<Dataset>& datasets,
                                std::uint64_t seed);

}  // namespace recoil
