#include "diagnosis/next_measurement.hpp"

#include <algorithm>
#include <climits>
#include <cmath>

#include "diagnosis/measurable.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_rivals = 4;
constexpr double separation = 3.0;  // of the two predictions, in standard errors
constexpr double most_events = 1e6;

}  // namespace

std::vector<NextMeasurement> next_measurements(const FitResult& base,
                                               const std::vector<const CandidateResult*>& rivals) {
  const std::vector<PointConditions> grid = measurable_impacts(base);
  std::vector<double> sd;
  for (const PointConditions& at : grid)
    sd.push_back(scatter_of_one_event(base, at.dataset, at.velocity));
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
