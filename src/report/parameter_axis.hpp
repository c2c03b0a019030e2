#pragma once

#include "estimate/model.hpp"
#include "plot/plot.hpp"

namespace recoil {

/// The axis of a parameter's values, in a unit that suits their size.
struct ParameterAxis {
  double factor = 1.0;  ///< a value times this is where it stands on the axis
  plot::Axis axis;      ///< without a range
};
ParameterAxis parameter_axis(const ParameterSlot& slot, double estimate);

}  // namespace recoil
