#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.hpp"

namespace recoil {

namespace flight {

// Free flight in vacuum between the probe plane and the surface, a height h below it. Velocities
// are magnitudes [m/s], times [s], heights [m]. Air drag is neglected: at 1e-4 Torr it vanishes; in
// air at 1 atm Stokes drag reduces the velocity by 18 mu h / (rho d^2) each way, which is 0.016 m/s
// for a 50 um steel sphere over 1 mm.

/// The speed at the surface for the speed `at_plane` at the plane: v_s^2 = v_p^2 + 2 g h.
inline double surface_velocity(double at_plane, double height) {
  return std::sqrt(at_plane * at_plane + 2.0 * standard_gravity * height);
}

/// The slowest rebound at the surface that reaches the plane: sqrt(2 g h).
inline double slowest_return(double height) { return std::sqrt(2.0 * standard_gravity * height); }

/// The time from the passage down with speed `down` to the passage up with speed `up`:
/// t = (sqrt(down^2 + 2 g h) - down + sqrt(up^2 + 2 g h) - up) / g. The contact time, below a
/// microsecond, is neglected.
inline double round_trip(double down, double up, double height) {
  return (surface_velocity(down, height) - down + surface_velocity(up, height) - up) /
         standard_gravity;
}

/// The height for which `round_trip` takes `time`. With A = g t + down + up it follows from
/// sqrt(down^2 + 2 g h) = (A + (down^2 - up^2) / A) / 2. Negative if no flight takes this time.
inline double implied_height(double down, double up, double time) {
  const double sum = standard_gravity * time + down + up;
  const double at_surface = 0.5 * (sum + (down * down - up * up) / sum);
  return (at_surface * at_surface - down * down) / (2.0 * standard_gravity);
}

/// The longest time from a passage down with speed `down` to the passage of a rebound.
inline double longest_round_trip(double down, double height) {
  return round_trip(down, 0.0, height);
}

/// The time above the plane after a passage up with speed `up`: 2 v / g.
inline double time_above(double up) { return 2.0 * up / standard_gravity; }

}  // namespace flight

/// Still air as an ideal gas.
struct Air {
  double pressure = 101325.0;  ///< [Pa]
  double temperature = 293.0;  ///< [K]

  /// p / (R T) with R = 287.05 J/(kg K) [kg/m3].
  double density() const;
  /// 1.458e-6 T^(3/2) / (T + 110.4) [Pa s], from 100 to 1900 K (U.S. Standard Atmosphere 1976).
  double viscosity() const;
  /// (mu / p) (pi R T / 2)^(1/2) [m].
  double free_path() const;
};

/// Drag of a smooth sphere relative to Stokes drag, Re C_d / 24 [1], and its derivative by Re:
///   C_d = (24 / Re) (1 + 0.150 Re^0.681) + 0.407 / (1 + 8710 / Re),
/// Brown, P. P. & Lawler, D. F. (2003), J. Environ. Eng. 129, 222-231, who give it for Re below
/// 2e5.
struct SphereDrag {
  double over_stokes = 1.0;
  double slope = 0.0;
};
SphereDrag sphere_drag(double reynolds);
inline constexpr double drag_law_reynolds = 2e5;

/// Vertical flights of a sphere through air, m v' = -m g -+ C_d(Re) rho_air pi r^2 v^2 / 2, in
/// which C_d is divided by the slip correction 1 + Kn (1.257 + 0.4 exp(-1.1 / Kn)), Kn = free path
/// / r, so that it vanishes with the pressure. Neglected are spin, buoyancy and added mass; the
/// last two reduce g by 1.5 rho_air / rho: by 0.02 % for steel, and by 2 % for a table-tennis ball,
/// whose V is then 1 to 2 % and whose e is 0.1 to 0.2 % too high.
///
/// Heights and times are integrals over the velocity by Gauss-Legendre rules, in a variable in
/// which the integrands are smooth up to the terminal speed. The relative error is below 1e-8.
class AirFlight {
 public:
  /// @pre air.pressure > 0
  AirFlight(const Air& air, double diameter, double sphere_density, double gravity);
  /// An arbitrary order, for maps.
  bool operator<(const AirFlight& other) const { return constants() < other.constants(); }

  /// The rising or the falling part of a flight.
  struct Part {
    double time = 0.0;    ///< [s]
    double height = 0.0;  ///< [m]
    double speed = 0.0;   ///< at its lower end [m/s]
  };
  /// From a launch with `speed` upward to the highest point.
  Part rise(double speed) const;
  /// From rest over `height` down.
  Part fall(double height) const;

  /// The speed at return to the height of a launch with `speed` [m/s].
  double return_speed(double speed) const { return fall(rise(speed).height).speed; }
  /// The launch speed [m/s] of a flight that returns after `duration` [s], or that rises to
  /// `height` [m]; infinity above 1e6 m/s.
  double launch_for_duration(double duration) const;
  double launch_for_height(double height) const;
  /// The height [m] of a fall that ends with `speed`; infinity from the terminal speed on.
  double fall_to_reach(double speed) const;

  double reynolds(double speed) const { return reynolds_per_speed_ * speed; }
  /// The deceleration by drag [m/s2] at a speed.
  double deceleration(double speed) const;

 private:
  template <class F>
  double launch_for(const F& excess, double least) const;
  std::array<double, 4> constants() const {
    return {gravity_, reynolds_per_speed_, stokes_, terminal_};
  }

  double gravity_ = 0.0;
  double reynolds_per_speed_ = 0.0;
  double stokes_ = 0.0;    ///< deceleration over speed at small Re [1/s]
  double terminal_ = 0.0;  ///< [m/s]
};

}  // namespace recoil
