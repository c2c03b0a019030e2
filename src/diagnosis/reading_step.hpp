#pragma once

#include <vector>

#include "data/dataset.hpp"

namespace recoil {

/// To which the sphere of `point` rises in vacuum, e^2 V^2 / 2g [m].
double rebound_height(const ImpactPoint& point);

/// The step [m] on which the heights of the rebounds lie where `dataset` says that
/// velocities come from heights; 0 where they lie on none of 1, 2, 5 and 10 mm.
///
/// With h the mean height of one size and velocity, it is the largest step for which the mean of
/// cos(2 pi h / step) is above 0.9 over those below fifteen steps (higher up three printed digits
/// of V do not show it), four of them at least. By chance that happens once in a thousand data
/// sets.
double height_step(const Dataset& dataset);

/// The largest one of several.
double height_step(const std::vector<Dataset>& datasets);

}  // namespace recoil
