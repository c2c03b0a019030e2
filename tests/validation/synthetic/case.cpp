#include "validation/synthetic/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "validation/synthetic/effects.hpp"
#include "validation/synthetic/sphere.hpp"

namespace recoil::hidden {
namespace {

/// FNV-1a (Fowler, Noll & Vo): the same number for a text on every machine.
std::uint64_t number_of(std::string_view text, std::uint64_t start = 14695981039346656037ULL) {
  std::uint64_t hash = start;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211ULL;
  }
  return hash;
}

std::string joined(const std::vector<std::string>& effects) {
  std::string all;
  for (const std::string& effect : effects) all += "+" + effect;
  return all;
}

/// What the table says of a point: the mean of its events, that came at another velocity than the
/// printed one if that is uncertain.
double reading_of(const Case& made, const Point& p, RandomStream& random) {
  const double scatter = made.effects.velocity_scatter;
  const Effects effects = under(p.changed, made.effects);
  double set = p.velocity;
  if (effects.height_scatter > 0.0) {
    RandomStream own(made.order.experiment_seed(), hidden_purpose, 1000000 + p.setting);
    set *= std::sqrt(std::max(1.0 + effects.height_scatter * own.normal(), 0.5));
  }
  double reading = 0.0;
  for (int i = 0; i < 100 && !(reading > 0.0); ++i) {  // a point needs a rebound
    const double velocity = scatter > 0.0 ? set * (1.0 + scatter * random.normal()) : set;
    reading = observed_mean(made.design.base, effects, made.design.scatter, velocity, p.diameter,
                            p.row, made.design.events, random);
    if (scatter == 0.0) break;
  }
  return reading * (set / p.velocity);  // e as the quotient of the velocities that are read
}

/// A misreading of 6 to 15 standard deviations, or none.
double misreading(const Case& made, const Point& p, RandomStream& random) {
  const bool odd = random.uniform() < made.effects.odd_share;
  const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
  const double size = p.sd * (6.0 + 9.0 * random.uniform());
  return odd ? sign * size : 0.0;
}

/// Makes the impacts of `point`, each by itself, and fills in what came of them: it comes back,
/// stays, or comes back too slowly to be seen. False where all were too slow to be seen.
bool measure(const Base& base, const Effects& effects, const Scatter& scatter, Point& point,
             RandomStream& random) {
  int rebounds = 0;
  double sum = 0.0;
  const auto typical = shared_square(base, effects, point.velocity, point.diameter);
  for (int i = 0; i < point.events; ++i) {
    const Reading one =
        read_impact(base, effects, scatter, point.velocity, point.diameter, typical, random);
    point.captured += one.captured ? 1 : 0;
    rebounds += one.seen ? 1 : 0;
    sum += one.restitution;
  }
  point.events = rebounds + point.captured;
  point.restitution = rebounds > 0 ? sum / rebounds : 0.0;
  // What an experimenter knows of the scatter: that of the other points.
  point.sd = scatter.of(std::max(point.restitution, 0.1)) / std::sqrt(std::max(rebounds, 1));
  return point.events > 0;
}

/// What a table says of the point.
double reading_of(const Effects& effects, const Point& point) {
  const double e = point.restitution;
  return e > 0.0 && !effects.series_offset.empty() ? e + effects.series_offset[point.row] : e;
}

/// Until every row has one; each has an error of its own, if any has.
void add_batches(Effects& effects, std::size_t rows, RandomStream& random) {
  if (effects.series_offset.empty()) return;
  const double size = size_of_offsets(effects);
  while (effects.series_offset.size() < rows) {
    effects.series_offset.push_back(size * random.normal());
  }
}

}  // namespace

std::string CaseOrder::key() const {
  std::string bends = other_law ? ":other" : "";
  if (law_bend > 0.0) bends += fmt::format("~{:g}%", 100.0 * law_bend);
  if (base_bend > 0.0) bends += fmt::format("~base{:g}%", 100.0 * base_bend);
  if (beyond > 0.0) bends += fmt::format("*{:g}", beyond);
  if (circumstances != Circumstances::unstated) {
    bends += fmt::format("|{}", name_of(circumstances));
  }
  if (readout != Readout::exact) bends += fmt::format("/{}", name_of(readout));
  const std::string again = rounds > 0 ? fmt::format("^{}", rounds) : "";
  return fmt::format("{}{}{}@{:g}#{}{}", design, joined(effects), bends, signal_to_noise, index,
                     again);
}

std::uint64_t CaseOrder::experiment_seed() const {
  return number_of(fmt::format("{}{}#{}#{}", design, joined(effects), index, seed));
}

bool states_rounding(const CaseOrder& order) {
  return order.readout != Readout::exact && order.index % 4 >= 2;
}

