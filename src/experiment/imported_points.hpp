#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/system.hpp"
#include "experiment/import.hpp"

/// What the readers of all formats hand on.
namespace recoil {

/// A point as imported, SI.
struct ImportedPoint {
  std::string series;
  std::optional<double> diameter;          ///< [m]; nothing when the file does not say
  double velocity = 0.0;                   ///< [m/s]
  std::optional<double> restitution;       ///< [1]; nothing when all were captured
  std::optional<double> rebound_velocity;  ///< [m/s], instead of it
  std::optional<double> restitution_sd, velocity_sd, diameter_sd;
  std::optional<double> events, captured;
  std::string setting = {};  ///< of the apparatus; empty where the file names none
  Conditions conditions = {};
  int line = 0;  ///< in the file
};

struct ImportedPoints {
  std::vector<ImportedPoint> points;
  std::vector<ImportNote> notes;
};

}  // namespace recoil
