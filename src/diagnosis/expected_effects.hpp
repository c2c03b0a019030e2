#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/system.hpp"

namespace recoil {

struct SearchBase;

/// An effect that theory predicts from the stated conditions of the data.
struct ExpectedEffect {
  std::string id;  ///< of the mechanism
  std::size_t dataset = 0;
  Condition condition = Condition::ambient_pressure;
  double stated = 0.0;    ///< the condition, in its unit
  double diameter = 0.0;  ///< of the point on which it does most [m]
  double velocity = 0.0;  ///< and its incident velocity [m/s]
  double change = 0.0;    ///< of e there [1]
};

/// For every dataset and every mechanism whose strength its conditions state, what the mechanism
/// does to e under the parameters of the base fit; also where that is too little to be seen. The
/// largest change first.
std::vector<ExpectedEffect> expected_effects(const SearchBase& base);

}  // namespace recoil
