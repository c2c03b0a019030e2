#pragma once

#include <cstdint>
#include <vector>

#include "validation/synthetic/case.hpp"

namespace hidden {

/// Impacts that somebody takes after a first answer: of one size at one velocity, or at several
/// places on another target.
struct FurtherImpacts {
  double diameter = 0.0;      ///< [m]
  double velocity = 0.0;      ///< [m/s]
  int events = 0;             ///< all of them
  StatedCondition changed;    ///< that they were taken under; of no name: as the others
  OtherTarget target;         ///< of no material: as the others
  std::vector<Place> places;  ///< on it
};

/// Takes them, their noise drawn by `round`. On the same target that is one point with the mean; a
/// diameter that no row has makes a row. On another one it is a table of its own.
void take_further(Case& made, const FurtherImpacts& further, std::uint64_t round);

}  // namespace hidden
