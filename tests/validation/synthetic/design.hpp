#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "validation/synthetic/circumstances.hpp"
#include "validation/synthetic/effects.hpp"

namespace recoil::hidden {

/// One row of points in a table: one diameter, velocities from just above capture.
struct Row {
  std::string name;
  double diameter = 0.0;  ///< as stated [m]
  int points = 0;
  double start = 0.0;          ///< lowest velocity over the capture velocity
  double lowest = 0.0;         ///< but not below this [m/s]
  double highest = 0.0;        ///< [m/s]
  std::vector<double> jitter;  ///< of each velocity, in steps of the row
  int repeats = 1;             ///< impacts at each velocity, each a point of its own
};

/// How drops are read: exactly, or rounded to a step of a height or of a time of flight.
enum class Readout { exact, millimetre, five_millimetres, millisecond, frame };
constexpr auto names_of_values(Readout) {
  return name_list("exact", "millimetre", "five_millimetres", "millisecond", "frame");
}

/// A possible experiment, drawn by seed around a real one.
struct Design {
  std::string id;
  std::string sphere;   ///< material
  std::string surface;  ///< material
  Base base;
  std::vector<Row> rows;
  Scatter scatter;
  int events = 40;
  int decimals = 3;      ///< of e, as printed
  bool dropped = false;  ///< by hand from measured heights, and known to be so
  Readout readout = Readout::exact;
  bool states_rounding = false;  ///< in the standard deviations
};

/// The step of a height [m] or of a time [s]; 0: none. A frame is one of 240 in a second.
double step_of(Readout readout);
bool reads_times(Readout readout);

/// e as it is read: the height of a rebound is rounded, that of the drop was set on a mark; or the
/// times before and after an impact, 2 V / g and 2 e V / g, are both.
double rounded(Readout readout, double velocity, double restitution);

/// Standard deviation of e that rounding makes, step / sqrt(12) of each thing read [1].
double rounding_sd(Readout readout, double velocity, double restitution);

/// `wall` (4 diameters x 15), `wall-batches` (4 diameters x 2 batches x 8), `li` (4 diameters x
/// 15), `wall-one` (1 x 15), `dahneke` (1 x 20), `drops` (3 diameters of millimetres x 5 heights x
/// 4 drops, without adhesion), `balls` (the same of centimetres).
const std::vector<std::string_view>& design_ids();
bool has_several_diameters(std::string_view id);

/// @throws std::invalid_argument when there is no such design
Design draw_design(std::string_view id, std::uint64_t seed);

/// One point without noise.
struct Point {
  std::size_t row = 0;
  double diameter = 0.0;  ///< as stated [m]
  double velocity = 0.0;  ///< [m/s]
  double restitution = 0.0;
  double sd = 0.0;          ///< of the mean
  int events = 0;           ///< where they differ from those of the design, captured ones included
  int captured = 0;         ///< of these
  std::size_t setting = 0;  ///< the velocity of the row: its impacts share an error
  StatedCondition changed = {};  ///< under which it was taken; of no name: as the others
};

/// The points that such an experiment would take if `effects` were at work, without noise. Empty
/// when it would not be made: spheres that hardly ever come back, or e above 1.
std::vector<Point> expected_points(const Design& design, const Effects& effects);

/// Lowest velocity at which the typical sphere of a row comes back [m/s]; 0: at any.
double capture_velocity(const Base& base, const Effects& effects, double diameter, double highest);

}  // namespace recoil::hidden
