#include "validation/truth/adhesive_truth.hpp"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.hpp"
#include "core/numerics.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

constexpr double adhesive_tolerance = 1e-12;  // local error, relative to the scales of a and n'
constexpr int most_adhesive_steps = 20000;    // an impact takes about 100

/// dn / da.
double opening(const AdhesiveContact& c, double a) {
  const double sphere = 2.0 * a / c.radius;
  return c.jkr && c.work > 0.0 ? sphere - std::sqrt(2.0 * pi * c.work / (3.0 * c.stiffness * a))
                               : sphere;
}

/// d n' / d (path), the path being that on which a changes by n' per unit: n'' dn / da.
double push_along(const AdhesiveContact& c, double a, double v) {
  const double cube = c.stiffness * a * a * a;
  const double elastic = cube / c.radius;
  const double adhesive =
      c.jkr ? std::sqrt(6.0 * pi * c.work * cube) : 2.0 * pi * c.work * c.radius;
  const double damped = v < 0.0 || c.damped_in_both_phases ? -v : 0.0;
  const double force = adhesive * (1.0 + c.C_A * damped) - elastic * (1.0 + c.C_H * v);
  return force / c.mass * opening(c, a);
}

const AdhesiveContact& contact_of(void* data) { return *static_cast<const AdhesiveContact*>(data); }

/// y = (a, n') along the path.
int along_path(double, const double y[], double slopes[], void* data) {
  slopes[0] = y[1];
  slopes[1] = push_along(contact_of(data), y[0], y[1]);
  return GSL_SUCCESS;
}

/// y = (a, unused), independent variable n'.
int to_rest(double v, const double y[], double slopes[], void* data) {
  const double push = push_along(contact_of(data), y[0], v);
  if (push == 0.0) return GSL_EBADFUNC;
  slopes[0] = v / push;
  slopes[1] = 0.0;
  return GSL_SUCCESS;
}

/// y = (n', unused), independent variable a.
int to_release(double a, const double y[], double slopes[], void* data) {
  if (y[0] >= 0.0) return GSL_EBADFUNC;
  slopes[0] = push_along(contact_of(data), a, y[0]) / y[0];
  slopes[1] = 0.0;
  return GSL_SUCCESS;
}

class AdhesivePath {
 public:
  using Field = int (*)(double, const double[], double[], void*);
  using Pair = std::array<double, 2>;

  AdhesivePath(Field field, const AdhesiveContact& contact, Pair error)
      : contact_(contact),
        system_{field, nullptr, 2, &contact_},
        step_(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2), &gsl_odeiv2_step_free),
        control_(gsl_odeiv2_control_scaled_new(1.0, adhesive_tolerance, 1.0, 0.0, error.data(), 2),
                 &gsl_odeiv2_control_free),
        evolve_(gsl_odeiv2_evolve_alloc(2), &gsl_odeiv2_evolve_free) {}

  bool advance(double& x, double end, double& h, Pair& y) {
    return gsl_odeiv2_evolve_apply(evolve_.get(), control_.get(), step_.get(), &system_, &x, end,
                                   &h, y.data()) == GSL_SUCCESS;
  }

  bool reach(double x, double end, Pair& y) {
    double h = 0.25 * (end - x);
    for (int i = 0; i < most_adhesive_steps; ++i) {
      if (x == end) return true;
      if (!advance(x, end, h, y)) return false;
    }
    return false;
  }

 private:
  AdhesiveContact contact_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)> step_;
  std::unique_ptr<gsl_odeiv2_control, decltype(&gsl_odeiv2_control_free)> control_;
  std::unique_ptr<gsl_odeiv2_evolve, decltype(&gsl_odeiv2_evolve_free)> evolve_;
};

[[noreturn]] void no_end(double velocity) {
  throw ComputationError(
      fmt::format("the adhesive impact at {:g} m/s could not be integrated", velocity));
}

}  // namespace

double adhesive_restitution(const AdhesiveContact& c, double velocity) {
  gsl_errors_are_values();
  const double volume = pi * c.work * c.radius * c.radius / c.stiffness;
  const double touch = c.jkr ? std::cbrt(8.0 / 3.0 * volume) : 0.0;  // n = 0
  const double parting = c.jkr ? std::cbrt(volume / 6.0) : 0.0;      // dn / da = 0
  // a^2 / r of an undamped Hertz impact, and the contact at rest.
  const double hertz =
      std::pow(5.0 * c.mass * velocity * velocity / (4.0 * std::sqrt(c.radius) * c.stiffness), 0.4);
  const double size = std::max(std::sqrt(hertz * c.radius), std::cbrt(6.0 * volume));
  const double a_error = adhesive_tolerance * size;
  const double v_error = adhesive_tolerance * velocity;
  const double far = 1e9 * size / velocity;
  double path = 0.0;
  double h = 1e-3 * size / velocity;
  AdhesivePath::Pair y = {touch, velocity};
  AdhesivePath::Pair before = y;

  AdhesivePath in(along_path, c, {a_error, v_error});
  for (int steps = 0; y[1] > 0.0; ++steps) {
    before = y;
    if (!in.advance(path, far, h, y) || steps > most_adhesive_steps) no_end(velocity);
  }
  AdhesivePath::Pair turning = {before[0], 0.0};
  if (!AdhesivePath(to_rest, c, {a_error, 1.0}).reach(before[1], 0.0, turning)) no_end(velocity);

  AdhesivePath out(along_path, c, {a_error, v_error});
  y = {turning[0], 0.0};
  path = 0.0;
  h = 1e-3 * size / velocity;
  for (int steps = 0; y[0] > parting; ++steps) {
    before = y;
    if (!out.advance(path, far, h, y) || steps > most_adhesive_steps) no_end(velocity);
    if (y[0] > parting && y[1] >= 0.0) return 0.0;
  }
  AdhesivePath::Pair release = {before[1], 0.0};
  const bool back =
      AdhesivePath(to_release, c, {v_error, 1.0}).reach(before[0], parting, release) &&
      release[0] < 0.0;
  return back ? -release[0] / velocity : 0.0;
}

}  // namespace recoil
