#pragma once

#include <vector>

#include "diagnosis/diagnose.hpp"

namespace recoil {

/// For every pair among `rivals` (the best four of them) the impact at which their predictions
/// differ most per standard deviation of one event, over 24 velocities from 0.7 times the slowest
/// to 1.5 times the fastest and over the diameters of the data, 0.6 times the smallest and 1.6
/// times the largest. The deviation of an event is that of the nearest point in ln V.
std::vector<NextMeasurement> next_measurements(const FitResult& base,
                                               const std::vector<const CandidateResult*>& rivals);

}  // namespace recoil
