#pragma once

#include <cstdint>

#include "validation/synthetic/case.hpp"

namespace hidden {

/// Impacts of one size at one velocity that are measured after a first answer.
struct FurtherImpacts {
  double diameter = 0.0;    ///< [m]
  double velocity = 0.0;    ///< [m/s]
  int events = 0;           ///< all of them
  StatedCondition changed;  ///< the condition that differs; its name is empty if none does
  RECOIL_FIELDS(diameter, velocity, events, changed)
};

/// Measures them: one point with their mean, its noise drawn by `round`. A diameter that no row has
/// makes a row.
void take_further(Case& made, const FurtherImpacts& further, std::uint64_t round);

}  // namespace hidden
