#pragma once

#include <vector>

#include "data/dataset.hpp"

namespace recoil {

/// The datasets as an experiment will find them: their materials and conditions, one series and one
/// placeholder point for each diameter. f0 belongs to the diameter to which it did, or else to the
/// middle one of the plan.
/// @param diameters [m]; empty: those of each dataset's own points
/// @throws InputError where no diameter is known
std::vector<Dataset> datasets_to_plan(std::vector<Dataset> datasets,
                                      const std::vector<double>& diameters);

}  // namespace recoil
