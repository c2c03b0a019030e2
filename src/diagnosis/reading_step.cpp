#include "diagnosis/reading_step.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace recoil {
namespace {

constexpr double standard_gravity = 9.80665;  // [m/s2]
constexpr double steps_of_rulers[] = {0.01, 0.005, 0.002, 0.001};
constexpr double highest_of_steps = 15.0;
constexpr double coherent = 0.9;
constexpr std::size_t fewest_heights = 4;

/// The mean height of the rebounds of every size and velocity [m].
std::vector<double> mean_heights(const Dataset& dataset) {
  std::map<std::pair<double, double>, std::pair<double, int>> sums;
  for (const ImpactPoint& point : dataset.points) {
    if (!(point.restitution > 0.0)) continue;
    auto& [sum, count] = sums[{point.diameter, point.incident_velocity}];
    sum += std::pow(point.restitution * point.incident_velocity, 2) / (2.0 * standard_gravity);
    ++count;
  }
  std::vector<double> heights;
  for (const auto& [place, of_place] : sums) {
    heights.push_back(of_place.first / of_place.second);
  }
  return heights;
}

}  // namespace

double height_step(const Dataset& dataset) {
  if (dataset.system.method != Method::drop_heights) return 0.0;
  const std::vector<double> heights = mean_heights(dataset);
  for (const double step : steps_of_rulers) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const double height : heights) {
      if (height > highest_of_steps * step) continue;
      sum += std::cos(2.0 * std::numbers::pi * height / step);
      ++count;
    }
    if (count >= fewest_heights && sum > coherent * static_cast<double>(count)) return step;
  }
  return 0.0;
}

double height_step(const std::vector<Dataset>& datasets) {
  double largest = 0.0;
  for (const Dataset& dataset : datasets) largest = std::max(largest, height_step(dataset));
  return largest;
}

}  // namespace recoil
