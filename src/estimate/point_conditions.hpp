#pragma once

#include <cstddef>

namespace recoil {

/// A sphere of one dataset about to hit: where a model is asked for an answer.
struct PointConditions {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  std::size_t series = no_series;

  /// A sphere of no series in particular: what belongs to a series is left out.
  static constexpr std::size_t no_series = static_cast<std::size_t>(-1);
};

}  // namespace recoil
