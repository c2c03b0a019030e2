#include "core/numerics.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_roots.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

namespace recoil {

void gsl_errors_are_values() {
  static std::once_flag once;
  std::call_once(once, [] { gsl_set_error_handler_off(); });
}
namespace {

using Function = std::function<double(double)>;

double call(double x, void* function) { return (*static_cast<const Function*>(function))(x); }

}  // namespace

double find_root(const Function& function, double lower, double upper, double tolerance) {
  gsl_errors_are_values();
  const double at_lower = function(lower);
  const double at_upper = function(upper);
  if (at_lower == 0.0) return lower;
  if (at_upper == 0.0) return upper;
  if (!((at_lower < 0.0 && at_upper > 0.0) || (at_lower > 0.0 && at_upper < 0.0))) return NAN;

  gsl_function wrapped{call, const_cast<Function*>(&function)};
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), &gsl_root_fsolver_free);
  if (gsl_root_fsolver_set(solver.get(), &wrapped, lower, upper) != GSL_SUCCESS) return NAN;
  constexpr int most_steps = 200;  // halving alone takes 60 to the last digit
  for (int step = 0; step < most_steps; ++step) {
    if (gsl_root_fsolver_iterate(solver.get()) != GSL_SUCCESS) return NAN;
    const double left = gsl_root_fsolver_x_lower(solver.get());
    const double right = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(left, right, 0.0, tolerance) == GSL_SUCCESS) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

double find_minimum(const Function& function, double lower, double upper, double tolerance) {
  constexpr double golden = std::numbers::phi - 1.0;
  double x1 = upper - golden * (upper - lower);
  double x2 = lower + golden * (upper - lower);
  double f1 = function(x1);
  double f2 = function(x2);
  while (upper - lower > tolerance) {
    if (f1 < f2) {
      upper = x2;
      x2 = x1;
      f2 = f1;
      x1 = upper - golden * (upper - lower);
      f1 = function(x1);
    } else {
      lower = x1;
      x1 = x2;
      f1 = f2;
      x2 = lower + golden * (upper - lower);
      f2 = function(x2);
    }
  }
  return 0.5 * (lower + upper);
}

std::vector<double> log_spaced(double first, double last, std::size_t count) {
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) {
    values.push_back(
        first * std::pow(last / first, static_cast<double>(k) / static_cast<double>(count - 1)));
  }
  return values;
}

std::vector<QuadratureNode> gauss_legendre(std::size_t count) {
  const std::unique_ptr<gsl_integration_glfixed_table,
                        decltype(&gsl_integration_glfixed_table_free)>
      table(gsl_integration_glfixed_table_alloc(count), &gsl_integration_glfixed_table_free);
  std::vector<QuadratureNode> nodes(count);
  for (std::size_t i = 0; i < count; ++i) {
    gsl_integration_glfixed_point(0.0, 1.0, i, &nodes[i].at, &nodes[i].weight, table.get());
  }
  return nodes;
}

}  // namespace recoil
