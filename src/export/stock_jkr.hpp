#pragma once

namespace recoil {

/// The contact `granular jkr` of LAMMPS with its damping `viscoelastic`. With the contact radius a
/// and the penetration n = a^2 / R - (4 pi gamma a / E*)^(1/2), E* = 3 K / 4,
///   F = K a^3 / R - (12 pi gamma K a^3)^(1/2) - eta m a n'.
/// It forms at n = 0. It parts where a^3 = 3 pi gamma R^2 / K, which is at the largest pull and not
/// at the smallest n as in JkrLaw: pair_granular.cpp of 29 Sep 2021, Update 2.
struct StockJkr {
  double radius = 0.0;     ///< R [m]
  double mass = 0.0;       ///< m [kg]
  double stiffness = 0.0;  ///< K [Pa]
  double damping = 0.0;    ///< eta [1/(m s)]
  double energy = 0.0;     ///< gamma, half of the work of adhesion [J/m2], > 0

  struct Scales {
    double radius;    ///< a_p, a^3 = pi gamma R^2 / (3 K) [m]
    double length;    ///< u = a_p^2 / R [m]
    double velocity;  ///< U = (K a_p^3 u / (R m))^(1/2) [m/s]
  };
  Scales scales() const;
};

struct StockImpact {
  double restitution_squared = 0.0;  ///< captures: below 0, by the energy at the turning point
  double time = 0.0;                 ///< until the contact parts, or the turning point [s]
};

/// One impact with the velocity V [m/s].
/// @throws ComputationError if it has no result
StockImpact impact_under(const StockJkr& contact, double velocity);

}  // namespace recoil
