#pragma once

#include <cstddef>
#include <string>

#include "data/system.hpp"

namespace recoil {

/// What theory says must be there, as the conditions of the data state all that decides about it.
struct ExpectedEffect {
  std::string id;  ///< of the mechanism
  std::size_t dataset = 0;
  Condition condition = Condition::ambient_pressure;
  double stated = 0.0;    ///< the condition, in its unit
  double diameter = 0.0;  ///< of the point on which it does most [m]
  double velocity = 0.0;  ///< and its incident velocity [m/s]
  double change = 0.0;    ///< of e there [1]
};

}  // namespace recoil
