#include "estimate/velocity_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace recoil {
namespace {

constexpr double step = 1.0 / 16.0;      // of ln V
constexpr int margin = 4;                // nodes beyond the slowest and the fastest point
constexpr std::size_t few_points = 512;  // these are simulated one by one
// Largest seventh difference of e^2. The next one is smaller by a factor of a few, and the error of
// the interpolation is at most 0.001 of that. A jump of the second derivative by J changes e^2 by
// up to about 0.03 J step^2 and a seventh difference nearby by about J step^2.
constexpr double most_rough = 1e-6;

/// The weights of the neighbours at -3, -2, ..., 4 for a point at `x` in [0, 1].
std::array<double, 8> lagrange_weights(double x) {
  std::array<double, 8> weights{};
  for (int k = 0; k < 8; ++k) {
    double weight = 1.0;
    for (int j = 0; j < 8; ++j) {
      if (j != k) weight *= (x - (j - 3)) / (k - j);
    }
    weights[static_cast<std::size_t>(k)] = weight;
  }
  return weights;
}

}  // namespace

std::optional<VelocityGrid> VelocityGrid::for_points(std::span<const PointConditions> points) {
  if (points.size() <= few_points) return std::nullopt;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto kind = [&](std::size_t i) {
    return std::tie(points[i].dataset, points[i].series, points[i].diameter);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(kind(a), points[a].velocity) < std::tuple(kind(b), points[b].velocity);
  });
  VelocityGrid grid;
  grid.places_.resize(points.size());
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && kind(order[last]) == kind(order[first])) ++last;
    const PointConditions& slowest = points[order[first]];
    const double range = std::log(points[order[last - 1]].velocity / slowest.velocity) / step;
    const std::size_t start = grid.nodes_.size();
    if (!(range + 2 * margin + 1 < 0.5 * static_cast<double>(last - first))) {
      for (std::size_t k = first; k < last; ++k) {
        grid.places_[order[k]].node = grid.nodes_.size();
        grid.nodes_.push_back(points[order[k]]);
      }
      continue;
    }
    for (int k = -margin; k <= static_cast<int>(range) + 1 + margin; ++k) {
      grid.nodes_.push_back(slowest);
      grid.nodes_.back().velocity *= std::exp(k * step);
    }
    for (std::size_t k = first; k < last; ++k) {
      const double at = std::log(points[order[k]].velocity / slowest.velocity) / step;
      const double below = std::floor(at);
      grid.places_[order[k]] = {start + static_cast<std::size_t>(below) + margin - 3, false,
                                lagrange_weights(at - below)};
    }
  }
  if (2 * grid.nodes_.size() > points.size()) return std::nullopt;
  return grid;
}

std::vector<std::size_t> VelocityGrid::rough_points(std::span<const double> squares) const {
  constexpr std::array<double, 8> seventh = {-1.0, 7.0, -21.0, 35.0, -35.0, 21.0, -7.0, 1.0};
  std::vector<bool> smooth(squares.size(), false);  // the eight nodes from this one on
  for (std::size_t first = 0; first + seventh.size() <= squares.size(); ++first) {
    const double difference =
        std::inner_product(seventh.begin(), seventh.end(), &squares[first], 0.0);
    smooth[first] = std::abs(difference) < most_rough;
  }
  std::vector<std::size_t> rough;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i].alone) continue;
    // The neighbours of the point, and those of the points in the intervals beside.
    const std::size_t node = places_[i].node;
    if (!smooth[node - 1] || !smooth[node] || !smooth[node + 1]) rough.push_back(i);
  }
  return rough;
}

}  // namespace recoil
