#pragma once

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// The weighted residuals of `data` under `model` as a least-squares problem in the slots of theta.
/// The problem refers to both arguments: they must outlive it. It and its copies share one work
/// space, so that only one of them may be evaluated at a time.
/// @param handovers when not null, counts the impacts that the fast solver handed over
LeastSquaresProblem impact_problem(const ImpactModel& model, const Observations& data,
                                   long* handovers = nullptr);

}  // namespace recoil
