#pragma once

#include <optional>
#include <span>
#include <vector>

#include "estimate/model.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// Renews whatever in the weights of `data` depends on the parameters, at `theta`: estimated
/// standard deviations (for the present variance function and scale), effective variances, the
/// scatter from impact to impact (event_spread by maximum likelihood). Equations: see `settle`.
/// @returns the predicted e^2 of every point; nothing when the model has no answer somewhere.
std::optional<std::vector<double>> reweigh(const ImpactModel& model, std::span<const double> theta,
                                           Observations& data);

}  // namespace recoil
