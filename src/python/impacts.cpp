#include "python/impacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"
#include "estimate/predictor.hpp"
#include "predict/simulated_impact.hpp"

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
  const std::vector<double> theta = model.initial();
  const std::size_t slots = theta.size();
  ManyImpacts out;
  out.restitution_squared.assign(count, std::numeric_limits<double>::quiet_NaN());
  out.captured.assign(count, 0);
  if (slopes) {
    out.slopes.assign(slots + 2,
                      std::vector<double>(count, std::numeric_limits<double>::quiet_NaN()));
  }
  std::vector<double> row(slots);
  // Part by part, as a large array can be called off between two of them.
  constexpr std::size_t part = 20000;
  for (std::size_t begin = 0; begin < count; begin += part) {
    const std::size_t end = std::min(count, begin + part);
    std::vector<PointConditions> points;
    for (std::size_t i = begin; i < end; ++i) points.push_back({dataset, diameter[i], velocity[i]});
    PointPredictor predictor(model, std::move(points));
    predictor.evaluate(theta, slopes);
    for (std::size_t i = begin; i < end; ++i) {
      const ImpactResult& result = predictor.at(i - begin);
      if (!result.usable()) continue;
      out.restitution_squared[i] = result.restitution_squared;
      out.captured[i] = result.restitution_squared > 0.0 ? 0 : 1;
      if (!slopes) continue;
      predictor.gradient_row(i - begin, 1.0, row);
      for (std::size_t s = 0; s < slots; ++s) out.slopes[s][i] = row[s];
      out.slopes[slots][i] = predictor.velocity_slope(i - begin);
      out.slopes[slots + 1][i] = predictor.diameter_slope(i - begin);
    }
  }
  return out;
}

}  // namespace recoil
