#pragma once

#include <optional>
#include <span>
#include <vector>

#include "estimate/model.hpp"
#include "estimate/observations.hpp"
#include "estimate/predictor.hpp"

namespace recoil {

/// Renews whatever in the weights of `data` depends on the parameters, at `theta`: estimated
/// standard deviations (for the present variance function and scale), effective variances, the
/// scatter from impact to impact (event_spread by maximum likelihood), and what settings share.
/// Equations: see `reweighted_fit`.
/// @param points answers for the points of `data`
/// @returns the predicted e^2 of every point; nothing when the model has no answer somewhere.
std::optional<std::vector<double>> renew_weights(const ImpactModel& model,
                                                 std::span<const double> theta,
                                                 PointPredictor& points, Observations& data);

/// Renews only the scatter from impact to impact: event_spread by maximum likelihood at `theta`,
/// and what follows from it for the points; standard deviations and effective variances stay.
/// Nothing happens where no point has both rebounds and captures.
/// @returns false when the model has no answer somewhere
bool renew_event_spread(const ImpactModel& model, std::span<const double> theta,
                        Observations& data);

/// What not knowing event_spread adds to the covariance (J'J)^-1 of an estimate: with T = -2 ln
/// likelihood, g = d^2 T / (d theta d ln omega) / 2, h = d^2 T / (d ln omega)^2 / 2 and C =
/// (J'J)^-1,
///   v b b',  b = -C g = d theta / d ln omega,  v = 1 / (h - g'C g) the variance of ln omega,
/// the joint information of both inverted by blocks [p x p]. Empty where event_spread is not in
/// use, or C is empty. Derivatives are differences over a tenth of ln omega; v is at most 1 (a
/// factor e).
std::vector<double> event_spread_covariance(const ImpactModel& model, std::span<const double> theta,
                                            const Observations& data, std::span<const double> C);

/// What the sum of squared residuals lacks of -2 ln likelihood while event_spread changes (and
/// nothing else): sum over the points with scatter and rebounds of D(peak) + 2 ln mean_sd.
double event_spread_offset(const Observations& data);

}  // namespace recoil
