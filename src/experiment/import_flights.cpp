#include "experiment/import_flights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "core/error.hpp"
#include "data/limits.hpp"
#include "data/text.hpp"
#include "experiment/import_diameters.hpp"
#include "experiment/import_table.hpp"

namespace recoil {
namespace {

constexpr double thinnest_air = 1e-3;     // [Pa]
constexpr double slowest_gravity = 1e-3;  // [m/s2]
constexpr double fastest_gravity = 1e3;

std::string fallback_series(const ImportRequest& request) {
  return request.series.empty() ? request.file.stem().string() : request.series;
}

void require_positive(const ImportTable& table, std::size_t row, const std::string& quantity,
                      double value) {
  if (value > 0.0) return;
  table.fail(row, quantity, fmt::format("{} = {:g}", quantity, value), "it has to be positive",
             "correct it or remove the row");
}

/// The flights of one launch, in order.
struct Flight {
  double duration = 0.0;  ///< [s]
  double bounce = 0.0;    ///< number of the bounce with which it begins
  std::size_t row = 0;
};

/// One bounce as its time is given.
struct Bounce {
  double time = 0.0;             ///< [s]
  std::optional<double> number;  ///< where bounces are counted
};

struct Launch {
  std::string name;
  std::optional<double> release;  ///< [m]
  std::optional<double> diameter;
  std::vector<Flight> flights;
};

std::vector<Launch> gather_launches(const ImportTable& table, const ImportRequest& request) {
  std::vector<Launch> launches;
  std::map<std::string, std::size_t> index;
  std::map<std::string, Bounce> last;  // of each launch, when times are given
  const bool times = table.has("time");
  for (std::size_t r = 0; r < table.size(); ++r) {
    std::string name = table.text(r, "launch");
    if (name.empty()) name = fallback_series(request);
    const auto [known, added] = index.try_emplace(name, launches.size());
    if (added) launches.push_back({name, {}, {}, {}});
    Launch& launch = launches[known->second];
    if (added) {
      launch.release = table.value(r, "release_height");
      launch.diameter = table.value(r, "diameter");
    }
    const std::string quantity = times ? "time" : "interval";
    double duration = table.needed(r, quantity);
    const std::optional<double> number = table.value(r, "bounce");
    if (times) {
      const auto [before, first] = last.try_emplace(name, Bounce{duration, number});
      if (first) continue;  // it begins the first flight
      const Bounce now{duration, number};
      duration -= before->second.time;
      const bool missed =
          number && before->second.number && *number != *before->second.number + 1.0;
      before->second = now;
      if (missed) continue;
    }
    require_positive(table, r, quantity, duration);
    const double bounce = number.value_or(static_cast<double>(launch.flights.size() + 1));
    launch.flights.push_back({duration, bounce, r});
  }
  for (Launch& launch : launches) {
    std::stable_sort(launch.flights.begin(), launch.flights.end(),
                     [](const Flight& a, const Flight& b) { return a.bounce < b.bounce; });
    const auto twice =
        std::adjacent_find(launch.flights.begin(), launch.flights.end(),
                           [](const Flight& a, const Flight& b) { return a.bounce == b.bounce; });
    if (twice != launch.flights.end()) {
      table.fail(std::next(twice)->row, "bounce",
                 fmt::format("bounce {:g} of launch '{}' appears here and on line {}",
                             twice->bounce, launch.name, table.line(twice->row)),
                 "the ratio of intervals of two launches is not a restitution",
                 "if several columns name a launch, join them: --map launch=COLUMN+COLUMN");
    }
  }
  return launches;
}

/// The spheres of one import in their air, and what it does to e.
class Reduction {
 public:
  Reduction(const ImportRequest& request, const SphereInAir& sphere, double gravity)
      : request_(request), sphere_(sphere), gravity_(gravity) {}

  /// The flights of a sphere of `series`; nothing in vacuum, and where size, density or air are
  /// unknown or impossible (the dataset is refused then).
  std::optional<AirFlight> flights_of(const std::string& series,
                                      const std::optional<double>& in_file) const {
    const std::optional<double> diameter = known_diameter(request_, series, in_file);
    const bool possible = diameter && limits::diameter.contains(*diameter) &&
                          limits::density.contains(sphere_.density) && air_acts(sphere_.air) &&
                          limits::pressure.contains(sphere_.air.pressure) &&
                          limits::temperature.contains(sphere_.air.temperature);
    if (!possible) return std::nullopt;
    return AirFlight(sphere_.air, *diameter, sphere_.density, gravity_);
  }

