#include "validation/recipe/facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/error.hpp"
#include "core/numerics.hpp"
#include "core/units.hpp"

namespace recoil {
namespace {

bool within(double value, double lower, double upper) { return value >= lower && value <= upper; }

/// `count` values from `lower` to `upper`, equally spaced in the logarithm.
std::vector<double> log_grid(double lower, double upper, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(lower * std::pow(upper / lower, i / static_cast<double>(count - 1)));
  }
  return values;
}

/// The points of one series.
std::vector<GeneratedPoint> points_of(const FactContext& context, std::size_t series) {
  std::vector<GeneratedPoint> chosen;
  for (const GeneratedPoint& point : context.points) {
    if (point.series == series) chosen.push_back(point);
  }
  return chosen;
}

/// The ring-adhesion model of the recipe's system, f0 by eq. 12 at `diameter`, no damping yet.
Truth ring_adhesion_model_of(const Recipe& recipe, double diameter) {
  const DerivedContact derived = derive_recipe_contact(recipe.particle, recipe.surface);
  Truth model;
  model.density = recipe.particle.density;
  model.stiffness = derived.stiffness;
  model.reference_diameter = diameter;
  model.adhesion_force =
      recipe_adhesion_force(derived.stiffness, derived.adhesion_energy, diameter);
  return model;
}

/// The paper's two-point calibration of the ring-adhesion model, by the truth simulator: what facts
/// of the kind "the ring-adhesion model runs slightly low at 2.58 um" are checked with.
struct TwoPointCalibration {
  bool found = false;
  Truth model;      ///< with the calibrated C_H and C_A
  std::string why;  ///< when there is no answer
};

struct CalibrationPoint {
  double velocity = 0.0;     ///< [m/s]
  double restitution = 0.0;  ///< [1]
};

constexpr double settled = 1e-6;  // relative change; points carry 1e-3 at best
constexpr int max_rounds = 50;

/// The damping `coefficient` of the model that gives `point`; negative when none >= 0 does.
double damping_for(Truth model, double Truth::*coefficient, double diameter,
                   const CalibrationPoint& point) {
  const auto excess = [&](double value) {
    model.*coefficient = value;
    return true_restitution(model, diameter, point.velocity) - point.restitution;
  };
  if (excess(0.0) < 0.0) return -1.0;
  double upper = 0.01;
  while (excess(upper) > 0.0) {
    upper *= 2.0;
    if (upper > 1000.0) return -1.0;
  }
  return find_root(excess, 0.0, upper, 1e-9);
}

/// C_H from `high` (C_A = 0 at first), C_A from `low`, in turn until both stand still
/// (Li, Dunn & Brach 1999, section 4).
TwoPointCalibration calibrate_by_two_points(Truth model, double diameter,
                                            const CalibrationPoint& low,
                                            const CalibrationPoint& high) {
  TwoPointCalibration result;
  model.C_H = 0.0;
  model.C_A = 0.0;
  for (int round = 0; round < max_rounds; ++round) {
    const double C_H = damping_for(model, &Truth::C_H, diameter, high);
    if (C_H < 0.0) {
      result.why = "adhesion alone costs more than was lost at the highest velocity";
      return result;
    }
    model.C_H = C_H;
    const double before = model.C_A;
    const double C_A = damping_for(model, &Truth::C_A, diameter, low);
    if (C_A < 0.0) {
      result.why = "no adhesion damping gives the restitution of the lowest velocity";
      return result;
    }
    model.C_A = C_A;
    if (std::abs(C_A - before) <= settled * C_A) {
      result.found = true;
      result.model = model;
      return result;
    }
  }
  result.why = "the iteration did not settle";
  return result;
}

bool near(double value, double printed, double allowed) {
  return std::abs(value / printed - 1.0) <= allowed;
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

/// Calibrated curve minus points of the size `diameter` from `away` V* on.
std::vector<double> differences(const FactContext& context, const TwoPointCalibration& calibrated,
                                double diameter, double away) {
  const double start = away * true_capture_velocity(context.recipe.truth, diameter);
  std::vector<double> found;
  for (const GeneratedPoint& point : context.points) {
    if (!near(point.diameter, diameter, 1e-6) || point.velocity < start) continue;
    found.push_back(true_restitution(calibrated.model, diameter, point.velocity) -
                    point.restitution);
  }
  return found;
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

/// What e loses from its highest to the lowest velocity, without noise.
double true_drop(const Recipe& recipe) {
  double highest = 0.0;
  for (const PlannedPoint& point : recipe.plan) highest = std::max(highest, point.restitution);
  return highest - recipe.plan.front().restitution;
}

const std::vector<FactKind>& catalogue() {
  static const std::vector<FactKind> kinds = {
      {"design-range",
       {"diameters", "smallest_diameter", "largest_diameter", "lowest_from", "lowest_to",
        "highest_from", "highest_to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         std::set<double> diameters;
         double lowest = context.points.front().velocity;
         double highest = lowest;
         for (const GeneratedPoint& point : context.points) {
           diameters.insert(point.diameter);
           lowest = std::min(lowest, point.velocity);
           highest = std::max(highest, point.velocity);
         }
         const bool sizes =
             static_cast<double>(diameters.size()) == limits.at("diameters") &&
             std::abs(*diameters.begin() / limits.at("smallest_diameter") - 1.0) < 1e-9 &&
             std::abs(*diameters.rbegin() / limits.at("largest_diameter") - 1.0) < 1e-9;
         return {sizes && within(lowest, limits.at("lowest_from"), limits.at("lowest_to")) &&
                     within(highest, limits.at("highest_from"), limits.at("highest_to")),
                 fmt::format("{} size(s), {:.2f} to {:.2f} um; {:.3g} to {:.3g} m/s",
                             diameters.size(), *diameters.begin() / units::um,
                             *diameters.rbegin() / units::um, lowest, highest)};
       }},
      {"no-capture",
       {},
       [](const FactContext& context, const FactLimits&) -> FactOutcome {
         double lowest = 1.0;
         for (const PlannedPoint& point : context.recipe.plan) {
           lowest = std::min(lowest, point.restitution);
         }
         for (const GeneratedPoint& point : context.points)
           lowest = std::min(lowest, point.restitution);
         return {lowest > 0.0, fmt::format("lowest e {:.3f}", lowest)};
       }},
      // "Some" velocities: those of the series that begins nearest.
      {"near-capture",
       {"from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         double nearest = 1e9;
         double farthest = 0.0;
         for (const RecipeSeries& series : context.recipe.series) {
           const double ratio = series.velocities.front() /
                                true_capture_velocity(context.recipe.truth, series.diameter);
           nearest = std::min(nearest, ratio);
           farthest = std::max(farthest, ratio);
         }
         return {within(nearest, limits.at("from"), limits.at("to")),
                 fmt::format("lowest velocities are {:.2f} to {:.2f} V* (the nearest {:g} .. {:g})",
                             nearest, farthest, limits.at("from"), limits.at("to"))};
       }},
      {"capture-velocity",
       {"diameter", "from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double value = true_capture_velocity(context.recipe.truth, limits.at("diameter"));
         return {
             within(value, limits.at("from"), limits.at("to")),
             fmt::format("V* {:.2f} m/s at {:.2f} um (allowed {:.2f} .. {:.2f})", value,
                         limits.at("diameter") / units::um, limits.at("from"), limits.at("to"))};
       }},
      {"capture-slope",
       {"from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double small = context.recipe.series.front().diameter;
         const double large = context.recipe.series.back().diameter;
         const double at_small = true_capture_velocity(context.recipe.truth, small);
         const double at_large = true_capture_velocity(context.recipe.truth, large);
         const double slope = std::log(at_large / at_small) / std::log(large / small);
         return {within(slope, limits.at("from"), limits.at("to")),
                 fmt::format("V* {:.2f} to {:.2f} m/s, d^({:.2f}) (allowed {:.2f} .. {:.2f})",
                             at_small, at_large, slope, limits.at("from"), limits.at("to"))};
       }},
      {"high-velocity-loss",
       {"from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         double least = 1.0;
         double most = 0.0;
         for (std::size_t series = 0; series < context.recipe.series.size(); ++series) {
           const double e = points_of(context, series).back().restitution;
           least = std::min(least, 1.0 - e * e);
           most = std::max(most, 1.0 - e * e);
         }
         return {
             least >= limits.at("from") && most <= limits.at("to"),
             fmt::format("1 - e^2 is {:.3f} to {:.3f} at the highest velocity (allowed {:.2f} .. "
                         "{:.2f})",
                         least, most, limits.at("from"), limits.at("to"))};
       }},
      {"target-independence",
       {"velocity", "most"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const Spread spread = target_spread(context, limits.at("velocity"),
                                             context.recipe.series.back().velocities.back());
         return {
             !context.siblings.empty() && spread.largest <= limits.at("most"),
             fmt::format("{} (at most {:.3f})",
                         describe_spread(spread, 1 + context.siblings.size()), limits.at("most"))};
       }},
      {"target-dependence",
       {"velocity", "least"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const Spread spread = target_spread(context, 0.0, limits.at("velocity"));
         return {
             spread.largest >= limits.at("least"),
             fmt::format("{} (at least {:.2f})",
                         describe_spread(spread, 1 + context.siblings.size()), limits.at("least"))};
       }},
      {"size-dependence",
       {"velocity", "least"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
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
         return {
             most >= limits.at("least") && ordered,
             fmt::format("the largest sphere keeps up to {:.2f} more e than the smallest (at least "
                         "{:.2f})",
                         most, limits.at("least"))};
       }},
      {"falls-below",
       {"velocity", "least_fall"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
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
           least_fall = std::min(
               least_fall, before - true_restitution(context.recipe.truth, series.diameter, start));
         }
         return {steady && least_fall >= limits.at("least_fall"),
                 fmt::format("e falls {} from {:g} m/s down, by {:.3f} (at least {:.3f})",
                             steady ? "steadily" : "not steadily", onset, least_fall,
                             limits.at("least_fall"))};
       }},
      {"printed-constants",
       {"diameter", "stiffness_K", "adhesion_energy", "adhesion_force_f0", "tolerance"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const DerivedContact derived =
             derive_recipe_contact(context.recipe.particle, context.recipe.surface);
         const double f0 = recipe_adhesion_force(derived.stiffness, derived.adhesion_energy,
                                                 limits.at("diameter"));
         const double allowed = limits.at("tolerance");
         return {near(derived.stiffness, limits.at("stiffness_K"), allowed) &&
                     near(derived.adhesion_energy, limits.at("adhesion_energy"), allowed) &&
                     near(f0, limits.at("adhesion_force_f0"), allowed),
                 fmt::format(
                     "K {:.3f} GPa, W {:.3f} J/m2, f0 {:.2f} N/m (within {:.1f} % of print)",
                     derived.stiffness / units::GPa, derived.adhesion_energy, f0, 100.0 * allowed)};
       }},
      {"two-point-runs-low",
       {"calibrated_on", "judged_on", "mean_from", "mean_to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const TwoPointCalibration calibrated = calibrate(context, limits.at("calibrated_on"));
         if (!calibrated.found) return {false, "no two-point calibration: " + calibrated.why};
         const std::vector<double> found =
             differences(context, calibrated, limits.at("judged_on"), 0.0);
         if (found.empty()) return {false, "no such diameter"};
         double sum = 0.0;
         for (const double difference : found) sum += difference;
         const double mean = sum / static_cast<double>(found.size());
         return {within(mean, limits.at("mean_from"), limits.at("mean_to")),
                 fmt::format("mean difference {:+.3f} over {} points (allowed {:+.3f} .. {:+.3f}); "
                             "C_H {:.2e}, C_A {:.2e} s/m",
                             mean, found.size(), limits.at("mean_from"), limits.at("mean_to"),
                             calibrated.model.C_H, calibrated.model.C_A)};
       }},
      // Every size but the calibrated one and the one on which the curve runs low, each by itself.
      {"two-point-agrees",
       {"calibrated_on", "low_on", "away", "most"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const TwoPointCalibration calibrated = calibrate(context, limits.at("calibrated_on"));
         if (!calibrated.found) return {false, "no two-point calibration: " + calibrated.why};
         double worst = 0.0;
         std::vector<std::string> sizes;
         for (const RecipeSeries& series : context.recipe.series) {
           if (near(series.diameter, limits.at("calibrated_on"), 1e-6) ||
               near(series.diameter, limits.at("low_on"), 1e-6)) {
             continue;
           }
           const std::vector<double> found =
               differences(context, calibrated, series.diameter, limits.at("away"));
           if (found.empty()) return {false, "no point of " + series.name};
           double squares = 0.0;
           for (const double difference : found) squares += difference * difference;
           const double rms = std::sqrt(squares / static_cast<double>(found.size()));
           worst = std::max(worst, rms);
           sizes.push_back(fmt::format("{:.3f} at {:.2f} um", rms, series.diameter / units::um));
         }
         if (sizes.empty()) return {false, "no other diameter"};
         return {worst <= limits.at("most"),
                 fmt::format("rms difference {} from {:g} V* on (at most {:.3f})",
                             fmt::join(sizes, " and "), limits.at("away"), limits.at("most"))};
       }},
      {"adhesion-share",
       {"diameter", "velocity", "least"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double diameter = limits.at("diameter");
         const TwoPointCalibration calibrated = calibrate(context, diameter);
         if (!calibrated.found) return {false, "no two-point calibration: " + calibrated.why};
         const double share =
             adhesion_share_of_loss(calibrated.model, diameter, limits.at("velocity"));
         return {share >= limits.at("least"),
                 fmt::format(
                     "adhesion damping takes {:.0f} % of the loss at {:g} m/s (at least {:.0f} %)",
                     100.0 * share, limits.at("velocity"), 100.0 * limits.at("least"))};
       }},
      {"size-distribution",
       {"lower", "upper", "mean_from", "mean_to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         if (!context.recipe.sizes) return {false, "the recipe has no [sizes]"};
         const SizeDistribution& sizes = *context.recipe.sizes;
         const double mean = sizes.mean();
         return {std::abs(sizes.lower / limits.at("lower") - 1.0) < 1e-9 &&
                     std::abs(sizes.upper / limits.at("upper") - 1.0) < 1e-9 &&
                     within(mean, limits.at("mean_from"), limits.at("mean_to")),
                 fmt::format("d10 {:.1f} um, {:.0f} to {:.0f} um", mean / units::um,
                             sizes.lower / units::um, sizes.upper / units::um)};
       }},
      {"velocity-range",
       {"lowest_from", "lowest_to", "highest_from", "highest_to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double lowest = context.points.front().velocity;
         const double highest = context.points.back().velocity;
         return {within(lowest, limits.at("lowest_from"), limits.at("lowest_to")) &&
                     within(highest, limits.at("highest_from"), limits.at("highest_to")),
                 fmt::format("{:.3g} to {:.3g} m/s", lowest, highest)};
       }},
      {"events-per-point",
       {"from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         int fewest = context.points.front().events;
         int most = fewest;
         for (const GeneratedPoint& point : context.points) {
           fewest = std::min(fewest, point.events);
           most = std::max(most, point.events);
         }
         return {fewest >= limits.at("from") && most <= limits.at("to"),
                 fmt::format("{} to {} rebounds per mean", fewest, most)};
       }},
      {"event-uncertainty",
       {"from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double relative = context.recipe.noise.relative;
         return {within(relative, limits.at("from"), limits.at("to")),
                 fmt::format("one event scatters by {:.0f} % of e", 100.0 * relative)};
       }},
      {"capture-range",
       {"large_diameter", "small_diameter", "large_capture", "small_capture", "tolerance"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double large =
             true_capture_velocity(context.recipe.truth, limits.at("large_diameter"));
         const double small =
             true_capture_velocity(context.recipe.truth, limits.at("small_diameter"));
         return {
             std::abs(large / limits.at("large_capture") - 1.0) <= limits.at("tolerance") &&
                 std::abs(small / limits.at("small_capture") - 1.0) <= limits.at("tolerance"),
             fmt::format("V* {:.3f} m/s at {:.0f} um and {:.2f} m/s at {:.0f} um (within {:.0f} %)",
                         large, limits.at("large_diameter") / units::um, small,
                         limits.at("small_diameter") / units::um, 100.0 * limits.at("tolerance"))};
       }},
      {"flat-above",
       {"velocity", "most_change"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double level = plateau(context.points, limits.at("velocity"));
         double most = 0.0;
         for (const GeneratedPoint& point : context.points) {
           if (point.velocity < limits.at("velocity")) continue;
           most = std::max(most, std::abs(point.restitution / level - 1.0));
         }
         return {most <= limits.at("most_change"),
                 fmt::format("from {:g} m/s on e stays within {:.0f} % of its mean {:.3f} (allowed "
                             "{:.0f} %)",
                             limits.at("velocity"), 100.0 * most, level,
                             100.0 * limits.at("most_change"))};
       }},
      {"lower-below",
       {"velocity", "least_drop"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
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
         return {
             drop >= limits.at("least_drop"),
             fmt::format("below {:g} m/s e is lower by {:.3f} on average over {} points (at least "
                         "{:.3f})",
                         limits.at("velocity"), drop, count, limits.at("least_drop"))};
       }},
      {"adhesion-by-size",
       {"least"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         if (context.siblings.size() != 1 || !context.recipe.sizes || !context.siblings[0].sizes) {
           return {false, "needs one sibling with mixed sizes"};
         }
         const Recipe& sibling = context.siblings.front();
         const bool smaller = context.recipe.sizes->mean() < sibling.sizes->mean();
         const double fine = true_drop(smaller ? context.recipe : sibling);
         const double coarse = true_drop(smaller ? sibling : context.recipe);
         return {
             fine - coarse >= limits.at("least"),
             fmt::format("towards the lowest velocity e falls by {:.3f} for the smaller spheres, "
                         "{:.3f} for the larger (differing by at least {:.2f})",
                         fine, coarse, limits.at("least"))};
       }},
      {"unseen-impacts",
       {"lost_from", "lost_to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const PlannedPoint& lowest = context.recipe.plan.front();
         const double alone =
             true_restitution(context.recipe.truth, lowest.diameter, lowest.velocity);
         const double lost = 1.0 - lowest.seen;
         return {within(lost, limits.at("lost_from"), limits.at("lost_to")),
                 fmt::format(
                     "at {:g} m/s {:.0f} % of the impacts are not seen; the rest averages {:.3f}, "
                     "a sphere of {:.0f} um alone {:.3f}",
                     lowest.velocity, 100.0 * lost, lowest.restitution, lowest.diameter / units::um,
                     alone)};
       }},
      {"contradictory-constants",
       {"diameter", "stiffness_K", "adhesion_energy", "adhesion_force_f0", "least_K_ratio",
        "least_f0_ratio"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const DerivedContact derived =
             derive_recipe_contact(context.recipe.particle, context.recipe.surface);
         const double printed = limits.at("stiffness_K");
         const double f0 =
             recipe_adhesion_force(printed, limits.at("adhesion_energy"), limits.at("diameter"));
         const double K_ratio = derived.stiffness / printed;
         const double f0_ratio = limits.at("adhesion_force_f0") / f0;
         return {K_ratio >= limits.at("least_K_ratio") && f0_ratio >= limits.at("least_f0_ratio"),
                 fmt::format(
                     "E and nu give K {:.1f} GPa, {:.1f} times the printed; printed K and W give "
                     "f0 {:.1f} N/m, the printed is {:.2f} times that",
                     derived.stiffness / units::GPa, K_ratio, f0, f0_ratio)};
       }},
  };
  return kinds;
}

const FactKind* find_kind(const std::string& id) {
  for (const FactKind& kind : catalogue()) {
    if (kind.id == id) return &kind;
  }
  return nullptr;
}

}  // namespace

void require_known_fact(const FactSpec& fact) {
  const FactKind* kind = find_kind(fact.id);
  if (kind == nullptr) {
    std::vector<std::string> ids;
    for (const FactKind& known : catalogue()) ids.push_back(known.id);
    const std::string near = nearest_word(fact.id, ids);
    throw InputError(fact.where, fmt::format("unknown fact '{}'", fact.id), "",
                     near.empty() ? fmt::format("known: {}", fmt::join(ids, ", "))
                                  : fmt::format("did you mean '{}'?", near));
  }
  for (const std::string& limit : kind->limits) {
    if (!fact.limits.contains(limit)) {
      throw InputError(fact.where,
                       fmt::format("the fact '{}' lacks the limit '{}'", fact.id, limit),
                       "a check without a threshold cannot fail",
                       fmt::format("give {}", fmt::join(kind->limits, ", ")));
    }
  }
  for (const auto& [name, value] : fact.limits) {
    if (std::find(kind->limits.begin(), kind->limits.end(), name) == kind->limits.end()) {
      throw InputError(fact.where, fmt::format("the fact '{}' takes no limit '{}'", fact.id, name),
                       "", fmt::format("it takes {}", fmt::join(kind->limits, ", ")));
    }
  }
}

std::vector<FactCheck> check_facts(const Recipe& recipe,
                                   const std::vector<GeneratedPoint>& points) {
  std::vector<Recipe> siblings;
  for (const std::string& id : recipe.siblings) {
    const std::filesystem::path folder =
        std::filesystem::absolute(recipe.folder).lexically_normal() / ".." / id;
    // A sibling whose points were replaced still has the truth with which this recipe compares.
    const bool aside = !std::filesystem::exists(folder / recipe_name) &&
                       std::filesystem::exists(folder / set_aside_recipe_name);
    siblings.push_back(load_recipe(folder, aside ? set_aside_recipe_name : recipe_name));
  }
  const FactContext context{recipe, points, siblings};
  std::vector<FactCheck> checks;
  for (const FactSpec& fact : recipe.facts) {
    FactCheck check{fact.id, fact.statement, fact.source, false, ""};
    try {
      const FactOutcome outcome = find_kind(fact.id)->evaluate(context, fact.limits);
      check.holds = outcome.holds;
      check.found = outcome.found;
    } catch (const ComputationError& error) {
      check.found = fmt::format("could not be evaluated: {}", error.what());
    }
    checks.push_back(std::move(check));
  }
  return checks;
}

}  // namespace recoil
