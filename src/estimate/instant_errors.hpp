#pragma once

#include "estimate/error_source.hpp"

namespace recoil {

/// The errors of the instants t at which successive bounces of a launch were timed. In
///   e_k = (t_(k+2) - t_(k+1)) / (t_(k+1) - t_k)
/// the errors of t_k, t_(k+1) and t_(k+2), independent and of equal size, have coefficients in the
/// ratio 1 : -(1 + 1/e_k) : 1/e_k. They are the whole scatter of e_k, whose standard deviation is
/// stated. Their effect on V is neglected: V de/dV is small compared with e for a ball.
const ErrorSource& instant_error();

}  // namespace recoil
