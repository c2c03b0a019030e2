#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace recoil {

/// Searches in one dimension. What is not here has a reason that stands beside it: loops that the
/// solver runs by the million, steps that carry derivatives, and functions each value of which is
/// a fit that may fail.

/// A root of the continuous `function` between `lower` and `upper`, to a relative `tolerance` of
/// its place [1], by Brent's method (GSL). The end where it is zero when it is zero there; NaN when
/// the values at the ends have the same sign, or are none.
double find_root(const std::function<double(double)>& function, double lower, double upper,
                 double tolerance = 1e-14);

/// Where `function`, which falls and then rises, is smallest between `lower` and `upper`, to within
/// `tolerance` (in the units of its argument), by the golden section: one new value for each
/// narrowing by 0.618, and no assumption of a parabola, which weighted deviances are not.
double find_minimum(const std::function<double(double)>& function, double lower, double upper,
                    double tolerance);

struct QuadratureNode {
  double at = 0.0;
  double weight = 0.0;
};

/// Points and weights of the Gauss-Legendre rule with `count` nodes on [0, 1], ascending (GSL's
/// table): exact for polynomials up to degree 2 count - 1.
std::vector<QuadratureNode> gauss_legendre(std::size_t count);

/// Makes GSL report by return codes instead of aborting the process; once per process, from any
/// thread. Every caller of GSL here checks what it gets back.
void gsl_errors_are_values();

}  // namespace recoil
