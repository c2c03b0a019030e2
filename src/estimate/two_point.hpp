#pragma once

#include <span>
#include <vector>

#include "estimate/fit.hpp"

namespace recoil {

/// How the paper's iteration ended.
enum class TwoPointStatus {
  converged,
  no_hertz_damping,     ///< at the highest velocity, adhesion alone loses more energy than measured
  no_adhesion_damping,  ///< no C_A >= 0 gives the e of the lowest velocity
  not_converging,       ///< the iteration oscillates or reaches its limit
  too_few_points,
};

constexpr auto names_of_values(TwoPointStatus) {
  return name_list("converged", "no_hertz_damping", "no_adhesion_damping", "not_converging",
                   "too_few_points");
}

/// The calibration of Li, Dunn & Brach (1999), section 4: the point of the highest velocity gives
/// C_H (with C_A = 0 at first), the point of the lowest gives C_A, and both steps repeat until the
/// factors do not change. f0 is fixed by eq. 12 or by the fit file. Mechanisms do not act, and the
/// materials have their stated constants. The curve, averaged over sizes that the dataset states,
/// goes through both points.
struct TwoPointResult {
  TwoPointStatus status = TwoPointStatus::too_few_points;
  std::size_t low_point = 0;  ///< indices into the observations
  std::size_t high_point = 0;
  double diameter = 0.0;  ///< diameter of the points used [m]
  /// [slots]; the last iterate if it did not converge, empty for too few points.
  std::vector<double> theta;
  int iterations = 0;
};

/// Runs the iteration on the points of `dataset` that are nearest to `diameter` [m].
/// @param near theta near the answer: Newton's method in both factors finds the limit of the
///   iteration in fewer steps; `iterations` is then 1. The iteration runs if Newton's method fails.
TwoPointResult two_point(const ImpactModel& model, const Observations& data, std::size_t dataset,
                         double diameter, std::span<const double> near = {});

}  // namespace recoil
