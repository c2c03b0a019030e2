#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/units.hpp"  // standard_gravity
#include "validation/recipe/recipe.hpp"

namespace recoil {

/// The noiseless truth of every point of the recipe's design, in the order of points.csv.
/// For mixed sizes, e is the mean over the impacts that are seen to rebound, weighted by the size
/// distribution, and its standard deviation holds the scatter of the sizes as well as the noise.
/// @throws InputError when fewer than one impact in a hundred would be seen at some point.
std::vector<PlannedPoint> make_plan(const Recipe& recipe);

/// One point as it stands in points.csv: rounded.
struct GeneratedPoint {
  std::size_t series = 0;
  double diameter = 0.0;        ///< [m]
  double velocity = 0.0;        ///< [m/s]
  double restitution = 0.0;     ///< mean of the events that rebounded [1]
  double restitution_sd = 0.0;  ///< standard error that the recipe implies [1]
  int events = 0;
};

/// Draws the events of every point from the stream (seed, reconstruction, point number), averages
/// and rounds.
std::vector<GeneratedPoint> draw_points(const Recipe& recipe, std::uint64_t seed);

/// points.csv, diameters in um, velocities in m/s.
std::string to_csv(const Recipe& recipe, const std::vector<GeneratedPoint>& points);

}  // namespace recoil
