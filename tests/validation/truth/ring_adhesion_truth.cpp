#include "validation/truth/ring_adhesion_truth.hpp"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.hpp"
#include "core/numerics.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

constexpr double tolerance = 1e-12;  // local error, relative to the largest n and to V
constexpr int max_steps = 20000;     // an impact takes about 100

/// Penetration, velocity or time, in the order of each field, and the damped energy [J].
using State = std::array<double, 3>;

/// Acceleration n'' [m/s2] outside contact and within.
double acceleration(const RingAdhesionContact& c, double n, double v) {
  if (n <= 0.0) return 0.0;
  const double hertz = std::sqrt(c.radius) * c.stiffness * n * std::sqrt(n) * (1.0 + c.C_H * v);
  const double damped = v < 0.0 || c.damped_in_both_phases ? -v : 0.0;
  const double adhesion =
      2.0 * pi * std::sqrt(c.radius * n) * c.adhesion_force * (1.0 + c.C_A * damped);
  return (adhesion - hertz) / c.mass;
}

/// What the damping of the adhesion takes out [W].
double adhesion_power(const RingAdhesionContact& c, double n, double v) {
  if (n <= 0.0 || (v >= 0.0 && !c.damped_in_both_phases)) return 0.0;
  return 2.0 * pi * std::sqrt(c.radius * n) * c.adhesion_force * c.C_A * v * v;
}

// The same motion with t, n' or n as the independent variable.
int by_time(double, const double y[], double dydt[], void* data) {
  const auto& contact = *static_cast<const RingAdhesionContact*>(data);
  dydt[0] = y[1];
  dydt[1] = acceleration(contact, y[0], y[1]);
  dydt[2] = adhesion_power(contact, y[0], y[1]);
  return GSL_SUCCESS;
}

/// y = (n, t, loss), independent variable n'.
int by_velocity(double v, const double y[], double dydv[], void* data) {
  const auto& contact = *static_cast<const RingAdhesionContact*>(data);
  const double a = acceleration(contact, y[0], v);
  if (a == 0.0) return GSL_EBADFUNC;
  dydv[0] = v / a;
  dydv[1] = 1.0 / a;
  dydv[2] = adhesion_power(contact, y[0], v) / a;
  return GSL_SUCCESS;
}

/// y = (n', t, loss), independent variable n.
int by_penetration(double n, const double y[], double dydn[], void* data) {
  if (y[0] >= 0.0) return GSL_EBADFUNC;
  const auto& contact = *static_cast<const RingAdhesionContact*>(data);
  dydn[0] = acceleration(contact, n, y[0]) / y[0];
  dydn[1] = 1.0 / y[0];
  dydn[2] = adhesion_power(contact, n, y[0]) / y[0];
  return GSL_SUCCESS;
}

/// GSL's stepper, error control and evolution, owned together.
class Integrator {
 public:
  using Field = int (*)(double, const double[], double[], void*);

  Integrator(Field field, const RingAdhesionContact& contact, State error)
      : contact_(contact),
        system_{field, nullptr, 3, &contact_},
        step_(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 3), &gsl_odeiv2_step_free),
        control_(gsl_odeiv2_control_scaled_new(1.0, tolerance, 1.0, 0.0, error.data(), 3),
                 &gsl_odeiv2_control_free),
        evolve_(gsl_odeiv2_evolve_alloc(3), &gsl_odeiv2_evolve_free) {}

  /// One accepted step towards `end`. @return whether GSL succeeded.
  bool advance(double& x, double end, double& h, State& y) {
    return gsl_odeiv2_evolve_apply(evolve_.get(), control_.get(), step_.get(), &system_, &x, end,
                                   &h, y.data()) == GSL_SUCCESS;
  }

  /// All steps to `end`.
  bool reach(double x, double end, State& y) {
    double h = 0.25 * (end - x);
    for (int i = 0; i < max_steps; ++i) {
      if (x == end) return true;
      if (!advance(x, end, h, y)) return false;
    }
    return false;
  }

 private:
  RingAdhesionContact contact_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)> step_;
  std::unique_ptr<gsl_odeiv2_control, decltype(&gsl_odeiv2_control_free)> control_;
  std::unique_ptr<gsl_odeiv2_evolve, decltype(&gsl_odeiv2_evolve_free)> evolve_;
};

[[noreturn]] void give_up(double velocity, const char* where) {
  throw ComputationError(
      fmt::format("the impact at {:g} m/s could not be integrated {}", velocity, where));
}

}  // namespace

RingAdhesionImpact ring_adhesion_impact(const RingAdhesionContact& contact, double velocity) {
  gsl_errors_are_values();
  // Scales of an undamped Hertz impact without adhesion, for tolerances and the first step.
  const double depth = std::pow(5.0 * contact.mass * velocity * velocity /
                                    (4.0 * std::sqrt(contact.radius) * contact.stiffness),
                                0.4);
  const double duration = depth / velocity;
  const double n_error = tolerance * depth;
  const double v_error = tolerance * velocity;
  const double t_error = tolerance * duration;
  const double energy = 0.5 * contact.mass * velocity * velocity;
  const double loss_error = tolerance * energy;
  const double far = 1e9 * duration;

  RingAdhesionImpact impact;
  double t = 0.0;
  double h = 1e-3 * duration;
  State y = {0.0, velocity, 0.0};

  Integrator motion(by_time, contact, {n_error, v_error, loss_error});
  double before_t = t;
  State before = y;
  int steps = 0;
  while (y[1] > 0.0) {
    before_t = t;
    before = y;
    if (!motion.advance(t, far, h, y) || ++steps > max_steps) give_up(velocity, "to its turning");
  }
  State turning = {before[0], before_t, before[2]};
  if (before[1] > 0.0 && !Integrator(by_velocity, contact, {n_error, t_error, loss_error})
                              .reach(before[1], 0.0, turning)) {
    give_up(velocity, "to its turning");
  }
  impact.deepest = turning[0];

  // The field has a kink at n' = 0 (rebound reading), so the way out starts afresh.
  Integrator retreat(by_time, contact, {n_error, v_error, loss_error});
  t = turning[1];
  y = {turning[0], 0.0, turning[2]};
  h = 1e-3 * duration;
  for (steps = 0; y[0] > 0.0; ++steps) {
    before_t = t;
    before = y;
    if (!retreat.advance(t, far, h, y) || steps > max_steps) give_up(velocity, "to its release");
    if (y[0] > 0.0 && y[1] >= 0.0) {  // turned inwards without leaving
      impact.contact_time = t;
      impact.adhesion_loss = y[2] / energy;
      return impact;
    }
  }
  State release = {before[1], before_t, before[2]};
  impact.rebounded = Integrator(by_penetration, contact, {v_error, t_error, loss_error})
                         .reach(before[0], 0.0, release) &&
                     release[0] < 0.0;
  impact.restitution = impact.rebounded ? -release[0] / velocity : 0.0;
  impact.contact_time = release[1];
  impact.adhesion_loss = release[2] / energy;
  return impact;
}

}  // namespace recoil
