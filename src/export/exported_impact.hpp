#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "estimate/model.hpp"

namespace recoil {

/// Programs, or kinds of file, to which a fitted impact goes.
enum class ExportTarget { lammps, liggghts, yade, openfoam, fluent, table };

template <>
struct NamesOf<ExportTarget> {
  static constexpr std::array<std::string_view, 6> names = {"lammps",   "liggghts", "yade",
                                                            "openfoam", "fluent",   "table"};
};

/// A sphere and the force between it and a flat, in SI units: what a program for particles can
/// integrate by itself. With the penetration n, a^2 = r n and S as in eq. 5,
///   ring  -K r^(1/2) n^(3/2) (1 + C_H n') + 2 pi a f0 (1 + C_A S) - D n^(1/2) n',
///   jkr, dmt: see JkrLaw and DmtLaw.
struct ContactForce {
  AdhesionLaw adhesion = AdhesionLaw::ring;
  AdhesionDampingPhase phase = AdhesionDampingPhase::rebound;
  double radius = 0.0;            ///< r [m]
  double density = 0.0;           ///< [kg/m3]
  double stiffness = 0.0;         ///< K [Pa]
  double adhesion_force = 0.0;    ///< f0 at this radius [N/m]
  double adhesion_energy = 0.0;   ///< W that has this f0, by eqs 9 and 10 [J/m2]
  double hertz_damping = 0.0;     ///< C_H [s/m]
  double adhesion_damping = 0.0;  ///< C_A [s/m]
  double dashpot = 0.0;           ///< D [N s m^(-3/2)], with the ring law only

  double mass() const;  ///< [kg]
  /// JKR: the sphere parts at n = -3 u, with u = a_p^2 / r and a_p^3 = pi W r^2 / (6 K) [m].
  double jkr_length() const;
};

/// e^2 at every velocity [m/s] under `force` alone, continued below zero for captures.
/// @throws ComputationError when an impact has no answer
std::vector<double> squares_under(const ContactForce& force, std::span<const double> velocity);

/// e; 0: captured.
std::vector<double> restitution_under(const ContactForce& force, std::span<const double> velocity);

/// The capture velocity of `force` below `fastest` [m/s], at which a sphere rebounds; 0: there is
/// none above a millionth of it.
double capture_velocity_under(const ContactForce& force, double fastest);

/// The time between touch and release, or the first outer turning point [s].
double contact_time_under(const ContactForce& force, double velocity);

/// What is exported: which sphere, and how fast.
struct ExportRequest {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double slowest = 0.0;   ///< [m/s]
  double fastest = 0.0;   ///< [m/s]
};

/// One size under a fit, as it is to behave elsewhere. Mechanisms of the measurement are left out,
/// for they say nothing about the sphere; the others are in `restitution` and `capture_velocity`.
struct ExportedImpact {
  ExportRequest request;
  ContactForce force;             ///< of two spheres: of one on a flat with their R* and m*
  double surface_diameter = 0.0;  ///< of the second sphere [m]; 0: a flat
  /// Is e(V) that of the force alone? Mechanisms that act elsewhere than in the equation of motion,
  /// and laws that ContactForce does not know, are not.
  bool force_is_all = false;
  std::vector<const Mechanism*> of_nature;
  std::vector<const Mechanism*> of_measurement;  ///< left out
  std::vector<double> velocity;     ///< log-spaced over the range, `error_velocities` of them
  std::vector<double> restitution;  ///< e there [1]; 0: captured
  bool captures = false;            ///< is there a capture velocity?
  double capture_velocity = 0.0;    ///< V* [m/s]
  double shortest_contact = 0.0;    ///< over the range [s], for time steps; of the force alone
  double longest_contact = 0.0;
};

/// At how many velocities errors of an approximation are taken.
inline constexpr std::size_t error_velocities = 200;

/// Is the answer of `force` within this of the model's everywhere, e^2 counts as that of the force.
inline constexpr double same_square = 1e-8;

/// @throws ComputationError when the model has no answer somewhere in the range.
ExportedImpact exported_impact(const ImpactModel& model, std::span<const double> theta,
                               const ExportRequest& request);

/// `theta` with the mechanisms of the measurement at their null values.
std::vector<double> of_nature(const ImpactModel& model, std::vector<double> theta);

/// e^2 of the model without the mechanisms of the measurement, continued below zero for captures.
/// @throws ComputationError when an impact has no answer
std::vector<double> squares_of_nature(const ImpactModel& model, std::span<const double> theta,
                                      std::size_t dataset, double diameter,
                                      std::span<const double> velocity);

}  // namespace recoil
