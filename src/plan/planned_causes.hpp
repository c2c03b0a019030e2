#pragma once

#include <vector>

#include "estimate/fit_spec.hpp"
#include "plan/plan_result.hpp"

namespace recoil {

/// Every mechanism that may act under the conditions of the planned datasets, at the strength at
/// which the search for causes starts (where the catalogue says that it is possible, else at the
/// nearest that is), and whether the settings of `plan` would show it and tell it from the others.
///
/// With y the effect on e^2 of what is true, in standard deviations of the planned points, a rival
/// leaves of it, at first order,
///   chi2 = min over b, k of |y - X b - k z|^2 under the covariance of the errors of both laws and
///   of the base model (`LawErrors`, [diagnosis] law_error),
/// X the slopes in the parameters of the fit and z the effect of the rival, k within what it can be
/// (and without z: the base model). ln of the odds that are to be expected is chi2 / 2.
///
/// What is not told apart gets the cheapest remedy: more points at one of the settings or beyond
/// them (0.7 times the slowest to 1.5 times the fastest velocity, 0.6 times the smallest to 1.6
/// times the largest size), the same under a condition that takes one of the two away, which costs
/// `effort_of_a_change` impacts on top, or impacts on another target (`PlannedTarget`), which costs
/// `effort_of_a_target`; no more than 10000 impacts. The steps are chosen one
/// by one, each the one that does most of what is left for at most three times the least effort.
/// Laws of one cause are not compared, nor descriptions; what moves each series by itself is left
/// out, as nobody plans for it, and so is what spreads the impacts of a point where
/// PlanOptions::spread does so already.
PlannedCauses planned_causes(const FitSpec& spec, const ExperimentPlan& plan);

}  // namespace recoil
