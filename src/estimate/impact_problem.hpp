#pragma once

#include <memory>
#include <span>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"
#include "estimate/predictor.hpp"

namespace recoil {

/// The weighted residuals of `data` under `model` as a least-squares problem in the slots of theta:
/// those of the points, less what their settings share (SharedSettings), then for each uncertain
/// constant of the materials how far it lies from its stated value, in standard deviations (times
/// `constants_weight`): the sum of squares is -2 ln of likelihood times prior but for a constant,
/// its minimum the mode of the posterior. Constants that fits do not move are held where they are
/// stated. The problem refers to both arguments: they must outlive
/// it. It and its copies share one work space, so that only one of them may be evaluated at a time.
/// @param handovers when not null, counts the impacts that the fast solver handed over
/// @param points when not null, answers for the points of `data`, for several problems of one model
LeastSquaresProblem impact_problem(const ImpactModel& model, const Observations& data,
                                   long* handovers = nullptr,
                                   std::shared_ptr<PointPredictor> points = nullptr);

/// The deviations of the constants under `theta`, in standard deviations.
std::vector<double> constant_deviations(const ImpactModel& model, const Observations& data,
                                        std::span<const double> theta);

}  // namespace recoil
