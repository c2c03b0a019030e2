#pragma once

#include "core/units.hpp"

namespace recoil {

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

/// Drag coefficient of a smooth sphere [1],
///   C_d = (24 / Re) (1 + 0.150 Re^0.681) + 0.407 / (1 + 8710 / Re),
/// Brown, P. P. & Lawler, D. F. (2003), J. Environ. Eng. 129, 222-231, who give it for Re below
/// 2e5; it is Stokes' law at small Re.
double sphere_drag_coefficient(double reynolds);
inline constexpr double drag_law_reynolds = 2e5;

/// Vertical flights of a sphere through air, m v' = -m g -+ C_d(Re) rho_air pi r^2 v^2 / 2, in
/// which C_d is divided by the slip correction 1 + Kn (1.257 + 0.4 exp(-1.1 / Kn)), Kn = free path
/// / r, so that it vanishes with the pressure. Left out: the buoyancy and the air that the sphere
/// drags along, which lower g by 1.5 rho_air / rho (0.02 % for steel, 2 % for a table-tennis ball,
/// whose V then reads 1 to 2 % and whose e 0.1 to 0.2 % too high), and spin.
///
/// Heights and times are integrals over the velocity, by Gauss-Legendre rules in a variable in
/// which they are smooth up to the terminal speed: relative error below 1e-8.
class AirFlight {
 public:
  /// @pre air.pressure > 0
  AirFlight(const Air& air, double diameter, double sphere_density, double gravity);

  struct Way {
    double time = 0.0;    ///< [s]
    double height = 0.0;  ///< [m]
    double speed = 0.0;   ///< at its lower end [m/s]
  };
  /// From a launch with `speed` upward to the highest point.
  Way rise(double speed) const;
  /// From rest over `height` down.
  Way fall(double height) const;

  /// The speed with which it comes back to where it was launched with `speed`.
  double return_speed(double speed) const { return fall(rise(speed).height).speed; }
  /// The launch from which it is back after `duration` [s], or that climbs to `height` [m]. The
  /// launch of a sphere that the air stops at once can be beyond any number: infinity.
  double launch_for_duration(double duration) const;
  double launch_for_height(double height) const;
  /// The fall that ends with `speed`; infinity from the terminal speed on [m].
  double fall_to_reach(double speed) const;

  double terminal_speed() const { return terminal_; }
  double reynolds(double speed) const { return reynolds_per_speed_ * speed; }

 private:
  double deceleration(double speed) const;
  template <class F>
  double launch_for(const F& excess, double least) const;

  double gravity_ = 0.0;
  double reynolds_per_speed_ = 0.0;
  double drag_factor_ = 0.0;  ///< deceleration over C_d v^2 [1/m]
  double terminal_ = 0.0;     ///< [m/s]
};

}  // namespace recoil
