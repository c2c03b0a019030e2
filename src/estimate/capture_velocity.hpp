#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "estimate/model.hpp"

namespace recoil {

/// A velocity below which spheres are captured, with its gradient.
struct CaptureVelocity {
  bool found = false;
  double value = 0.0;            ///< V* [m/s]; 0 without adhesion (nothing is captured)
  std::vector<double> gradient;  ///< d V* / d theta
};

/// A sphere whose capture velocity is sought.
struct CaptureQuery {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double guess = 0.0;     ///< [m/s] where to look first; 0 uses the law for small damping
};

/// Solves e^2(V) = 0 for the largest V at which capture turns into rebound, for all spheres
/// together. Errors of the measurement (Effects) are left out.
std::vector<CaptureVelocity> capture_velocities(const ImpactModel& model,
                                                std::span<const double> theta,
                                                std::span<const CaptureQuery> queries);

/// V* to the first order in the damping, without solving an impact (see `reweighted_fit`): for
/// weights. 0 where nothing is captured.
double weakly_damped_capture(const ImpactModel& model, std::span<const double> theta,
                             std::size_t dataset, double diameter);

/// The same for one sphere.
CaptureVelocity capture_velocity(const ImpactModel& model, std::span<const double> theta,
                                 std::size_t dataset, double diameter, double guess = 0.0);

}  // namespace recoil
