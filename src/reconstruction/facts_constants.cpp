// Facts that compare with the paper's Table 1 and with its calibration.
#include <fmt/format.h>

#include "core/units.hpp"
#include "reconstruction/fact_tools.hpp"
#include "reconstruction/two_point_calibration.hpp"

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
  std::vector<GeneratedPoint> calibration;
  std::vector<GeneratedPoint> judged;
  for (const GeneratedPoint& point : context.points) {
    if (near(point.diameter, limits.at("calibrated_on"), 1e-6)) calibration.push_back(point);
    if (near(point.diameter, limits.at("judged_on"), 1e-6) &&
        point.velocity < limits.at("below_velocity")) {
      judged.push_back(point);
    }
  }
  if (calibration.size() < 2 || judged.empty()) return {false, "no such diameters"};
  const TwoPointCalibration calibrated = calibrate_by_two_points(
      ring_adhesion_model_of(context.recipe, limits.at("calibrated_on")),
      limits.at("calibrated_on"), {calibration.front().velocity, calibration.front().restitution},
      {calibration.back().velocity, calibration.back().restitution});
  if (!calibrated.found) return {false, "no two-point calibration: " + calibrated.why};
  double sum = 0.0;
  int lower = 0;
  for (const GeneratedPoint& point : judged) {
    const double difference =
        true_restitution(calibrated.model, point.diameter, point.velocity) - point.restitution;
    sum += difference;
    lower += difference < 0.0 ? 1 : 0;
  }
  const double mean = sum / static_cast<double>(judged.size());
  return {within(mean, limits.at("mean_from"), limits.at("mean_to")),
          fmt::format("mean difference {:+.3f} (allowed {:+.3f} .. {:+.3f}), lower at {} of {} "
                      "points; C_H {:.2e}, C_A {:.2e} s/m",
                      mean, limits.at("mean_from"), limits.at("mean_to"), lower, judged.size(),
                      calibrated.model.C_H, calibrated.model.C_A)};
}

}  // namespace recoil
