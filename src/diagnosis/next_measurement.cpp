#include "diagnosis/next_measurement.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <set>

#include "estimate/point_conditions.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_rivals = 4;
constexpr int velocities = 24;
constexpr double separation = 3.0;  // of the two predictions, in standard errors
constexpr double most_events = 1e6;
constexpr double smallest_sd = 1e-3;  // of one event's e, where a point states less

/// sd of one impact's e at `velocity`, from the nearest point of the dataset.
double event_sd(const FitResult& base, std::size_t dataset, double velocity) {
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

std::vector<PointConditions> grid_of(const FitResult& base) {
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

}  // namespace

std::vector<NextMeasurement> next_measurements(const FitResult& base,
                                               const std::vector<const CandidateResult*>& rivals) {
  const std::vector<PointConditions> grid = grid_of(base);
  std::vector<double> sd;
  for (const PointConditions& at : grid) sd.push_back(event_sd(base, at.dataset, at.velocity));
  std::vector<std::vector<double>> curves;
  const std::size_t count = std::min(most_rivals, rivals.size());
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double>& curve = curves.emplace_back();
    for (const Prediction& at :
         predict(rivals[k]->candidate.model, rivals[k]->refit.theta, grid, false)) {
      curve.push_back(at.usable() ? at.restitution() : NAN);
    }
  }
  std::vector<NextMeasurement> next;
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      NextMeasurement best;
      best.one = rivals[a]->candidate.name();
      best.other = rivals[b]->candidate.name();
      double most = 0.0;
      for (std::size_t i = 0; i < grid.size(); ++i) {
        const double difference = curves[a][i] - curves[b][i];
        if (!(std::abs(difference) / sd[i] > most)) continue;
        most = std::abs(difference) / sd[i];
        best.dataset = grid[i].dataset;
        best.velocity = grid[i].velocity;
        best.diameter = grid[i].diameter;
        best.difference = difference;
        best.event_sd = sd[i];
      }
      if (!(most > 0.0)) continue;
      const double events = std::ceil(std::pow(separation / most, 2));
      if (events <= most_events) best.events = std::max(1, static_cast<int>(events));
      next.push_back(std::move(best));
    }
  }
  // What takes the fewest events first; rivals that nothing in reach separates at the end.
  std::stable_sort(next.begin(), next.end(), [](const auto& a, const auto& b) {
    return a.events.value_or(INT_MAX) < b.events.value_or(INT_MAX);
  });
  return next;
}

}  // namespace recoil
