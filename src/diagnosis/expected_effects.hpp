#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/system.hpp"

namespace recoil {

struct SearchBase;

/// An effect that theory predicts from the stated conditions of the data.
struct ExpectedEffect {
  std::string id;  ///< id of the mechanism
  std::size_t dataset = 0;
  Condition condition = Condition::ambient_pressure;
  double stated = 0.0;    ///< value of the condition, in its unit
  double diameter = 0.0;  ///< diameter of the point with the largest effect [m]
  double velocity = 0.0;  ///< incident velocity of that point [m/s]
  double change = 0.0;    ///< change of e at that point [1]
};

/// For every dataset and every mechanism whose strength its conditions state: the largest change of
/// e by the mechanism at the parameters of the base fit, even if it is too small to be detected.
/// The largest change first.
std::vector<ExpectedEffect> expected_effects(const SearchBase& base);

}  // namespace recoil
