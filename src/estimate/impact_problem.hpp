#pragma once

#include <memory>
#include <span>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"
#include "estimate/predictor.hpp"
#include "estimate/weights.hpp"

namespace recoil {

/// The weighted residuals of `data` under `model` as a least-squares problem in the slots of theta.
/// The residuals of the points come first, whitened for shared errors (SharedErrors). One
/// residual for each uncertain material constant follows: its deviation from the stated value in
/// standard deviations, times Noise::constants_weight. The sum of squares is -2 ln (likelihood
/// times prior) up to a constant, and its minimum is the mode of the posterior. Constants that fits
/// do not move keep their stated values.
///
/// The problem refers to `model`, `data` and `weights`, which must outlive it. It and its copies
/// share one work space, so that only one of them may be evaluated at a time.
/// @param points when not null, the predictor to use for the points of `data`; several problems of
///   one model may share it
LeastSquaresProblem impact_problem(const ImpactModel& model, const Observations& data,
                                   const Weights& weights,
                                   std::shared_ptr<PointPredictor> points = nullptr);

/// Deviations of the uncertain constants under `theta` from their stated values, in standard
/// deviations [constants].
std::vector<double> constant_deviations(const ImpactModel& model, const Observations& data,
                                        std::span<const double> theta);

}  // namespace recoil
