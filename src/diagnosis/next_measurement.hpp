#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/candidate_result.hpp"

namespace recoil {

/// A measurement that would tell one rival from another.
struct NextMeasurement {
  std::size_t dataset = 0;
  double velocity = 0.0;  ///< [m/s]
  double diameter = 0.0;  ///< [m]
  std::string one, other;
  double difference = 0.0;    ///< of the two predictions of e [1]
  double event_sd = 0.0;      ///< of one impact's e there [1]
  std::optional<int> events;  ///< that separate them by three standard errors; none: 10^6
                              ///< would not do
};

/// For every two of `rivals` (the best four of them) the impact at which their predictions
/// differ most per standard deviation of one event, over 24 velocities from 0.7 times the slowest
/// to 1.5 times the fastest and over the diameters of the data, 0.6 times the smallest and 1.6
/// times the largest. The deviation of an event is that of the nearest point in ln V.
std::vector<NextMeasurement> next_measurements(const FitResult& base,
                                               const std::vector<const CandidateResult*>& rivals);

}  // namespace recoil
