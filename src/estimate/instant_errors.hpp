#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/error_source.hpp"
#include "estimate/observation.hpp"

namespace recoil {

/// The errors of the instants t at which successive bounces of a launch were timed. In
///   e_k = (t_(k+2) - t_(k+1)) / (t_(k+1) - t_k)
/// the errors of t_k, t_(k+1) and t_(k+2), independent and of equal size, have coefficients in the
/// ratio 1 : -(1 + 1/e_k) : 1/e_k. They are the whole scatter of e_k, whose standard deviation is
/// stated. Their effect on V is neglected: V de/dV is small compared with e for a ball.
const ErrorSource& instant_error();

/// The coefficients of the errors of t_k, t_(k+1) and t_(k+2) in e_k, with the sum of squares 1.
std::array<double, 3> instant_coefficients(double restitution);

/// The place of a point among successive bounces.
struct LinkedBounce {
  std::size_t launch = Observation::no_launch;  ///< number of the run; no_launch: shares no instant
  std::size_t bounce = 0;                       ///< number within the run
};

/// Finds the points of one launch that are successive bounces with stated errors: V of each equals
/// the rebound velocity of the one before, up to the drag of the air [points].
std::vector<LinkedBounce> linked_bounces(const Dataset& dataset);

}  // namespace recoil
