#include "validation/truth/impact_truth.hpp"

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

constexpr double tolerance = 1e-12;  // local error, relative to the scale of each component
constexpr int most_steps = 20000;    // an impact takes about 100

/// The state: contact radius, n', time and the energy that the damped adhesion took [J].
enum Component : std::size_t { width, speed, time, taken };
using State = std::array<double, 4>;

/// The component that the others are functions of, or the path itself.
enum class Along { path, speed, width };

struct Motion {
  TrueContact contact;
  Along along;
};

/// dn / da.
double opening(const TrueContact& c, double radius) {
  const double sphere = 2.0 * radius / c.radius;
  return c.law == TrueAdhesion::jkr && c.adhesion > 0.0
             ? sphere - std::sqrt(2.0 * pi * c.adhesion / (3.0 * c.stiffness * radius))
             : sphere;
}

/// F_a [N].
double adhesion(const TrueContact& c, double radius) {
  switch (c.law) {
    case TrueAdhesion::ring:
      return 2.0 * pi * radius * c.adhesion;
    case TrueAdhesion::jkr:
      return std::sqrt(6.0 * pi * c.adhesion * c.stiffness * radius * radius * radius);
    case TrueAdhesion::dmt:
      return 2.0 * pi * c.adhesion * c.radius;
  }
  return 0.0;
}

/// Change of the state per unit of the path.
State along_path(const TrueContact& c, const State& y) {
  const double elastic = c.stiffness * y[width] * y[width] * y[width] / c.radius;
  const double pull = adhesion(c, y[width]);
  const double damped = y[speed] < 0.0 || c.damped_in_both_phases ? -y[speed] : 0.0;
  const double force = pull * (1.0 + c.C_A * damped) - elastic * (1.0 + c.C_H * y[speed]);
  const double slope = opening(c, y[width]);
  return {y[speed], force / c.mass * slope, slope, pull * c.C_A * damped * damped * slope};
}

int field(double x, const double now[], double slopes[], void* data) {
  const auto& motion = *static_cast<const Motion*>(data);
  State y = {now[width], now[speed], now[time], now[taken]};
  if (motion.along == Along::speed) y[speed] = x;
  if (motion.along == Along::width) y[width] = x;
  const State change = along_path(motion.contact, y);
  const double unit = motion.along == Along::path    ? 1.0
                      : motion.along == Along::speed ? change[speed]
                                                     : change[width];
  if (unit == 0.0 || (motion.along == Along::width && unit > 0.0)) return GSL_EBADFUNC;
  for (std::size_t i = 0; i < change.size(); ++i) slopes[i] = change[i] / unit;
  return GSL_SUCCESS;
}

/// GSL's stepper, error control and evolution, owned together.
class Integrator {
 public:
  Integrator(const TrueContact& contact, Along along, const State& error)
      : motion_{contact, along},
        system_{field, nullptr, error.size(), &motion_},
        step_(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, error.size()), &gsl_odeiv2_step_free),
        control_(
            gsl_odeiv2_control_scaled_new(1.0, tolerance, 1.0, 0.0, error.data(), error.size()),
            &gsl_odeiv2_control_free),
        evolve_(gsl_odeiv2_evolve_alloc(error.size()), &gsl_odeiv2_evolve_free) {}
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// One accepted step towards `end`. @return whether GSL succeeded.
  bool advance(double& x, double end, double& h, State& y) {
    return gsl_odeiv2_evolve_apply(evolve_.get(), control_.get(), step_.get(), &system_, &x, end,
                                   &h, y.data()) == GSL_SUCCESS;
  }

  /// All steps to `end`.
  bool reach(double x, double end, State& y) {
    double h = 0.25 * (end - x);
    for (int i = 0; i < most_steps; ++i) {
      if (x == end) return true;
      if (!advance(x, end, h, y)) return false;
    }
    return false;
  }

 private:
  Motion motion_;
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

TrueImpact true_impact(const TrueContact& c, double velocity) {
  gsl_errors_are_values();
  const bool jkr = c.law == TrueAdhesion::jkr;
  const double volume = pi * c.adhesion * c.radius * c.radius / c.stiffness;
  const double touch = jkr ? std::cbrt(8.0 / 3.0 * volume) : 0.0;  // n = 0
  const double parting = jkr ? std::cbrt(volume / 6.0) : 0.0;      // dn / da = 0
  // Scales: an undamped Hertz impact, and the contact at rest.
  const double depth =
      std::pow(5.0 * c.mass * velocity * velocity / (4.0 * std::sqrt(c.radius) * c.stiffness), 0.4);
  const double rest = c.law == TrueAdhesion::ring
                          ? std::sqrt(2.0 * pi * c.adhesion * c.radius / c.stiffness)
                          : std::cbrt(6.0 * volume);
  const double size = std::max(std::sqrt(depth * c.radius), rest);
  const double energy = 0.5 * c.mass * velocity * velocity;
  const State error = {tolerance * size, tolerance * velocity, tolerance * depth / velocity,
                       tolerance * energy};
  const double unit = size / velocity;  // of the path

  double path = 0.0;
  double h = 1e-3 * unit;
  State y = {touch, velocity, 0.0, 0.0};
  State before = y;
  Integrator in(c, Along::path, error);
  for (int steps = 0; y[speed] > 0.0; ++steps) {
    before = y;
    if (!in.advance(path, 1e9 * unit, h, y) || steps > most_steps) {
      give_up(velocity, "to its turning");
    }
  }
  y = before;
  if (!Integrator(c, Along::speed, error).reach(before[speed], 0.0, y)) {
    give_up(velocity, "to its turning");
  }
  TrueImpact impact;
  impact.deepest = y[width] * y[width] / c.radius;
  if (jkr) impact.deepest -= std::sqrt(8.0 * pi * c.adhesion * y[width] / (3.0 * c.stiffness));

  // The field has a kink at n' = 0 where only the rebound is damped: the way out starts afresh.
  Integrator out(c, Along::path, error);
  path = 0.0;
  h = 1e-3 * unit;
  y[speed] = 0.0;
  bool turned = false;  // inwards again, without leaving
  for (int steps = 0; y[width] > parting && !turned; ++steps) {
    before = y;
    if (!out.advance(path, 1e9 * unit, h, y) || steps > most_steps) {
      give_up(velocity, "to its release");
    }
    turned = y[width] > parting && y[speed] >= 0.0;
  }
  if (!turned) {
    y = before;
    impact.rebounded =
        Integrator(c, Along::width, error).reach(before[width], parting, y) && y[speed] < 0.0;
    impact.restitution = impact.rebounded ? -y[speed] / velocity : 0.0;
  }
  impact.contact_time = y[time];
  impact.adhesion_loss = y[taken] / energy;
  return impact;
}

}  // namespace recoil
