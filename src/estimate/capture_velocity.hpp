#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "estimate/model.hpp"

namespace recoil {

/// The velocity below which spheres are captured, with its gradient.
struct CaptureVelocity {
  bool found = false;
  double value = 0.0;            ///< V* [m/s]; 0 without adhesion (nothing is captured)
  std::vector<double> gradient;  ///< d V* / d theta
};

/// The sphere for which a capture velocity is computed.
struct CaptureQuery {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double guess = 0.0;     ///< [m/s] start of the search; 0: the law for small damping
};

/// Solves e^2(V) = 0 for the largest V at which capture turns into rebound, for all spheres in one
/// batch. Mechanisms that describe errors of the measurement do not act (see Effects).
std::vector<CaptureVelocity> capture_velocities(const ImpactModel& model,
                                                std::span<const double> theta,
                                                std::span<const CaptureQuery> queries);

/// V* [m/s] to first order in the dampings, without solving an impact; `reweighted_fit` computes
/// weights from it. 0 where no sphere is captured.
double weakly_damped_capture(const ImpactModel& model, std::span<const double> theta,
                             std::size_t dataset, double diameter);

/// The same for one sphere.
CaptureVelocity capture_velocity(const ImpactModel& model, std::span<const double> theta,
                                 std::size_t dataset, double diameter, double guess = 0.0);

}  // namespace recoil