std::string neutral_name(const CaseOrder& order) {
  return fmt::format("impacts-{:08x}",
                     number_of(order.key() + std::to_string(order.seed)) % 0x100000000ULL);
}

Case make_case(const CaseOrder& order) {
  Case made;
  made.order = order;
  // The first draw that has points even with nothing hidden.
  std::uint64_t seed = order.experiment_seed();
  made.design = draw_design(order.design, seed);
  for (int i = 0; i < 100 && expected_points(made.design, {}).empty(); ++i) {
    made.design = draw_design(order.design, ++seed);
  }
  made.design.readout = order.readout;
  made.design.states_rounding = states_rounding(order);
  made.reached = true;
  made.effects.other_laws = order.other_law;
  for (std::size_t k = 0; k < order.effects.size(); ++k) {
    const HiddenEffect& effect = find_hidden_effect(order.effects[k]);
    if (effect.kind == EffectKind::careless) {  // leaves nothing without noise: of one size
      effect.apply(made.effects, effect.largest, made.design);
      made.strengths.push_back(effect.largest);
      continue;
    }
    const Nuisances nuisances = draw_nuisances(effect, made.design, seed + k);
    const auto alone = [&](double strength) {
      Effects effects;
      effects.other_laws = order.other_law;
      add_effect(effects, effect, nuisances, made.design, strength);
      return effects;
    };
    if (order.beyond > 0.0) {
      const double strength = order.beyond * largest_strength(effect, nuisances);
      made.strengths.push_back(nuisances.sign * strength);
      add_effect(made.effects, effect, nuisances, made.design, strength);
      continue;
    }
    double largest = largest_strength(effect, nuisances);
    if (order.other_law) {
      for (const Row& row : made.design.rows) {
        largest = std::min(
            largest, largest_by_other_law(effect.id, sphere_of(made.design.base, row.diameter),
                                          row.highest));
      }
    }
    const Strength found = find_strength(made.design, alone, largest, order.signal_to_noise);
    made.reached = made.reached && found.reached;
    made.strengths.push_back(nuisances.sign * found.value);
    add_effect(made.effects, effect, nuisances, made.design, found.value);
  }
  made.effects.bend_of_laws = draw_bend(order.law_bend, seed, 0);
  made.effects.bend_of_base = draw_bend(order.base_bend, seed, 1);
  made.points = expected_points(made.design, made.effects);
  if (made.points.empty()) {
    made.reached = false;
    return made;
  }
  made.refit = refit_base(made.design, made.points);
  if (order.circumstances == Circumstances::stated) {
    for (const std::string& id : order.effects) {
      for (StatedCondition& c : conditions_behind(id, made.design.base, made.effects)) {
        made.conditions.push_back(std::move(c));
      }
    }
  } else if (order.circumstances == Circumstances::varied && !order.effects.empty()) {
    const StatedCondition change = change_against(order.effects.front());
    for (Point& again : expected_points(made.design, under(change, made.effects))) {
      again.changed = change;
      made.points.push_back(std::move(again));
    }
  }
  // Readings of different strengths have noise of their own.
  const std::uint64_t readings_seed = number_of(order.key(), seed);
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    RandomStream random(readings_seed, hidden_purpose, 100 + i);
    const Point& point = made.points[i];
    const double right =
        rounded(made.design.readout, point.velocity, reading_of(made, point, random));
    const double wrong = misreading(made, point, random);
    made.readings.push_back(wrong == 0.0 ? right : std::clamp(right + wrong, 0.02, 1.5));
    made.odd.push_back(std::abs(made.readings.back() - right) > 5.0 * point.sd);
  }
  return made;
}

void take_further(Case& made, const FurtherImpacts& further, std::uint64_t round) {
  RandomStream random(made.order.experiment_seed() + 7919 * (round + 1), hidden_purpose, 99);
  Design& design = made.design;
  const auto row = std::find_if(design.rows.begin(), design.rows.end(), [&](const Row& r) {
    return std::abs(r.diameter / further.diameter - 1.0) < 1e-6;
  });
  Point point;
  point.row = static_cast<std::size_t>(row - design.rows.begin());
  if (row == design.rows.end()) {
    Row added;
    added.name = fmt::format("{:.3g} um", 1e6 * further.diameter);
    added.diameter = further.diameter;
    design.rows.push_back(added);
    add_batches(made.effects, design.rows.size(), random);
  }
  point.diameter = further.diameter;
  point.velocity = further.velocity;
  point.events = further.events;
  point.changed = further.changed;
  point.setting = 900000 + static_cast<std::size_t>(round);
  const Effects effects = under(further.changed, made.effects);
  if (!measure(design.base, effects, design.scatter, point, random)) return;
  made.points.push_back(point);
  made.readings.push_back(reading_of(effects, point));
}

}  // namespace recoil::hidden
