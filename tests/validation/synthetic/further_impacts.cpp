#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "validation/synthetic/case.hpp"
#include "validation/synthetic/effects.hpp"

namespace recoil::hidden {
namespace {

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
