// Facts about mixed sizes, of which only the rebounds are seen (Li, Dunn & Brach 1999).
#include "validation/recipe/facts_polydisperse.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/units.hpp"
#include "validation/recipe/fact_tools.hpp"
#include "validation/recipe/facts_constants.hpp"

namespace recoil {
namespace {

FactOutcome size_distribution(const FactContext& context, const FactLimits& limits) {
  if (!context.recipe.sizes) return {false, "the recipe has no [sizes]"};
  const SizeDistribution& sizes = *context.recipe.sizes;
  const double mean = sizes.mean();
  return {std::abs(sizes.lower / limits.at("lower") - 1.0) < 1e-9 &&
              std::abs(sizes.upper / limits.at("upper") - 1.0) < 1e-9 &&
              within(mean, limits.at("mean_from"), limits.at("mean_to")),
          fmt::format("d10 {:.1f} um, {:.0f} to {:.0f} um", mean / units::um,
                      sizes.lower / units::um, sizes.upper / units::um)};
}

FactOutcome velocity_range(const FactContext& context, const FactLimits& limits) {
  const double lowest = context.points.front().velocity;
  const double highest = context.points.back().velocity;
  return {within(lowest, limits.at("lowest_from"), limits.at("lowest_to")) &&
              within(highest, limits.at("highest_from"), limits.at("highest_to")),
          fmt::format("{:.3g} to {:.3g} m/s", lowest, highest)};
}

FactOutcome events_per_point(const FactContext& context, const FactLimits& limits) {
  int fewest = context.points.front().events;
  int most = fewest;
  for (const GeneratedPoint& point : context.points) {
    fewest = std::min(fewest, point.events);
    most = std::max(most, point.events);
  }
  return {fewest >= limits.at("from") && most <= limits.at("to"),
          fmt::format("{} to {} rebounds per mean", fewest, most)};
}

FactOutcome event_uncertainty(const FactContext& context, const FactLimits& limits) {
  const double relative = context.recipe.noise.relative;
  return {within(relative, limits.at("from"), limits.at("to")),
          fmt::format("one event scatters by {:.0f} % of e", 100.0 * relative)};
}

FactOutcome capture_range(const FactContext& context, const FactLimits& limits) {
  const double large = true_capture_velocity(context.recipe.truth, limits.at("large_diameter"));
  const double small = true_capture_velocity(context.recipe.truth, limits.at("small_diameter"));
  return {std::abs(large / limits.at("large_capture") - 1.0) <= limits.at("tolerance") &&
              std::abs(small / limits.at("small_capture") - 1.0) <= limits.at("tolerance"),
          fmt::format("V* {:.3f} m/s at {:.0f} um and {:.2f} m/s at {:.0f} um (within {:.0f} %)",
                      large, limits.at("large_diameter") / units::um, small,
                      limits.at("small_diameter") / units::um, 100.0 * limits.at("tolerance"))};
}

/// e averaged over the points at `velocity` and above.
double plateau(const std::vector<GeneratedPoint>& points, double velocity) {
  double sum = 0.0;
  int count = 0;
  for (const GeneratedPoint& point : points) {
    if (point.velocity < velocity) continue;
    sum += point.restitution;
    ++count;
  }
  return sum / count;
}

FactOutcome flat_above(const FactContext& context, const FactLimits& limits) {
  const double level = plateau(context.points, limits.at("velocity"));
  double most = 0.0;
  for (const GeneratedPoint& point : context.points) {
    if (point.velocity < limits.at("velocity")) continue;
    most = std::max(most, std::abs(point.restitution / level - 1.0));
  }
  return {
      most <= limits.at("most_change"),
      fmt::format("from {:g} m/s on e stays within {:.0f} % of its mean {:.3f} (allowed "
                  "{:.0f} %)",
                  limits.at("velocity"), 100.0 * most, level, 100.0 * limits.at("most_change"))};
}

FactOutcome lower_below(const FactContext& context, const FactLimits& limits) {
  const double level = plateau(context.points, limits.at("velocity"));
  double sum = 0.0;
  int count = 0;
  for (const GeneratedPoint& point : context.points) {
    if (point.velocity >= limits.at("velocity")) break;
    sum += point.restitution;
    ++count;
  }
  if (count == 0) return {false, "no point below"};
  const double drop = level - sum / count;
  return {drop >= limits.at("least_drop"),
          fmt::format("below {:g} m/s e is lower by {:.3f} on average over {} points (at least "
                      "{:.3f})",
                      limits.at("velocity"), drop, count, limits.at("least_drop"))};
}

/// What e loses from its highest to the lowest velocity, without noise.
double true_drop(const Recipe& recipe) {
  double highest = 0.0;
  for (const PlannedPoint& point : recipe.plan) highest = std::max(highest, point.restitution);
  return highest - recipe.plan.front().restitution;
}

FactOutcome adhesion_by_size(const FactContext& context, const FactLimits& limits) {
  if (context.siblings.size() != 1 || !context.recipe.sizes || !context.siblings[0].sizes) {
    return {false, "needs one sibling with mixed sizes"};
  }
  const Recipe& sibling = context.siblings.front();
  const bool smaller = context.recipe.sizes->mean() < sibling.sizes->mean();
  const double fine = true_drop(smaller ? context.recipe : sibling);
  const double coarse = true_drop(smaller ? sibling : context.recipe);
  return {fine - coarse >= limits.at("least"),
          fmt::format("towards the lowest velocity e falls by {:.3f} for the smaller spheres, "
                      "{:.3f} for the larger (differing by at least {:.2f})",
                      fine, coarse, limits.at("least"))};
}

FactOutcome unseen_impacts(const FactContext& context, const FactLimits& limits) {
  const PlannedPoint& lowest = context.recipe.plan.front();
  const double alone = true_restitution(context.recipe.truth, lowest.diameter, lowest.velocity);
  const double lost = 1.0 - lowest.seen;
  return {within(lost, limits.at("lost_from"), limits.at("lost_to")),
          fmt::format("at {:g} m/s {:.0f} % of the impacts are not seen; the rest averages {:.3f}, "
                      "a sphere of {:.0f} um alone {:.3f}",
                      lowest.velocity, 100.0 * lost, lowest.restitution,
                      lowest.diameter / units::um, alone)};
}

}  // namespace

const std::vector<FactKind>& polydisperse_facts() {
  static const std::vector<FactKind> catalogue = {
      {"size-distribution", {"lower", "upper", "mean_from", "mean_to"}, size_distribution},
      {"velocity-range",
       {"lowest_from", "lowest_to", "highest_from", "highest_to"},
       velocity_range},
      {"events-per-point", {"from", "to"}, events_per_point},
      {"event-uncertainty", {"from", "to"}, event_uncertainty},
      {"capture-range",
       {"large_diameter", "small_diameter", "large_capture", "small_capture", "tolerance"},
       capture_range},
      {"flat-above", {"velocity", "most_change"}, flat_above},
      {"lower-below", {"velocity", "least_drop"}, lower_below},
      {"adhesion-by-size", {"least"}, adhesion_by_size},
      {"unseen-impacts", {"lost_from", "lost_to"}, unseen_impacts},
      {"contradictory-constants",
       {"diameter", "stiffness_K", "adhesion_energy", "adhesion_force_f0", "least_K_ratio",
        "least_f0_ratio"},
       contradictory_constants},
  };
  return catalogue;
}

}  // namespace recoil
