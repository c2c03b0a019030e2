#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "estimate/model.hpp"

namespace recoil {

/// Many impacts of one model, as columns.
struct ManyImpacts {
  std::vector<double> restitution_squared;  ///< [impacts], see ImpactResult; NaN without an answer
  std::vector<std::uint8_t> captured;       ///< [impacts] 1: the sphere stays
  /// [column][impacts]: d e^2 / d (each slot of the model, the velocity [s/m], the diameter [1/m]).
  std::vector<std::vector<double>> slopes;
};

/// Simulates impacts at `velocity` [m/s] and `diameter` [m], all at once, under the model's initial
/// values. @pre as many diameters as velocities
/// @throws InputError where one of them is not a number or out of `velocity_limits`,
///   `diameter_limits_um`
ManyImpacts simulate_many(const ImpactModel& model, std::size_t dataset,
                          const std::vector<double>& velocity, const std::vector<double>& diameter,
                          bool slopes);

}  // namespace recoil
