#include "export/stock_jkr.hpp"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>

#include "core/error.hpp"
#include "core/numerics.hpp"

namespace recoil {
namespace {

// With a = a_p z^2 and n = u (z^4 - 4 z), w = n' / U and dt = (u / U) 4 (z^3 - 1) dsigma, the
// equation of motion is a polynomial:
//   dz/dsigma = w,   dw/dsigma = -4 (z^3 - 1) [z^6 - 6 z^3 + eta z^2 w].
struct Motion {
  double damping = 0.0;     ///< eta [U / (a_p u)]
  bool over_depth = false;  ///< the independent variable is z instead of sigma
};

int rates(double, const double y[], double out[], void* given) {
  const auto& motion = *static_cast<const Motion*>(given);
  const double cube = y[0] * y[0] * y[0];
  const double clock = 4.0 * (cube - 1.0);
  out[0] = y[1];
  out[1] = -clock * (cube * (cube - 6.0) + motion.damping * y[0] * y[0] * y[1]);
  out[2] = clock;
  if (motion.over_depth) std::for_each(out, out + 3, [&](double& rate) { rate /= y[1]; });
  return GSL_SUCCESS;
}

/// The potential energy [m U^2].
double potential(double z) {
  const double cube = z * z * z;
  return 0.4 * z * cube * (cube * cube - 10.0 * cube + 15.0);
}

}  // namespace

StockJkr::Scales StockJkr::scales() const {
  const double parting = std::cbrt(std::numbers::pi * energy * radius * radius / (3.0 * stiffness));
  const double length = parting * parting / radius;
  return {parting, length,
          std::sqrt(stiffness * parting * parting * parting / radius * length / mass)};
}

StockImpact impact_under(const StockJkr& contact, double velocity) {
  constexpr double tolerance = 1e-10;
  constexpr int most_steps = 5000;  // an overdamped sphere creeps without a turning point
  const double parts = std::cbrt(3.0);
  gsl_errors_are_values();
  const auto require = [&](int status) {
    if (status == GSL_SUCCESS) return;
    throw ComputationError(
        fmt::format("the impact at V = {:.6g} m/s under jkr of LAMMPS", velocity));
  };
  const StockJkr::Scales unit = contact.scales();
  const double fast = velocity / unit.velocity;
  Motion motion = {contact.damping * unit.radius * unit.length / unit.velocity, false};
  const gsl_odeiv2_system system = {rates, nullptr, 3, &motion};
  const double first = 0.01 / std::max(fast, 1.0);
  const std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver(
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, first, tolerance, tolerance),
      gsl_odeiv2_driver_free);
  double y[] = {std::cbrt(4.0), fast, 0.0};
  double sigma = 0.0;
  bool outward = false;
  for (int step = 0; step < most_steps && !(outward && y[1] >= 0.0); ++step) {
    double before[3];
    std::copy(std::begin(y), std::end(y), before);
    require(gsl_odeiv2_evolve_apply(driver->e, driver->c, driver->s, &system, &sigma, 1e9,
                                    &driver->h, y));
    outward = outward || y[1] < 0.0;
    if (y[0] > parts || y[1] >= 0.0) continue;
    motion.over_depth = true;
    gsl_odeiv2_driver_reset_hstart(driver.get(), 0.1 * (parts - before[0]));
    double z = before[0];
    require(gsl_odeiv2_driver_apply(driver.get(), &z, parts, before));
    std::copy(before, before + 3, y);
    break;
  }
  const double left = 0.5 * y[1] * y[1] + potential(y[0]) - potential(parts);
  return {2.0 * left / (fast * fast), y[2] * unit.length / unit.velocity};
}

}  // namespace recoil
