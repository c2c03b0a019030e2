#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/names.hpp"
#include "estimate/model.hpp"

namespace recoil {

/// Programs, or kinds of file, to which a fitted impact is exported.
enum class ExportTarget { lammps, liggghts, yade, openfoam, fluent, table };

constexpr auto names_of_values(ExportTarget) {
  return name_list("lammps", "liggghts", "yade", "openfoam", "fluent", "table");
}

/// A sphere and the force between it and a flat, in SI units, which a program for particles can
/// integrate. With the penetration n, a^2 = r n and S as in eq. 5,
///   ring  -K r^(1/2) n^(3/2) (1 + C_H n') + 2 pi a f0 (1 + C_A S) - D n^(1/2) n',
///   jkr, dmt: see JkrLaw and DmtLaw.
struct ContactForce {
  AdhesionLaw adhesion = AdhesionLaw::ring;
  AdhesionDampingPhase phase = AdhesionDampingPhase::rebound;
  double radius = 0.0;            ///< r [m]
  double density = 0.0;           ///< [kg/m3]
  double stiffness = 0.0;         ///< K [Pa]
  double adhesion_force = 0.0;    ///< f0 at this radius [N/m]
  double adhesion_energy = 0.0;   ///< W for this f0, by eqs 9 and 10 [J/m2]
  double hertz_damping = 0.0;     ///< C_H [s/m]
  double adhesion_damping = 0.0;  ///< C_A [s/m]
  double dashpot = 0.0;           ///< D [N s m^(-3/2)], with the ring law only
  bool never_pulls = false;       ///< what K and D multiply together is 0 where it would pull

  double mass() const;  ///< [kg]
  /// JKR: the contact ends at n = -3 u; u = a_p^2 / r, a_p^3 = pi W r^2 / (6 K) [m].
  double jkr_length() const;
};

/// e^2 at every velocity [m/s] under `force` alone, continued below zero for captures.
/// @throws ComputationError if an impact has no result
std::vector<double> squares_under(const ContactForce& force, std::span<const double> velocity);

/// e at every velocity; 0 for captures.
std::vector<double> restitution_under(const ContactForce& force, std::span<const double> velocity);

/// The largest velocity [m/s] between 1e-6 `fastest` and `fastest` at which the e^2 of `square` is
/// zero; 0: there is none.
double capture_velocity_of(const std::function<double(double)>& square, double fastest);

/// The time from first contact to release or to the first outer turning point [s].
double contact_time_under(const ContactForce& force, double velocity);

/// The exported sphere and the range of velocities.
struct ExportRequest {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double slowest = 0.0;   ///< [m/s]
  double fastest = 0.0;   ///< [m/s]
};

/// The fitted impact of one size for other programs. Mechanisms of the measurement are omitted,
/// because they do not change the sphere's motion. `restitution` and `capture_velocity` include the
/// others.
struct ExportedImpact {
  ExportRequest request;
  ContactForce force;             ///< for two spheres: of one on a flat with their R* and m*
  double surface_diameter = 0.0;  ///< of the second sphere [m]; 0: a flat
  /// True if e(V) follows from the force alone. False with mechanisms outside the equation of
  /// motion and for laws that ContactForce does not include.
  bool force_is_all = false;
  std::vector<const Mechanism*> of_nature;
  std::vector<const Mechanism*> of_measurement;  ///< omitted
  std::vector<double> velocity;     ///< log-spaced over the range, `error_velocities` of them
  std::vector<double> restitution;  ///< e there [1]; 0: captured
  bool captures = false;            ///< there is a capture velocity
  double capture_velocity = 0.0;    ///< V* [m/s]
  double shortest_contact = 0.0;    ///< over the range [s], for time steps; of the force alone
  double longest_contact = 0.0;
};

/// The number of velocities for the error of an approximation.
inline constexpr std::size_t error_velocities = 200;

/// If e^2 of `force` and of the model differ by less everywhere, they are equal [1].
inline constexpr double same_square = 1e-8;

/// @throws ComputationError if the model has no result at a velocity of the range
ExportedImpact exported_impact(const ImpactModel& model, std::span<const double> theta,
                               const ExportRequest& request);

/// `theta` with the mechanisms of the measurement at their null values.
std::vector<double> of_nature(const ImpactModel& model, std::vector<double> theta);

/// e^2 of the model without the mechanisms of the measurement, continued below zero for captures.
/// @throws ComputationError if an impact has no result
std::vector<double> squares_of_nature(const ImpactModel& model, std::span<const double> theta,
                                      std::size_t dataset, double diameter,
                                      std::span<const double> velocity);

}  // namespace recoil
