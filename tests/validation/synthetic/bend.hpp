#pragma once

#include <array>
#include <cstdint>

namespace hidden {

/// A smooth random factor: how wrong a law may be. One plus a sum of three plane waves in
/// (ln V, ln d) of equal height, whose lengths lie between 5 and 20 in these logarithms.
struct Bend {
  struct Wave {
    double per_log_velocity = 0.0, per_log_diameter = 0.0, phase = 0.0;
  };
  double size = 0.0;  ///< standard deviation of the factor [1]; 0: it is 1 everywhere
  std::array<Wave, 3> waves;

  double factor(double velocity, double diameter) const;
};

/// @param which of the bends of this draw
Bend draw_bend(double size, std::uint64_t seed, std::uint64_t which);

}  // namespace hidden
