#include "python/impacts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "cli/simulated_impact.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

void require_within(const std::vector<double>& values, double unit, const char* what,
                    const char* unit_name, std::pair<double, double> limits) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i] / unit;
    if (value >= limits.first && value <= limits.second) continue;
    throw InputError({}, fmt::format("the {} of impact {} is {:g} {}", what, i, value, unit_name),
                     "",
                     fmt::format("give a {} between {:g} and {:g} {}", what, limits.first,
                                 limits.second, unit_name));
  }
}

}  // namespace

ManyImpacts simulate_many(const ImpactModel& model, std::size_t dataset,
                          const std::vector<double>& velocity, const std::vector<double>& diameter,
                          bool slopes) {
  require_within(velocity, units::m, "velocity", "m/s", velocity_limits);
  require_within(diameter, units::um, "diameter", "um", diameter_limits_um);
  const std::size_t count = velocity.size();
  std::vector<PointConditions> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) points.push_back({dataset, diameter[i], velocity[i]});
  PointPredictor predictor(model, std::move(points));
  const std::vector<double> theta = model.initial();
  predictor.evaluate(theta, slopes);
  const std::size_t slots = theta.size();
  ManyImpacts out;
  out.restitution_squared.assign(count, std::numeric_limits<double>::quiet_NaN());
  out.captured.assign(count, 0);
  if (slopes) {
    out.slopes.assign(slots + 2,
                      std::vector<double>(count, std::numeric_limits<double>::quiet_NaN()));
  }
  std::vector<double> row(slots);
  for (std::size_t i = 0; i < count; ++i) {
    const ImpactResult& result = predictor.at(i);
    if (!result.usable()) continue;
    out.restitution_squared[i] = result.restitution_squared;
    out.captured[i] = result.restitution_squared > 0.0 ? 0 : 1;
    if (!slopes) continue;
    predictor.gradient_row(i, 1.0, row);
    for (std::size_t s = 0; s < slots; ++s) out.slopes[s][i] = row[s];
    out.slopes[slots][i] = predictor.velocity_slope(i);
    out.slopes[slots + 1][i] = predictor.diameter_slope(i);
  }
  return out;
}

}  // namespace recoil
