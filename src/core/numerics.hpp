#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace recoil {

/// A root of the continuous `function` between `lower` and `upper` by Brent's method (GSL). NaN if
/// the values at the ends have the same sign or are NaN.
/// @param tolerance relative error of the root [1]
double find_root(const std::function<double(double)>& function, double lower, double upper,
                 double tolerance = 1e-14);

/// The minimum of `function`, which falls and then rises, between `lower` and `upper` by golden
/// section search. It assumes no parabola, because weighted deviances are none.
/// @param tolerance absolute error, in the unit of the argument
double find_minimum(const std::function<double(double)>& function, double lower, double upper,
                    double tolerance);

/// `count` values from `first` to `last` with equal ratios. @pre count >= 2, both positive
std::vector<double> log_spaced(double first, double last, std::size_t count);

struct QuadratureNode {
  double at = 0.0;
  double weight = 0.0;
};

/// Points and weights of the Gauss-Legendre rule with `count` nodes on [0, 1], ascending (GSL's
/// table): exact for polynomials up to degree 2 count - 1.
std::vector<QuadratureNode> gauss_legendre(std::size_t count);

/// Makes GSL report errors by return codes instead of aborting the process. May be called from any
/// thread and more than once.
void gsl_errors_are_values();

}  // namespace recoil
