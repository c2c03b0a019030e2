#include "diagnosis/reading_step.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/units.hpp"

namespace recoil {
namespace {

constexpr double steps_of_rulers[] = {0.01, 0.005, 0.002, 0.001};
constexpr double highest_of_steps = 15.0;
constexpr double coherent = 0.9;
constexpr std::size_t fewest_heights = 4;

/// How often a step goes into the heights of the rebounds of one size and velocity.
struct Heights {
  double sum = 0.0;      ///< of the heights [m]
  double cosines = 0.0;  ///< of 2 pi h / step
  int count = 0;
};

/// The mean cosine of all sizes and velocities whose rebounds are low enough, each counting once; 0
/// where there are too few.
double coherence(const Dataset& dataset, double step) {
  std::map<std::pair<double, double>, Heights> places;
  for (const ImpactPoint& point : dataset.points) {
    if (!(point.restitution > 0.0)) continue;
    Heights& heights = places[{point.diameter, point.incident_velocity}];
    const double height = rebound_height(point);
    heights.sum += height;
    heights.cosines += std::cos(2.0 * std::numbers::pi * height / step);
    ++heights.count;
  }
  double sum = 0.0;
  std::size_t low = 0;
  for (const auto& [place, heights] : places) {
    if (heights.sum > highest_of_steps * step * heights.count) continue;
    sum += heights.cosines / heights.count;
    ++low;
  }
  return low < fewest_heights ? 0.0 : sum / static_cast<double>(low);
}

}  // namespace

double rebound_height(const ImpactPoint& point) {
  const double rebound = point.restitution * point.incident_velocity;
  return rebound * rebound / (2.0 * standard_gravity);
}

double height_step(const Dataset& dataset) {
  if (dataset.system.method != Method::drop_heights) return 0.0;
  for (const double step : steps_of_rulers) {
    if (coherence(dataset, step) > coherent) return step;
  }
  return 0.0;
}

double height_step(const std::vector<Dataset>& datasets) {
  double largest = 0.0;
  for (const Dataset& dataset : datasets) largest = std::max(largest, height_step(dataset));
  return largest;
}

}  // namespace recoil
