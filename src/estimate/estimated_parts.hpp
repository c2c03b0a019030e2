#pragma once

#include "estimate/fit.hpp"

namespace recoil {

/// Sets the covariance of every part of `result.estimated`: that of the linear estimator by this
/// error alone. With A = J C / s the influence of the whitened residuals (J their Jacobian, C the
/// covariance, s its scale) and B = W A, W the whitening, the scatter of point i causes b_i b_i',
/// and an error that a setting shares, with the loads u, (B'u) (B'u)'.
/// @param run the descent, with J at its end
/// @pre `covariance` is set, without the parts of the spread and of held constants
void set_estimated_parts(FitResult& result, const LeastSquaresResult& run);

}  // namespace recoil
