#pragma once

#include <vector>

#include "estimate/fit.hpp"
#include "estimate/observation.hpp"

namespace recoil {

/// Impacts that an experiment like this one could add: 24 velocities from 0.7 times the slowest to
/// 1.5 times the fastest, for every diameter of the data, 0.6 times the smallest and 1.6 times the
/// largest.
std::vector<PointConditions> measurable_impacts(const FitResult& base);

/// Standard deviation of the e of one impact [1]: that of the nearest point of the dataset in ln V.
double scatter_of_one_event(const FitResult& base, std::size_t dataset, double velocity);

}  // namespace recoil
