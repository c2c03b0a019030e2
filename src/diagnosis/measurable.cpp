#include "diagnosis/measurable.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace recoil {
namespace {

constexpr int velocities = 24;
constexpr double smallest_sd = 1e-3;  // of one event's e, where a point states less

}  // namespace

double scatter_of_one_event(const FitResult& base, std::size_t dataset, double velocity) {
  double nearest = INFINITY, sd = smallest_sd;
  for (const Observation& point : base.data.points) {
    if (point.dataset != dataset || point.censored) continue;
    const double distance = std::abs(std::log(point.velocity / velocity));
    if (distance >= nearest) continue;
    nearest = distance;
    sd = point.weights.sd * std::sqrt(static_cast<double>(std::max(point.rebounds(), 1))) *
         base.noise_scale;
  }
  return std::max(sd, smallest_sd);
}

std::vector<PointConditions> measurable_impacts(const FitResult& base) {
  double low = INFINITY, high = 0.0;
  std::set<std::pair<std::size_t, double>> sizes;
  for (const Observation& point : base.data.points) {
    low = std::min(low, point.velocity);
    high = std::max(high, point.velocity);
    sizes.insert({point.dataset, point.diameter});
  }
  std::set<std::pair<std::size_t, double>> wider = sizes;
  for (const auto& [dataset, diameter] : sizes) {
    const auto of_dataset = [d = dataset](const auto& size) { return size.first == d; };
    const auto first = std::find_if(sizes.begin(), sizes.end(), of_dataset);
    const auto last = std::find_if(sizes.rbegin(), sizes.rend(), of_dataset);
    wider.insert({dataset, 0.6 * first->second});
    wider.insert({dataset, 1.6 * last->second});
  }
  std::vector<PointConditions> grid;
  for (const auto& [dataset, diameter] : wider) {
    for (int k = 0; k < velocities; ++k) {
      const double share = static_cast<double>(k) / (velocities - 1);
      grid.push_back({dataset, diameter, 0.7 * low * std::pow(1.5 * high / (0.7 * low), share)});
    }
  }
  return grid;
}

}  // namespace recoil
