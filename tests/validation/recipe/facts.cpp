#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/error.hpp"
#include "core/numerics.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "validation/recipe/recipe.hpp"

namespace recoil {
namespace {

/// What a check looks at.
struct FactContext {
  const Recipe& recipe;
  const std::vector<GeneratedPoint>& points;
  const std::vector<Recipe>& siblings;
};

/// The thresholds of a fact, SI.
struct FactLimits {
  const std::map<std::string, double>& values;

  double at(const std::string& name) const { return values.at(name); }
  /// Between the limits "from" and "to", or those with a prefix: "lowest_from" and "lowest_to".
  bool hold(double value, const std::string& prefix = "") const {
    return value >= at(prefix + "from") && value <= at(prefix + "to");
  }
};

struct FactOutcome {
  bool holds = false;
  std::string found;
};

/// A check of the catalogue: which limits it takes (all of them) and how it decides.
struct FactKind {
  std::string id;
  std::vector<std::string> limits;
  FactOutcome (*evaluate)(const FactContext&, const FactLimits&);
};

bool near(double value, double printed, double allowed) {
  return std::abs(value / printed - 1.0) <= allowed;
}

struct Extremes {
  double least = 0.0;
  double most = 0.0;
};

/// Of the values that `value` takes of `items`. @pre not empty
template <class Items, class Value>
Extremes extremes(const Items& items, const Value& value) {
  const double first = value(items.front());
  Extremes found{first, first};
  for (const auto& item : items) {
    const double one = value(item);
    found.least = std::min(found.least, one);
    found.most = std::max(found.most, one);
  }
  return found;
}

double velocity_of(const GeneratedPoint& point) { return point.velocity; }

/// The points of the size `diameter` [m].
std::vector<GeneratedPoint> points_of(const FactContext& context, double diameter) {
  std::vector<GeneratedPoint> chosen = context.points;
  std::erase_if(chosen, [&](const auto& point) { return !near(point.diameter, diameter, 1e-6); });
  return chosen;
}

// ---- the two-point calibration -----------------------------------------------------------------

constexpr double settled = 1e-6;  // relative change; points carry 1e-3 at best
constexpr int max_rounds = 50;

/// The damping `coefficient` of the model that gives the restitution of `point`.
/// @throws ComputationError when none >= 0 does
double damping_for(Truth model, double Truth::*coefficient, const GeneratedPoint& point) {
  const auto excess = [&](double value) {
    model.*coefficient = value;
    return true_restitution(model, point.diameter, point.velocity) - point.restitution;
  };
  double upper = 0.01;
  if (excess(0.0) >= 0.0) {
    while (upper <= 1000.0 && excess(upper) > 0.0) upper *= 2.0;
    if (upper <= 1000.0) return find_root(excess, 0.0, upper, 1e-9);
  }
  throw ComputationError(fmt::format(
      "no two-point calibration: no damping gives the restitution at {:g} m/s", point.velocity));
}

/// The paper's calibration of the ring-adhesion model by the lowest and the highest velocity of one
/// size, by the truth simulator: what facts of the kind "the ring-adhesion model runs slightly low
/// at 2.58 um" are checked with. C_H from the highest (C_A = 0 at first), C_A from the lowest, in
/// turn until both stand still (Li, Dunn & Brach 1999, section 4).
/// @throws ComputationError when there is no answer
Truth calibrated_by_two_points(const FactContext& context, double diameter) {
  const std::vector<GeneratedPoint> points = points_of(context, diameter);
  if (points.size() < 2) throw ComputationError("no two-point calibration: no such diameter");
  Truth model = undamped_truth(context.recipe.particle, context.recipe.surface, diameter);
  for (int round = 0; round < max_rounds; ++round) {
    model.C_H = damping_for(model, &Truth::C_H, points.back());
    const double before = model.C_A;
    model.C_A = damping_for(model, &Truth::C_A, points.front());
    if (std::abs(model.C_A - before) <= settled * model.C_A) return model;
  }
  throw ComputationError("no two-point calibration: the iteration did not settle");
}

/// Calibrated curve minus points of the size `diameter` from `away` V* on.
/// @throws ComputationError when there is none
std::vector<double> differences(const FactContext& context, const Truth& calibrated,
                                double diameter, double away) {
  const double start = away * true_capture_velocity(context.recipe.truth, diameter);
  std::vector<double> found;
  for (const GeneratedPoint& point : points_of(context, diameter)) {
    if (point.velocity < start) continue;
    found.push_back(true_restitution(calibrated, diameter, point.velocity) - point.restitution);
  }
  if (found.empty()) {
    throw ComputationError(fmt::format("no point of {:.2f} um", diameter / units::um));
  }
  return found;
}

// ---- targets -----------------------------------------------------------------------------------

/// Where e differs most over this recipe and its siblings, sphere by sphere.
struct Spread {
  double largest = 0.0;
  std::string words;
};

/// Between the velocities `from` (0: from where no target captures a size any more) and `to`.
Spread target_spread(const FactContext& context, double from, double to) {
  Spread spread;
  std::vector<Truth> targets = {context.recipe.truth};
  for (const Recipe& sibling : context.siblings) targets.push_back(sibling.truth);
  double velocity = 0.0;
  double diameter = 0.0;
  for (const RecipeSeries& series : context.recipe.series) {
    const auto capture = [&](const Truth& t) { return true_capture_velocity(t, series.diameter); };
    const double start = from > 0.0 ? from : extremes(targets, capture).most;
    for (const double V : log_spaced(1.01 * start, to, 24)) {
      const auto [low, high] = extremes(
          targets, [&](const Truth& t) { return true_restitution(t, series.diameter, V); });
      if (high - low <= spread.largest) continue;
      spread.largest = high - low;
      velocity = V;
      diameter = series.diameter;
    }
  }
  spread.words =
      fmt::format("largest difference over {} targets {:.3f}, at {:.3g} m/s and {:.2f} um",
                  targets.size(), spread.largest, velocity, diameter / units::um);
  return spread;
}

/// e averaged over the points at `velocity` and above, or below it. @pre there are some
double mean_restitution(const std::vector<GeneratedPoint>& points, double velocity, bool above) {
  std::vector<double> chosen;
  for (const GeneratedPoint& point : points) {
    if ((point.velocity >= velocity) == above) chosen.push_back(point.restitution);
  }
  return mean(chosen);
}

double restitution_of(const PlannedPoint& point) { return point.restitution; }

/// What e loses from its highest to the lowest velocity, without noise.
double true_drop(const Recipe& recipe) {
  return extremes(recipe.plan, restitution_of).most - recipe.plan.front().restitution;
}

const std::vector<FactKind>& catalogue() {
  static const std::vector<FactKind> kinds = {
      {"design-range",
       {"diameters", "smallest_diameter", "largest_diameter", "lowest_from", "lowest_to",
        "highest_from", "highest_to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         std::set<double> diameters;
         for (const GeneratedPoint& point : context.points) diameters.insert(point.diameter);
         const double smallest = *diameters.begin();
         const double largest = *diameters.rbegin();
         const auto [lowest, highest] = extremes(context.points, velocity_of);
         return {
             static_cast<double>(diameters.size()) == limits.at("diameters") &&
                 near(smallest, limits.at("smallest_diameter"), 1e-9) &&
                 near(largest, limits.at("largest_diameter"), 1e-9) &&
                 limits.hold(lowest, "lowest_") && limits.hold(highest, "highest_"),
             fmt::format("{} size(s), {:.2f} to {:.2f} um; {:.3g} to {:.3g} m/s", diameters.size(),
                         smallest / units::um, largest / units::um, lowest, highest)};
       }},
      {"no-capture",
       {},
       [](const FactContext& context, const FactLimits&) -> FactOutcome {
         const auto drawn = [](const GeneratedPoint& point) { return point.restitution; };
         const double lowest = std::min(extremes(context.recipe.plan, restitution_of).least,
                                        extremes(context.points, drawn).least);
         return {lowest > 0.0, fmt::format("lowest e {:.3f}", lowest)};
       }},
      // "Some" velocities: those of the series that begins nearest.
      {"near-capture",
       {"from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const auto [nearest, farthest] =
             extremes(context.recipe.series, [&](const RecipeSeries& series) {
               return series.velocities.front() /
                      true_capture_velocity(context.recipe.truth, series.diameter);
             });
         return {limits.hold(nearest),
                 fmt::format("lowest velocities are {:.2f} to {:.2f} V* (the nearest {:g} .. {:g})",
                             nearest, farthest, limits.at("from"), limits.at("to"))};
       }},
      {"capture-velocity",
       {"diameter", "from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double value = true_capture_velocity(context.recipe.truth, limits.at("diameter"));
         return {
             limits.hold(value),
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
         return {limits.hold(slope),
                 fmt::format("V* {:.2f} to {:.2f} m/s, d^({:.2f}) (allowed {:.2f} .. {:.2f})",
                             at_small, at_large, slope, limits.at("from"), limits.at("to"))};
       }},
      {"high-velocity-loss",
       {"from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const auto [least, most] =
             extremes(context.recipe.series, [&](const RecipeSeries& series) {
               const double e = points_of(context, series.diameter).back().restitution;
               return 1.0 - e * e;
             });
         return {
             limits.hold(least) && limits.hold(most),
             fmt::format("1 - e^2 is {:.3f} to {:.3f} at the highest velocity (allowed {:.2f} .. "
                         "{:.2f})",
                         least, most, limits.at("from"), limits.at("to"))};
       }},
      {"target-independence",
       {"velocity", "most"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const Spread spread = target_spread(context, limits.at("velocity"),
                                             context.recipe.series.back().velocities.back());
         return {!context.siblings.empty() && spread.largest <= limits.at("most"),
                 fmt::format("{} (at most {:.3f})", spread.words, limits.at("most"))};
       }},
      {"target-dependence",
       {"velocity", "least"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const Spread spread = target_spread(context, 0.0, limits.at("velocity"));
         return {spread.largest >= limits.at("least"),
                 fmt::format("{} (at least {:.2f})", spread.words, limits.at("least"))};
       }},
      {"size-dependence",
       {"velocity", "least"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const Truth& truth = context.recipe.truth;
         const double small = context.recipe.series.front().diameter;
         const double large = context.recipe.series.back().diameter;
         const double start = 1.01 * true_capture_velocity(truth, small);
         const auto [least, most] =
             extremes(log_spaced(start, limits.at("velocity"), 24), [&](double velocity) {
               return true_restitution(truth, large, velocity) -
                      true_restitution(truth, small, velocity);
             });
         return {
             most >= limits.at("least") && least > -0.01,
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
           std::vector<double> curve;
           for (const double velocity : log_spaced(series.velocities.front(), onset, 40)) {
             curve.push_back(true_restitution(context.recipe.truth, series.diameter, velocity));
           }
           steady = steady && curve.front() > 0.0 &&
                    std::is_sorted(curve.begin(), curve.end(), std::less_equal<>());
           least_fall = std::min(least_fall, curve.back() - curve.front());
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
         const Truth model = calibrated_by_two_points(context, limits.at("calibrated_on"));
         const std::vector<double> found = differences(context, model, limits.at("judged_on"), 0.0);
         return {limits.hold(mean(found), "mean_"),
                 fmt::format("mean difference {:+.3f} over {} points (allowed {:+.3f} .. {:+.3f}); "
                             "C_H {:.2e}, C_A {:.2e} s/m",
                             mean(found), found.size(), limits.at("mean_from"),
                             limits.at("mean_to"), model.C_H, model.C_A)};
       }},
      // Every size but the calibrated one and the one on which the curve runs low, each by itself.
      {"two-point-agrees",
       {"calibrated_on", "low_on", "away", "most"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const Truth model = calibrated_by_two_points(context, limits.at("calibrated_on"));
         double worst = 0.0;
         std::vector<std::string> sizes;
         for (const RecipeSeries& series : context.recipe.series) {
           if (near(series.diameter, limits.at("calibrated_on"), 1e-6) ||
               near(series.diameter, limits.at("low_on"), 1e-6)) {
             continue;
           }
           std::vector<double> squares =
               differences(context, model, series.diameter, limits.at("away"));
           for (double& difference : squares) difference *= difference;
           const double rms = std::sqrt(mean(squares));
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
         const double share = adhesion_share_of_loss(calibrated_by_two_points(context, diameter),
                                                     diameter, limits.at("velocity"));
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
         return {near(sizes.lower, limits.at("lower"), 1e-9) &&
                     near(sizes.upper, limits.at("upper"), 1e-9) &&
                     limits.hold(sizes.mean(), "mean_"),
                 fmt::format("d10 {:.1f} um, {:.0f} to {:.0f} um", sizes.mean() / units::um,
                             sizes.lower / units::um, sizes.upper / units::um)};
       }},
      {"velocity-range",
       {"lowest_from", "lowest_to", "highest_from", "highest_to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const auto [lowest, highest] = extremes(context.points, velocity_of);
         return {limits.hold(lowest, "lowest_") && limits.hold(highest, "highest_"),
                 fmt::format("{:.3g} to {:.3g} m/s", lowest, highest)};
       }},
      {"events-per-point",
       {"from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const auto [fewest, most] =
             extremes(context.points, [](const GeneratedPoint& point) { return point.events; });
         return {limits.hold(fewest) && limits.hold(most),
                 fmt::format("{} to {} rebounds per mean", fewest, most)};
       }},
      {"event-uncertainty",
       {"from", "to"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double relative = context.recipe.noise.relative;
         return {limits.hold(relative),
                 fmt::format("one event scatters by {:.0f} % of e", 100.0 * relative)};
       }},
      {"capture-range",
       {"large_diameter", "small_diameter", "large_capture", "small_capture", "tolerance"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const auto capture = [&](const char* diameter) {
           return true_capture_velocity(context.recipe.truth, limits.at(diameter));
         };
         const double large = capture("large_diameter");
         const double small = capture("small_diameter");
         return {
             near(large, limits.at("large_capture"), limits.at("tolerance")) &&
                 near(small, limits.at("small_capture"), limits.at("tolerance")),
             fmt::format("V* {:.3f} m/s at {:.0f} um and {:.2f} m/s at {:.0f} um (within {:.0f} %)",
                         large, limits.at("large_diameter") / units::um, small,
                         limits.at("small_diameter") / units::um, 100.0 * limits.at("tolerance"))};
       }},
      {"flat-above",
       {"velocity", "most_change"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double start = limits.at("velocity");
         const double level = mean_restitution(context.points, start, true);
         const double most =
             extremes(context.points, [&](const GeneratedPoint& point) {
               return point.velocity < start ? 0.0 : std::abs(point.restitution / level - 1.0);
             }).most;
         return {most <= limits.at("most_change"),
                 fmt::format("from {:g} m/s on e stays within {:.0f} % of its mean {:.3f} (allowed "
                             "{:.0f} %)",
                             start, 100.0 * most, level, 100.0 * limits.at("most_change"))};
       }},
      {"lower-below",
       {"velocity", "least_drop"},
       [](const FactContext& context, const FactLimits& limits) -> FactOutcome {
         const double start = limits.at("velocity");
         const auto count =
             std::count_if(context.points.begin(), context.points.end(),
                           [&](const auto& point) { return point.velocity < start; });
         if (count == 0) return {false, "no point below"};
         const double drop = mean_restitution(context.points, start, true) -
                             mean_restitution(context.points, start, false);
         return {
             drop >= limits.at("least_drop"),
             fmt::format("below {:g} m/s e is lower by {:.3f} on average over {} points (at least "
                         "{:.3f})",
                         start, drop, count, limits.at("least_drop"))};
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
         return {limits.hold(lost, "lost_"),
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
      const FactOutcome outcome = find_kind(fact.id)->evaluate(context, {fact.limits});
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
