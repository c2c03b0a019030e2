// Facts that compare with the paper's Table 1 and with its calibration.
#include "validation/recipe/facts_constants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "validation/recipe/fact_tools.hpp"
#include "validation/recipe/two_point_calibration.hpp"

namespace recoil {
namespace {

/// The ring-adhesion model of the recipe's system, f0 by eq. 12 at `diameter`, no damping yet.
RingAdhesionTruth ring_adhesion_model_of(const Recipe& recipe, double diameter) {
  const DerivedContact derived = derive_recipe_contact(recipe.particle, recipe.surface);
  RingAdhesionTruth model;
  model.density = recipe.particle.density;
  model.stiffness = derived.stiffness;
  model.reference_diameter = diameter;
  model.adhesion_force =
      recipe_adhesion_force(derived.stiffness, derived.adhesion_energy, diameter);
  return model;
}

bool near(double value, double printed, double tolerance) {
  return std::abs(value / printed - 1.0) <= tolerance;
}

/// The paper's calibration by the lowest and the highest velocity of one size.
TwoPointCalibration calibrate(const FactContext& context, double diameter) {
  std::vector<GeneratedPoint> points;
  for (const GeneratedPoint& point : context.points) {
    if (near(point.diameter, diameter, 1e-6)) points.push_back(point);
  }
  if (points.size() < 2) {
    TwoPointCalibration none;
    none.why = "no such diameter";
    return none;
  }
  return calibrate_by_two_points(ring_adhesion_model_of(context.recipe, diameter), diameter,
                                 {points.front().velocity, points.front().restitution},
                                 {points.back().velocity, points.back().restitution});
}

}  // namespace

FactOutcome printed_constants(const FactContext& context, const FactLimits& limits) {
  const DerivedContact derived =
      derive_recipe_contact(context.recipe.particle, context.recipe.surface);
  const double f0 =
      recipe_adhesion_force(derived.stiffness, derived.adhesion_energy, limits.at("diameter"));
  const double tolerance = limits.at("tolerance");
  return {
      near(derived.stiffness, limits.at("stiffness_K"), tolerance) &&
          near(derived.adhesion_energy, limits.at("adhesion_energy"), tolerance) &&
          near(f0, limits.at("adhesion_force_f0"), tolerance),
      fmt::format("K {:.3f} GPa, W {:.3f} J/m2, f0 {:.2f} N/m (within {:.1f} % of print)",
                  derived.stiffness / units::GPa, derived.adhesion_energy, f0, 100.0 * tolerance)};
}

FactOutcome contradictory_constants(const FactContext& context, const FactLimits& limits) {
  const DerivedContact derived =
      derive_recipe_contact(context.recipe.particle, context.recipe.surface);
  const double printed = limits.at("stiffness_K");
  const double f0 =
      recipe_adhesion_force(printed, limits.at("adhesion_energy"), limits.at("diameter"));
  const double K_ratio = derived.stiffness / printed;
  const double f0_ratio = limits.at("adhesion_force_f0") / f0;
  return {K_ratio >= limits.at("least_K_ratio") && f0_ratio >= limits.at("least_f0_ratio"),
          fmt::format("E and nu give K {:.1f} GPa, {:.1f} times the printed; printed K and W give "
                      "f0 {:.1f} N/m, the printed is {:.2f} times that",
                      derived.stiffness / units::GPa, K_ratio, f0, f0_ratio)};
}

FactOutcome two_point_runs_low(const FactContext& context, const FactLimits& limits) {
  const TwoPointCalibration calibrated = calibrate(context, limits.at("calibrated_on"));
  if (!calibrated.found) return {false, "no two-point calibration: " + calibrated.why};
  double sum = 0.0;
  int lower = 0;
  int count = 0;
  for (const GeneratedPoint& point : context.points) {
    if (!near(point.diameter, limits.at("judged_on"), 1e-6) ||
        point.velocity >= limits.at("below_velocity")) {
      continue;
    }
    const double difference =
        true_restitution(calibrated.model, point.diameter, point.velocity) - point.restitution;
    sum += difference;
    lower += difference < 0.0 ? 1 : 0;
    ++count;
  }
  if (count == 0) return {false, "no such diameter"};
  const double mean = sum / count;
  return {within(mean, limits.at("mean_from"), limits.at("mean_to")),
          fmt::format("mean difference {:+.3f} (allowed {:+.3f} .. {:+.3f}), lower at {} of {} "
                      "points; C_H {:.2e}, C_A {:.2e} s/m",
                      mean, limits.at("mean_from"), limits.at("mean_to"), lower, count,
                      calibrated.model.C_H, calibrated.model.C_A)};
}

FactOutcome two_point_agrees(const FactContext& context, const FactLimits& limits) {
  const TwoPointCalibration calibrated = calibrate(context, limits.at("calibrated_on"));
  if (!calibrated.found) return {false, "no two-point calibration: " + calibrated.why};
  double squares = 0.0;
  double largest = 0.0;
  int count = 0;
  for (std::size_t series = 0; series < context.recipe.series.size(); ++series) {
    const double diameter = context.recipe.series[series].diameter;
    if (near(diameter, limits.at("calibrated_on"), 1e-6)) continue;
    const double away = limits.at("away") * true_capture_velocity(context.recipe.truth, diameter);
    for (const GeneratedPoint& point : points_of(context, series)) {
      if (point.velocity < away) continue;
      const double difference =
          true_restitution(calibrated.model, diameter, point.velocity) - point.restitution;
      squares += difference * difference;
      largest = std::max(largest, std::abs(difference));
      ++count;
    }
  }
  if (count == 0) return {false, "no other diameter"};
  const double rms = std::sqrt(squares / count);
  return {rms <= limits.at("most"),
          fmt::format("rms difference {:.3f} over {} points of the other sizes from {:g} V* on (at "
                      "most {:.3f}), largest {:.3f}",
                      rms, count, limits.at("away"), limits.at("most"), largest)};
}

}  // namespace recoil
