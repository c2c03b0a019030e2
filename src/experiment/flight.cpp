#include "experiment/flight.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/numerics.hpp"

namespace recoil {
namespace {

constexpr double gas_constant = 287.05;  // of air [J/(kg K)]
constexpr double fastest_launch = 1e6;   // [m/s]
constexpr double root_tolerance = 1e-12;

// The integrals over the velocity use the variable y, in panels of this width: v = v_t (exp(y^2) -
// 1) on the way up and v_t (1 - exp(-y^2)) on the way down. At the last y of the way down, v
// differs from the terminal speed by the relative amount exp(-20.25) = 1.6e-9.
constexpr double panel_width = 0.25;
constexpr double last_y = 4.5;

const std::vector<QuadratureNode>& panel_nodes() {
  static const std::vector<QuadratureNode> nodes = gauss_legendre(10);
  return nodes;
}

}  // namespace

double Air::density() const { return pressure / (gas_constant * temperature); }

double Air::viscosity() const {
  return 1.458e-6 * std::pow(temperature, 1.5) / (temperature + 110.4);
}

double Air::free_path() const {
  return viscosity() / pressure * std::sqrt(std::numbers::pi * gas_constant * temperature / 2.0);
}

SphereDrag sphere_drag(double reynolds) {
  const double viscous = 0.150 * std::pow(reynolds, 0.681);
  const double share = reynolds / (reynolds + 8710.0);
  return {1.0 + viscous + 0.407 / 24.0 * reynolds * share,
          0.681 * viscous / reynolds + 0.407 / 24.0 * share * (2.0 - share)};
}

AirFlight::AirFlight(const Air& air, double diameter, double sphere_density, double gravity)
    : gravity_(gravity),
      reynolds_per_speed_(air.density() * diameter / air.viscosity()),
      stokes_(18.0 * air.viscosity() / (sphere_density * diameter * diameter)) {
  const double knudsen = 2.0 * air.free_path() / diameter;
  stokes_ /= 1.0 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen));
  double high = 1.0;
  while (deceleration(high) < gravity) high *= 2.0;
  double low = high;
  while (deceleration(low) > gravity) low /= 2.0;
  terminal_ = find_root([&](double v) { return deceleration(v) - gravity; }, low, high);
}

double AirFlight::deceleration(double speed) const {
  if (!(speed > 0.0)) return 0.0;
  return stokes_ * speed * sphere_drag(reynolds(speed)).over_stokes;
}

AirFlight::Part AirFlight::rise(double speed) const {
  Part part{0.0, 0.0, speed};
  const double end = std::sqrt(std::log1p(speed / terminal_));
  if (!std::isfinite(end)) {  // the air stops the sphere at once
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {infinity, infinity, speed};
  }
  const auto panels = static_cast<int>(end / panel_width) + 1;
  const double width = end / panels;
  for (int k = 0; k < panels; ++k) {
    for (const QuadratureNode& node : panel_nodes()) {
      const double y = (k + node.at) * width;
      const double v = terminal_ * std::expm1(y * y);
      const double dt =
          node.weight * width * 2.0 * y * (terminal_ + v) / (gravity_ + deceleration(v));
      part.time += dt;
      part.height += v * dt;
    }
  }
  return part;
}

AirFlight::Part AirFlight::fall(double height) const {
  // The contribution of one panel from y over `width`.
  const auto panel = [&](double from, double width) {
    Part part;
    for (const QuadratureNode& node : panel_nodes()) {
      const double y = from + node.at * width;
      const double v = -terminal_ * std::expm1(-y * y);
      const double dt =
          node.weight * width * 2.0 * y * (terminal_ - v) / (gravity_ - deceleration(v));
      part.time += dt;
      part.height += v * dt;
    }
    return part;
  };
  Part done;
  double y = 0.0;
  for (; y < last_y; y += panel_width) {
    const Part next = panel(y, panel_width);
    if (done.height + next.height >= height) break;
    done.time += next.time;
    done.height += next.height;
  }
  if (y >= last_y) {  // the rest at the terminal speed
    return {done.time + (height - done.height) / terminal_, height, terminal_};
  }
  const double width =
      find_root([&](double w) { return done.height + panel(y, w).height - height; }, 0.0,
                panel_width, root_tolerance);
  y += width;
  return {done.time + panel(y - width, width).time, height, -terminal_ * std::expm1(-y * y)};
}

double AirFlight::fall_to_reach(double speed) const {
  if (!(speed < terminal_)) return std::numeric_limits<double>::infinity();
  double high = speed * speed / gravity_;
  while (fall(high).speed < speed) high *= 2.0;
  return find_root([&](double h) { return fall(h).speed - speed; }, 0.5 * speed * speed / gravity_,
                   high, root_tolerance);
}

template <class F>
double AirFlight::launch_for(const F& excess, double least) const {
  if (!(least < fastest_launch)) return std::numeric_limits<double>::infinity();
  double high = 1.5 * least;
  while (excess(high) < 0.0) {
    high *= 2.0;
    if (high > fastest_launch) return std::numeric_limits<double>::infinity();
  }
  if (!std::isfinite(excess(high))) return std::numeric_limits<double>::infinity();
  return find_root(excess, least, high, root_tolerance);
}

double AirFlight::launch_for_duration(double duration) const {
  return launch_for(
      [&](double u) {
        const Part up = rise(u);
        return up.time + fall(up.height).time - duration;
      },
      0.5 * gravity_ * duration);
}

double AirFlight::launch_for_height(double height) const {
  if (!(height > 0.0)) return 0.0;
  return launch_for([&](double u) { return rise(u).height - height; },
                    std::sqrt(2.0 * gravity_ * height));
}

}  // namespace recoil
