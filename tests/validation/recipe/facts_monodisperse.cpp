// Facts about series of one size each (Wall et al. 1990, Dahneke 1975).
#include "validation/recipe/facts_monodisperse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/units.hpp"
#include "validation/recipe/fact_tools.hpp"
#include "validation/recipe/facts_constants.hpp"

namespace recoil {
namespace {

FactOutcome design_range(const FactContext& context, const FactLimits& limits) {
  std::set<double> diameters;
  double lowest = context.points.front().velocity;
  double highest = lowest;
  for (const GeneratedPoint& point : context.points) {
    diameters.insert(point.diameter);
    lowest = std::min(lowest, point.velocity);
    highest = std::max(highest, point.velocity);
  }
  const bool sizes = static_cast<double>(diameters.size()) == limits.at("diameters") &&
                     std::abs(*diameters.begin() / limits.at("smallest_diameter") - 1.0) < 1e-9 &&
                     std::abs(*diameters.rbegin() / limits.at("largest_diameter") - 1.0) < 1e-9;
  return {sizes && within(lowest, limits.at("lowest_from"), limits.at("lowest_to")) &&
              within(highest, limits.at("highest_from"), limits.at("highest_to")),
          fmt::format("{} size(s), {:.2f} to {:.2f} um; {:.3g} to {:.3g} m/s", diameters.size(),
                      *diameters.begin() / units::um, *diameters.rbegin() / units::um, lowest,
                      highest)};
}

FactOutcome no_capture(const FactContext& context, const FactLimits&) {
  double lowest = 1.0;
  for (const PlannedPoint& point : context.recipe.plan) {
    lowest = std::min(lowest, point.restitution);
  }
  for (const GeneratedPoint& point : context.points) lowest = std::min(lowest, point.restitution);
  return {lowest > 0.0, fmt::format("lowest e {:.3f}", lowest)};
}

/// "Some" velocities: those of the series that begins nearest.
FactOutcome near_capture(const FactContext& context, const FactLimits& limits) {
  double nearest = 1e9;
  double farthest = 0.0;
  for (const RecipeSeries& series : context.recipe.series) {
    const double ratio =
        series.velocities.front() / true_capture_velocity(context.recipe.truth, series.diameter);
    nearest = std::min(nearest, ratio);
    farthest = std::max(farthest, ratio);
  }
  return {within(nearest, limits.at("from"), limits.at("to")),
          fmt::format("lowest velocities are {:.2f} to {:.2f} V* (the nearest {:g} .. {:g})",
                      nearest, farthest, limits.at("from"), limits.at("to"))};
}

FactOutcome capture_velocity_fact(const FactContext& context, const FactLimits& limits) {
  const double value = true_capture_velocity(context.recipe.truth, limits.at("diameter"));
  return {within(value, limits.at("from"), limits.at("to")),
          fmt::format("V* {:.2f} m/s at {:.2f} um (allowed {:.2f} .. {:.2f})", value,
                      limits.at("diameter") / units::um, limits.at("from"), limits.at("to"))};
}

FactOutcome capture_slope(const FactContext& context, const FactLimits& limits) {
  const double small = context.recipe.series.front().diameter;
  const double large = context.recipe.series.back().diameter;
  const double at_small = true_capture_velocity(context.recipe.truth, small);
  const double at_large = true_capture_velocity(context.recipe.truth, large);
  const double slope = std::log(at_large / at_small) / std::log(large / small);
  return {within(slope, limits.at("from"), limits.at("to")),
          fmt::format("V* {:.2f} to {:.2f} m/s, d^({:.2f}) (allowed {:.2f} .. {:.2f})", at_small,
                      at_large, slope, limits.at("from"), limits.at("to"))};
}

FactOutcome high_velocity_loss(const FactContext& context, const FactLimits& limits) {
  double least = 1.0;
  double most = 0.0;
  for (std::size_t series = 0; series < context.recipe.series.size(); ++series) {
    const double e = points_of(context, series).back().restitution;
    least = std::min(least, 1.0 - e * e);
    most = std::max(most, 1.0 - e * e);
  }
  return {least >= limits.at("from") && most <= limits.at("to"),
          fmt::format("1 - e^2 is {:.3f} to {:.3f} at the highest velocity (allowed {:.2f} .. "
                      "{:.2f})",
                      least, most, limits.at("from"), limits.at("to"))};
}

/// Largest and smallest e over this recipe and its siblings, sphere by sphere.
struct Spread {
  double largest = 0.0;
  double velocity = 0.0;
  double diameter = 0.0;
};

Spread target_spread(const FactContext& context, double from, double to) {
  Spread spread;
  for (const RecipeSeries& series : context.recipe.series) {
    double start = from;
    if (start == 0.0) {  // from where no target captures this size any more
      start = true_capture_velocity(context.recipe.truth, series.diameter);
      for (const Recipe& sibling : context.siblings) {
        start = std::max(start, true_capture_velocity(sibling.truth, series.diameter));
      }
    }
    for (const double velocity : log_grid(1.01 * start, to, 24)) {
      double low = true_restitution(context.recipe.truth, series.diameter, velocity);
      double high = low;
      for (const Recipe& sibling : context.siblings) {
        const double e = true_restitution(sibling.truth, series.diameter, velocity);
        low = std::min(low, e);
        high = std::max(high, e);
      }
      if (high - low > spread.largest) spread = {high - low, velocity, series.diameter};
    }
  }
  return spread;
}

std::string describe_spread(const Spread& spread, std::size_t targets) {
  return fmt::format("largest difference over {} targets {:.3f}, at {:.3g} m/s and {:.2f} um",
                     targets, spread.largest, spread.velocity, spread.diameter / units::um);
}

FactOutcome target_independence(const FactContext& context, const FactLimits& limits) {
  const Spread spread =
      target_spread(context, limits.at("velocity"), context.recipe.series.back().velocities.back());
  return {!context.siblings.empty() && spread.largest <= limits.at("most"),
          fmt::format("{} (at most {:.3f})", describe_spread(spread, 1 + context.siblings.size()),
                      limits.at("most"))};
}

FactOutcome target_dependence(const FactContext& context, const FactLimits& limits) {
  const Spread spread = target_spread(context, 0.0, limits.at("velocity"));
  return {spread.largest >= limits.at("least"),
          fmt::format("{} (at least {:.2f})", describe_spread(spread, 1 + context.siblings.size()),
                      limits.at("least"))};
}

FactOutcome size_dependence(const FactContext& context, const FactLimits& limits) {
  const Truth& truth = context.recipe.truth;
  const double small = context.recipe.series.front().diameter;
  const double large = context.recipe.series.back().diameter;
  const double start = 1.01 * true_capture_velocity(truth, small);
  double most = 0.0;
  bool ordered = true;
  for (const double velocity : log_grid(start, limits.at("velocity"), 24)) {
    const double difference =
        true_restitution(truth, large, velocity) - true_restitution(truth, small, velocity);
    most = std::max(most, difference);
    ordered = ordered && difference > -0.01;
  }
  return {most >= limits.at("least") && ordered,
          fmt::format("the largest sphere keeps up to {:.2f} more e than the smallest (at least "
                      "{:.2f})",
                      most, limits.at("least"))};
}

FactOutcome adhesion_onset(const FactContext& context, const FactLimits& limits) {
  const Truth bare = without_adhesion(context.recipe.truth);
  double above = 0.0;
  double at_lowest = 1.0;
  for (const RecipeSeries& series : context.recipe.series) {
    for (std::size_t i = 0; i < series.velocities.size(); ++i) {
      const double velocity = series.velocities[i];
      const double cost = true_restitution(bare, series.diameter, velocity) -
                          true_restitution(context.recipe.truth, series.diameter, velocity);
      if (velocity >= limits.at("velocity")) above = std::max(above, cost);
      if (i == 0) at_lowest = std::min(at_lowest, cost);
    }
  }
  return {above <= limits.at("most_above") && at_lowest >= limits.at("least_at_lowest"),
          fmt::format("adhesion costs at most {:.3f} of e from {:g} m/s on, and at least {:.2f} at "
                      "the lowest velocities",
                      above, limits.at("velocity"), at_lowest)};
}

FactOutcome highest_restitution(const FactContext& context, const FactLimits& limits) {
  const Truth& truth = context.recipe.truth;
  const double diameter = limits.at("diameter");
  const double last = context.recipe.series.back().velocities.back();
  double highest = 0.0;
  double where = 0.0;
  for (const double velocity : log_grid(1.01 * true_capture_velocity(truth, diameter), last, 200)) {
    const double e = true_restitution(truth, diameter, velocity);
    if (e > highest) {
      highest = e;
      where = velocity;
    }
  }
  const double fall = highest - true_restitution(truth, diameter, last);
  return {within(where, limits.at("from"), limits.at("to")) && fall >= limits.at("least_fall"),
          fmt::format("e is highest, {:.3f}, at {:.1f} m/s (allowed {:g} .. {:g}) and falls by "
                      "{:.3f} up to {:g} m/s (at least {:.3f})",
                      highest, where, limits.at("from"), limits.at("to"), fall, last,
                      limits.at("least_fall"))};
}

FactOutcome falls_below(const FactContext& context, const FactLimits& limits) {
  const double onset = limits.at("velocity");
  bool steady = true;
  double least_fall = 1.0;
  for (const RecipeSeries& series : context.recipe.series) {
    const double start = series.velocities.front();
    const std::vector<double> grid = log_grid(start, onset, 40);
    double before = 0.0;
    for (const double velocity : grid) {
      const double e = true_restitution(context.recipe.truth, series.diameter, velocity);
      steady = steady && e > before;
      before = e;
    }
    least_fall = std::min(least_fall,
                          before - true_restitution(context.recipe.truth, series.diameter, start));
  }
  return {steady && least_fall >= limits.at("least_fall"),
          fmt::format("e falls {} from {:g} m/s down, by {:.3f} (at least {:.3f})",
                      steady ? "steadily" : "not steadily", onset, least_fall,
                      limits.at("least_fall"))};
}

}  // namespace

const std::vector<FactKind>& monodisperse_facts() {
  static const std::vector<FactKind> catalogue = {
      {"design-range",
       {"diameters", "smallest_diameter", "largest_diameter", "lowest_from", "lowest_to",
        "highest_from", "highest_to"},
       design_range},
      {"no-capture", {}, no_capture},
      {"near-capture", {"from", "to"}, near_capture},
      {"capture-velocity", {"diameter", "from", "to"}, capture_velocity_fact},
      {"capture-slope", {"from", "to"}, capture_slope},
      {"high-velocity-loss", {"from", "to"}, high_velocity_loss},
      {"target-independence", {"velocity", "most"}, target_independence},
      {"target-dependence", {"velocity", "least"}, target_dependence},
      {"size-dependence", {"velocity", "least"}, size_dependence},
      {"adhesion-onset", {"velocity", "most_above", "least_at_lowest"}, adhesion_onset},
      {"falls-below", {"velocity", "least_fall"}, falls_below},
      {"printed-constants",
       {"diameter", "stiffness_K", "adhesion_energy", "adhesion_force_f0", "tolerance"},
       printed_constants},
      {"two-point-runs-low",
       {"calibrated_on", "judged_on", "below_velocity", "mean_from", "mean_to"},
       two_point_runs_low},
      {"two-point-agrees", {"calibrated_on", "away", "most"}, two_point_agrees},
      {"highest-restitution", {"diameter", "from", "to", "least_fall"}, highest_restitution},
  };
  return catalogue;
}

}  // namespace recoil