  /// Keeps what the air did to one point. @param plain e as it would be in vacuum
  void add(const ImportTable& table, std::size_t row, const std::string& quantity,
           const AirFlight& flights, const ImportedPoint& point, double plain) {
    const double e = *point.restitution;
    if (!(e <= limits::restitution.upper) && plain <= limits::restitution.upper) {
      table.fail(
          row, quantity,
          fmt::format("restitution = {:.3g} when the drag of air at {:g} Pa is taken out", e,
                      sphere_.air.pressure),
          "a sphere of this size and density could not have flown so far",
          "check the units in --map, --diameter and the density, or write --ambient-pressure 0 "
          "for vacuum");
    }
    const double share = e > 0.0 ? 1.0 - plain / e : 0.0;
    if (!any_ || point.velocity < share_.slow) {
      share_.slow = point.velocity;
      share_.slow_share = share;
    }
    if (!any_ || point.velocity > share_.fast) {
      share_.fast = point.velocity;
      share_.fast_share = share;
    }
    share_.reynolds = std::max(share_.reynolds, flights.reynolds(point.velocity));
    any_ = true;
  }

  void note(std::vector<ImportNote>& notes) const {
    if (!any_) return;
    ImportNote note{ImportRemark::air_drag};
    note.air = share_;
    note.air.pressure = sphere_.air.pressure;
    note.air.temperature = sphere_.air.temperature;
    notes.push_back(note);
    if (share_.reynolds <= drag_law_reynolds) return;
    note.remark = ImportRemark::turbulent_air;
    notes.push_back(note);
  }

