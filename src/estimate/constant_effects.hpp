#pragma once

#include <cstddef>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"

namespace recoil {

/// How far a fit that holds the constants of the materials goes when one of them is stated one
/// standard deviation higher, to first order:
///   d theta / d c = -(J'J)^-1 J' J_c,
/// J the derivatives of the residuals in the parameters that move, J_c those in the constant
/// (implicit differentiation of J'r = 0, without the second derivatives, as in Gauss-Newton).
/// @param run with the Jacobian and (J'J)^-1 at its end; @param points the number of its points
/// @return [constant][slot], in the units of the slots, the constant's own slot included; empty
///   where fits move the constants or all are exact, or without (J'J)^-1
std::vector<std::vector<double>> constant_effects(const ImpactModel& model,
                                                  const LeastSquaresResult& run,
                                                  std::size_t points);

/// Adds sum_k e_k e_k' of the effects e_k to `covariance` [slots x slots]: the errors of the
/// constants are independent of those of the points and of one another.
void add_constant_effects(const std::vector<std::vector<double>>& effects,
                          std::vector<double>& covariance, double sign = 1.0);

}  // namespace recoil
