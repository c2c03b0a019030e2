#include "export/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/numerics.hpp"
#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

constexpr std::size_t tabulated_velocities = 60;
constexpr std::size_t fewest_for_a_band = 19;

std::vector<double> tabulated(double slowest, double fastest, double capture) {
  const std::vector<double> spaced = log_spaced(slowest, fastest, tabulated_velocities);
  std::set<double> grid(spaced.begin(), spaced.end());
  // e rises like sqrt(V - V*) here
  for (const double above : {0.0, 0.001, 0.005, 0.01, 0.02, 0.04, 0.07, 0.1, 0.15}) {
    const double v = capture * (1.0 + above);
    if (v > slowest && v < fastest) grid.insert(v);
  }
  return {grid.begin(), grid.end()};
}

void set_band(BandedNumber& number, std::vector<double> values, double level) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.size() < fewest_for_a_band) return;
  std::ranges::sort(values);
  const double tail = (1.0 - level) / 2.0;
  number.banded = true;
  number.lower = sorted_quantile(values, tail);
  number.upper = sorted_quantile(values, 1.0 - tail);
}

void add_bands(const ImpactModel& model, const TableRequest& request, TabulatedSize& size) {
  const std::size_t count = request.replicates.size();
  std::vector<std::vector<double>> e(count);
  std::vector<double> captures(count, std::nan(""));
  parallel_over(count, request.threads, [&](std::size_t i) {
    const std::vector<double> theta = of_nature(model, request.replicates[i]);
    e[i] = restitution_curve(model, theta, {request.dataset, size.diameter}, size.velocity,
                             Effects::of_nature);
    if (!size.captures) return;
    const CaptureVelocity found =
        capture_velocity(model, theta, request.dataset, size.diameter, size.capture_velocity.value);
    if (found.found) captures[i] = found.value;
  });
  set_band(size.capture_velocity, std::move(captures), request.level);
  for (std::size_t k = 0; k < size.velocity.size(); ++k) {
    std::vector<double> column;
    for (const std::vector<double>& row : e) column.push_back(row[k]);
    set_band(size.restitution[k], std::move(column), request.level);
  }
}

std::string banded(const BandedNumber& at) {
  const std::string band =
      at.banded ? fmt::format("{:.6g},{:.6g}", at.lower, at.upper) : std::string(",");
  return fmt::format("{:.9g},{}", at.value, band);
}

}  // namespace

std::vector<TabulatedSize> restitution_table(const ImpactModel& model,
                                             std::span<const double> theta,
                                             const TableRequest& request) {
  const std::vector<double> values = of_nature(model, {theta.begin(), theta.end()});
  std::vector<TabulatedSize> table;
  for (const double diameter : request.sizes) {
    TabulatedSize size;
    size.diameter = diameter;
    const CaptureVelocity capture = capture_velocity(model, values, request.dataset, diameter);
    size.captures =
        capture.found && capture.value > 0.0 && !without_adhesion(model, request.dataset);
    if (size.captures) size.capture_velocity.value = capture.value;
    size.velocity = tabulated(request.slowest, request.fastest, size.capture_velocity.value);
    const std::vector<double> square =
        squares_of_nature(model, values, request.dataset, diameter, size.velocity);
    for (std::size_t k = 0; k < square.size(); ++k) {
      const bool stays = size.captures && size.velocity[k] <= size.capture_velocity.value;
      size.restitution.push_back({stays ? 0.0 : std::sqrt(std::max(square[k], 0.0))});
    }
    add_bands(model, request, size);
    table.push_back(std::move(size));
  }
  return table;
}

std::string csv_restitution(const std::vector<TabulatedSize>& table) {
  std::string csv = "diameter_um,incident_velocity_m_s,restitution_1,lower_1,upper_1\n";
  for (const TabulatedSize& size : table) {
    for (std::size_t k = 0; k < size.velocity.size(); ++k) {
      csv += fmt::format("{:.9g},{:.9g},{}\n", size.diameter / units::um, size.velocity[k],
                         banded(size.restitution[k]));
    }
  }
  return csv;
}

std::string csv_captures(const std::vector<TabulatedSize>& table) {
  std::string csv = "diameter_um,capture_velocity_m_s,lower_m_s,upper_m_s\n";
  for (const TabulatedSize& size : table) {
    if (!size.captures) continue;
    csv += fmt::format("{:.9g},{}\n", size.diameter / units::um, banded(size.capture_velocity));
  }
  return csv;
}

}  // namespace recoil
