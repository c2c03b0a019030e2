#pragma once

#include <vector>

#include "estimate/fit.hpp"
#include "uncertainty/interval.hpp"

namespace recoil {

/// Profile-likelihood interval of one slot: all values theta_j for which
///   chi2(theta_j, others refitted) - chi2_min <= q s^2,
/// where q is the `level` quantile of chi-squared with one degree of freedom and s the fit's
/// noise_scale; if the noise is estimated from the residuals, q is the quantile of F(1, dof) (Bates
/// & Watts 1988, Nonlinear Regression Analysis and its Applications, section 6.1.2). Within two
/// standard errors of the parameter's bound q is smaller, see `profile_quantile`. This assumes that
/// the other parameters are away from their bounds. The spread of the impacts (event_spread), if it
/// is estimated, is refitted with the others; other estimated weights are kept.
///
/// Material constants that the fit holds are held here, too; their errors then widen the interval
/// in quadrature, from refits with shifted constants.
///
/// An end that reaches the parameter's bound is that bound: shape `one_sided` for one such end,
/// `flat` for both, `bounded` for none. @pre the slot is free
Interval profile_interval(const FitResult& fitted, std::size_t slot, double level);

/// The profile of one slot from below `interval` to above it, or to the parameter's bounds: up to
/// 29 points including the estimate, in ascending order. A side ends where a refit fails; empty
/// without an interval. @pre the slot is free
std::vector<ProfilePoint> profile_curve(const FitResult& fitted, std::size_t slot, double level,
                                        const Interval& interval);

}  // namespace recoil
