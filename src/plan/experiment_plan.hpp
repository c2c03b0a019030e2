#pragma once

#include <vector>

#include "estimate/fit_spec.hpp"
#include "plan/plan_result.hpp"

namespace recoil {

/// A plan for the fit `spec` of `datasets` (of `datasets_to_plan`) where the parameters have the
/// values `theta`: the points (V, d) that make the sum of the relative variances least of all free
/// parameters and of the capture velocity of every size, out of 48 velocities of each, linear in
/// the parameters; a part of them evenly spaced in ln V. Never worse in that sum than points that
/// are all so spaced.
/// @param options with velocities where `datasets` have no points of their own
/// @throws InputError where nothing is free, or no velocities are known; ComputationError where the
///   points cannot determine a parameter
ExperimentPlan plan_experiment(const FitSpec& spec, std::vector<Dataset> datasets,
                               const std::vector<double>& theta, PlanOptions options);

}  // namespace recoil