 private:
  const ImportRequest& request_;
  SphereInAir sphere_;
  double gravity_;
  bool any_ = false;
  AirShare share_;
};

/// What the first two flights say of the height from which the ball was released, were its first
/// bounce like its second.
std::vector<ReleaseCheck> release_check(const std::vector<Launch>& launches, double gravity,
                                        const Reduction& reduction) {
  struct Sum {
    double first = 0.0;    // e of the first bounce, with the stated height
    double second = 0.0;   // e of the second
    double missing = 0.0;  // of the height [m]
    double count = 0.0;
  };
  std::map<double, Sum> by_height;
  for (const Launch& launch : launches) {
    if (!launch.release || launch.flights.size() < 2 || !(*launch.release > 0.0)) continue;
    if (launch.flights[1].bounce != launch.flights[0].bounce + 1.0) continue;
    const double height = *launch.release;
    double first = 0.5 * gravity * launch.flights[0].duration / std::sqrt(2.0 * gravity * height);
    double second = launch.flights[1].duration / launch.flights[0].duration;
    double missing = (first * first / (second * second) - 1.0) * height;
    if (const auto air = reduction.flights_of(launch.name, launch.diameter)) {
      const double up = air->launch_for_duration(launch.flights[0].duration);
      first = up / air->fall(height).speed;
      second = air->launch_for_duration(launch.flights[1].duration) / air->return_speed(up);
      missing = air->fall_to_reach(up / second) - height;
      if (!std::isfinite(missing)) continue;
    }
    Sum& sum = by_height[height];
    sum.first += first;
    sum.second += second;
    sum.missing += missing;
    sum.count += 1.0;
  }
  std::vector<ReleaseCheck> checks;
  for (const auto& [height, sum] : by_height) {
    checks.push_back(
        {height, sum.first / sum.count, sum.second / sum.count, sum.missing / sum.count});
  }
  return checks;
}

/// --gravity [m/s2].
double gravity_of(const ImportRequest& request) {
  const auto value = parse_number(request.gravity);
  if (value && *value >= slowest_gravity && *value <= fastest_gravity) return *value;
  throw InputError(
      {}, fmt::format("--gravity {} is not an acceleration in m/s2", quote(request.gravity)), "",
      "write 9.80665 for standard gravity");
}

}  // namespace

bool air_acts(const Air& air) { return air.pressure >= thinnest_air; }

ImportedPoints read_heights(const ImportRequest& request, const SphereInAir& sphere) {
  const ImportTable table(request.file, request.map,
                          {{"series", Dimension::text},
                           {"diameter", Dimension::length},
                           {"drop_height", Dimension::length, true},
                           {"rebound_height", Dimension::length, true},
                           {"drop_height_sd", Dimension::length},
                           {"rebound_height_sd", Dimension::length}});
  const StatedError drop = stated_error(request.drop_error, Dimension::length, "--drop-error");
  const StatedError rebound =
      stated_error(request.rebound_error, Dimension::length, "--rebound-error");
  const double g = gravity_of(request);
  Reduction reduction(request, sphere, g);
  ImportedPoints out;
  struct Group {
    ImportedPoint point;
    double drop = 0.0;
    double drop_sd = 0.0;
    double rebound_sd = 0.0;
    std::vector<double> e;      // of those that came back
    std::vector<double> plain;  // e as it would be in vacuum
    double captured = 0.0;
  };
  std::vector<Group> groups;
  for (std::size_t r = 0; r < table.size(); ++r) {
    const double h1 = table.needed(r, "drop_height");
    const double h2 = table.needed(r, "rebound_height");
    require_positive(table, r, "drop_height", h1);
    if (h2 < 0.0) require_positive(table, r, "rebound_height", h2);
    Group group;
    group.point.series = table.text(r, "series");
    if (group.point.series.empty()) group.point.series = fallback_series(request);
    group.point.diameter = table.value(r, "diameter");
    group.point.line = table.line(r);
    group.drop = h1;
    group.drop_sd = table.value(r, "drop_height_sd").value_or(drop.of(h1));
    group.rebound_sd = table.value(r, "rebound_height_sd").value_or(rebound.of(h2));
    const double plain = std::sqrt(h2 / h1);
    group.point.velocity = std::sqrt(2.0 * g * h1);
    const auto air = reduction.flights_of(group.point.series, group.point.diameter);
    if (air) group.point.velocity = air->fall(h1).speed;
    const double e = air ? air->launch_for_height(h2) / group.point.velocity : plain;
    if (h2 > 0.0 && e >= request.captured_below) {
      group.plain = {plain};
      group.e = {e};
      group.point.restitution = e;
      if (air) reduction.add(table, r, "rebound_height", *air, group.point, plain);
    } else {
      group.captured = 1.0;
    }
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& other) {
      return other.drop == h1 && other.point.series == group.point.series &&
             other.point.diameter == group.point.diameter;
    });
    if (request.average && same != groups.end()) {
      if (same->e.empty()) same->rebound_sd = group.rebound_sd;
      same->e.insert(same->e.end(), group.e.begin(), group.e.end());
      same->plain.insert(same->plain.end(), group.plain.begin(), group.plain.end());
      same->captured += group.captured;
    } else {
      groups.push_back(std::move(group));
    }
  }
  // Where the table has captures, those that came back are no gaps either.
  const bool counted = std::any_of(groups.begin(), groups.end(),
                                   [](const Group& group) { return group.captured > 0.0; });
  bool few = false;
  for (Group& group : groups) {
    const double n = static_cast<double>(group.e.size());
    double mean = 0.0;
    for (const double e : group.e) mean += e / n;
    double plain = 0.0;
    for (const double e : group.plain) plain += e / n;
    double square = 0.0;
    for (const double e : group.e) square += (e - mean) * (e - mean);
    // The error of the rebound: as stated, or what the repetitions show, whichever is larger.
    double own = 0.0;
    if (mean > 0.0) {
      own = group.rebound_sd / (2.0 * group.drop * plain) * (mean / plain) / std::sqrt(n);
    }
    if (group.e.size() > 1) own = std::max(own, std::sqrt(square / (n - 1.0) / n));
    few = few || (group.e.size() > 1 && group.e.size() < 5);
    const double shared = 0.5 * mean * group.drop_sd / group.drop;
    const double sd = std::hypot(own, shared);
    group.point.restitution = n > 0.0 ? std::optional(mean) : std::nullopt;
    if (sd > 0.0) group.point.restitution_sd = sd;
    if (group.drop_sd > 0.0) {
      group.point.velocity_sd = 0.5 * group.point.velocity * group.drop_sd / group.drop;
    }
    if (request.average || counted) group.point.events = n + group.captured;
    if (counted) group.point.captured = group.captured;
    // Drops from one height share the error with which it was set.
    const auto of_the_height = std::count_if(groups.begin(), groups.end(), [&](const Group& other) {
      return other.drop == group.drop && other.point.series == group.point.series;
    });
    if (of_the_height > 1) {
      group.point.setting =
          fmt::format("{} from {:.6g} mm", group.point.series, group.drop / units::mm);
    }
    out.points.push_back(group.point);
  }
  if (few) out.notes.push_back({ImportRemark::few_drops});
  if (!drop.stated() && !table.has("drop_height_sd")) {
    out.notes.push_back({ImportRemark::no_drop_error});
  }
  out.notes.push_back(
      {air_acts(sphere.air) ? ImportRemark::same_point : ImportRemark::without_air});
  reduction.note(out.notes);
  return out;
}

