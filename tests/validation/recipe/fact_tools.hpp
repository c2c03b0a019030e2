#pragma once

#include <cmath>
#include <vector>

#include "validation/recipe/facts.hpp"

namespace recoil {

inline bool within(double value, double lower, double upper) {
  return value >= lower && value <= upper;
}

/// `count` values from `lower` to `upper`, equally spaced in the logarithm.
inline std::vector<double> log_grid(double lower, double upper, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(lower * std::pow(upper / lower, i / static_cast<double>(count - 1)));
  }
  return values;
}

/// The points of one series.
inline std::vector<GeneratedPoint> points_of(const FactContext& context, std::size_t series) {
  std::vector<GeneratedPoint> chosen;
  for (const GeneratedPoint& point : context.points) {
    if (point.series == series) chosen.push_back(point);
  }
  return chosen;
}

// Checks that live with others of their kind.

}  // namespace recoil
