#include "report/parameter_axis.hpp"

#include <cmath>

namespace recoil {

ParameterAxis parameter_axis(const ParameterSlot& slot, double estimate) {
  const plot::Scaling scaling =
      plot::scaling_for(std::abs(estimate), std::string(slot.parameter->unit));
  plot::Axis axis{std::string(slot.parameter->name), scaling.unit};
  if (!slot.dataset.empty()) axis.label += ", " + slot.dataset;
  if (!slot.series.empty()) axis.label += ", " + slot.series;
  return {scaling.factor, axis};
}

}  // namespace recoil
