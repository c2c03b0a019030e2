#include "diagnosis/misfit_map.hpp"

#include <cmath>
#include <map>

#include "estimate/residual.hpp"

namespace recoil {
namespace {

constexpr int bands = 4;

}  // namespace

std::vector<MisfitCell> misfit_map(const FitResult& fitted) {
  const std::vector<Observation>& points = fitted.data.points;
  double low = INFINITY, high = 0.0;
  for (const Observation& point : points) {
    low = std::min(low, point.velocity);
    high = std::max(high, point.velocity);
  }
  const double width = std::log(high / low) / bands;
  std::map<std::tuple<std::size_t, double, int>, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int band =
        width > 0.0
            ? std::min(bands - 1, static_cast<int>(std::log(points[i].velocity / low) / width))
            : 0;
    cells[{points[i].dataset, points[i].diameter, band}].push_back(i);
  }
  std::vector<MisfitCell> map;
  for (const auto& [key, members] : cells) {
    MisfitCell cell;
    cell.dataset = std::get<0>(key);
    cell.diameter = std::get<1>(key);
    cell.points = static_cast<int>(members.size());
    cell.slowest = INFINITY;
    const ContactProperties& contact = fitted.model.contacts[cell.dataset];
    const double mass = contact.reduced_mass(cell.diameter, contact.particle_density);
    double weights = 0.0, weighted = 0.0;
    for (const std::size_t i : members) {
      const Observation& point = points[i];
      const double expected = expected_restitution(point, fitted.prediction_squared[i]);
      const double measured = point.counts_only() ? expected
                              : point.censored    ? 0.0
                                                  : point.restitution;
      const double miss = measured - expected;
      cell.slowest = std::min(cell.slowest, point.velocity);
      cell.fastest = std::max(cell.fastest, point.velocity);
      cell.restitution += miss / cell.points;
      cell.energy += 0.5 * mass * point.velocity * point.velocity *
                     (measured * measured - expected * expected) / cell.points;
      if (point.censored || !(point.weights.sd > 0.0)) continue;
      weights += 1.0 / (point.weights.sd * point.weights.sd);
      weighted += miss / (point.weights.sd * point.weights.sd);
    }
    if (weights > 0.0) cell.standardised = weighted / std::sqrt(weights);
    map.push_back(cell);
  }
  return map;
}

}  // namespace recoil
