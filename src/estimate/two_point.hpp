#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "estimate/fit.hpp"

namespace recoil {

/// How the paper's iteration ended.
enum class TwoPointStatus {
  converged,
  no_hertz_damping,     ///< at the highest velocity adhesion alone already costs more than measured
  no_adhesion_damping,  ///< no C_A >= 0 gives the e of the lowest velocity
  not_converging,       ///< the iteration goes round or stops at its limit
  too_few_points,
};

template <>
struct NamesOf<TwoPointStatus> {
  static constexpr std::array<std::string_view, 5> names = {
      "converged", "no_hertz_damping", "no_adhesion_damping", "not_converging", "too_few_points"};
};

/// The calibration of Li, Dunn & Brach (1999), section 4: the point of the highest velocity gives
/// C_H with the effects of adhesion neglected (C_A = 0 at first), the point of the lowest gives
/// C_A, and so on until nothing changes. f0 is fixed by eq. 12, or by the fit file.
struct TwoPointResult {
  TwoPointStatus status = TwoPointStatus::too_few_points;
  std::size_t low_point = 0;  ///< indices into the observations
  std::size_t high_point = 0;
  double diameter = 0.0;      ///< of the series used [m]
  std::vector<double> theta;  ///< [slots]; the last iterate when it did not converge
  int iterations = 0;
};

/// Runs the iteration on the points of `dataset` that are nearest to `diameter` [m].
/// @param near theta near the answer: Newton in both factors from there finds where the iteration
/// would end, in fewer steps; `iterations` is then 1. Where Newton fails, the iteration runs.
TwoPointResult two_point(const ImpactModel& model, const Observations& data, std::size_t dataset,
                         double diameter, std::span<const double> near = {});

}  // namespace recoil
