#pragma once

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <memory>
#include <string>

#include "core/error.hpp"
#include "core/gsl_errors.hpp"

namespace recoil {

/// The root of `function` (double -> double) in [lower, upper] by Brent's method, to a relative
/// width of `tolerance`.
/// @throws ComputationError when the ends have the same sign; `what` says which quantity it was.
template <class Function>
double find_root(Function function, double lower, double upper, const std::string& what,
                 double tolerance = 1e-14) {
  gsl_errors_are_values();
  const double at_lower = function(lower);
  const double at_upper = function(upper);
  if (at_lower == 0.0) return lower;
  if (at_upper == 0.0) return upper;
  if (!(at_lower * at_upper < 0.0)) throw ComputationError("no bracket for " + what);

  gsl_function wrapped{[](double x, void* data) { return (*static_cast<Function*>(data))(x); },
                       &function};
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  if (gsl_root_fsolver_set(solver.get(), &wrapped, lower, upper) != GSL_SUCCESS) {
    throw ComputationError("cannot search for " + what);
  }
  for (int iteration = 0; iteration < 200; ++iteration) {
    if (gsl_root_fsolver_iterate(solver.get()) != GSL_SUCCESS) break;
    const double left = gsl_root_fsolver_x_lower(solver.get());
    const double right = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(left, right, 0.0, tolerance) == GSL_SUCCESS) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

}  // namespace recoil