ImportedPoints read_intervals(const ImportRequest& request, const SphereInAir& sphere) {
  const ImportTable table(request.file, request.map,
                          {{"launch", Dimension::text},
                           {"bounce", Dimension::count},
                           {"interval", Dimension::time},
                           {"time", Dimension::time},
                           {"release_height", Dimension::length},
                           {"diameter", Dimension::length}});
  if (table.has("interval") == table.has("time")) {
    throw InputError(
        {request.file.string(), 1, 1},
        table.has("time") ? "both intervals and times are there"
                          : "which column has the intervals?",
        "", "name one with --map interval=COLUMN:s, or time=COLUMN:s for times of bounces");
  }
  const bool times = table.has("time");
  const StatedError time = stated_error(request.time_error, Dimension::time, "--time-error");
  const double g = gravity_of(request);
  const std::vector<Launch> launches = gather_launches(table, request);
  Reduction reduction(request, sphere, g);
  ImportedPoints out;
  std::size_t gaps = 0;
  for (const Launch& launch : launches) {
    const auto air = reduction.flights_of(launch.name, launch.diameter);
    for (std::size_t i = 0; i + 1 < launch.flights.size(); ++i) {
      const Flight& in = launch.flights[i];
      const Flight& back = launch.flights[i + 1];
      if (back.bounce != in.bounce + 1.0) {
        ++gaps;
        continue;
      }
      ImportedPoint point;
      point.series = launch.name;
      point.diameter = launch.diameter;
      point.line = table.line(back.row);
      point.velocity = 0.5 * g * in.duration;
      const double e = back.duration / in.duration;
      point.restitution = e;
      if (time.stated()) {
        const double tau = time.of(in.duration);
        point.restitution_sd = tau / in.duration * std::sqrt(2.0 * (1.0 + e + e * e));
        point.velocity_sd = g * tau / std::sqrt(2.0);
      }
      if (air) {
        const double plain_velocity = point.velocity;
        point.velocity = air->return_speed(air->launch_for_duration(in.duration));
        point.restitution = air->launch_for_duration(back.duration) / point.velocity;
        reduction.add(table, back.row, times ? "time" : "interval", *air, point, e);
        if (time.stated()) {
          *point.restitution_sd *= *point.restitution / e;
          *point.velocity_sd *= point.velocity / plain_velocity;
        }
      }
      out.points.push_back(point);
    }
  }
  if (out.points.empty()) {
    throw InputError({request.file.string(), 1, 1}, "no launch has two successive intervals",
                     "e is the ratio of successive intervals",
                     "state with --map launch=COLUMN which rows belong together");
  }
  if (gaps > 0) out.notes.push_back({ImportRemark::bounces_missing, {}, gaps});
  const std::vector<ReleaseCheck> releases = release_check(launches, g, reduction);
  if (!releases.empty()) out.notes.push_back({ImportRemark::release_heights, {}, 0, releases});
  reduction.note(out.notes);
  out.notes.push_back({ImportRemark::shared_bounces});
  return out;
}

}  // namespace recoil
