#include "experiment/import_flights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "core/error.hpp"
#include "data/text.hpp"
#include "experiment/import_table.hpp"

namespace recoil {
namespace {

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
                 fmt::format("bounce {:g} of launch '{}' stands here and on line {}", twice->bounce,
                             launch.name, table.line(twice->row)),
                 "the ratio of two launches' intervals is no restitution",
                 "if several columns name a launch, join them: --map launch=COLUMN+COLUMN");
    }
  }
  return launches;
}

/// What the first two flights say of the height from which the ball was released, were its first
/// bounce like its second.
std::vector<ReleaseCheck> release_check(const std::vector<Launch>& launches, double gravity) {
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
    const double fall = std::sqrt(2.0 * gravity * *launch.release);
    const double first = 0.5 * gravity * launch.flights[0].duration / fall;
    const double second = launch.flights[1].duration / launch.flights[0].duration;
    Sum& sum = by_height[*launch.release];
    sum.first += first;
    sum.second += second;
    sum.missing += (first * first / (second * second) - 1.0) * *launch.release;
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
  throw InputError({},
                   fmt::format("--gravity {} is no acceleration in m/s2", quote(request.gravity)),
                   "", "write 9.80665 for standard gravity");
}

}  // namespace

ImportedPoints read_heights(const ImportRequest& request) {
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
  ImportedPoints out;
  struct Group {
    ImportedPoint point;
    double drop = 0.0;
    double drop_sd = 0.0;
    double rebound_sd = 0.0;
    std::vector<double> e;
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
    group.e = {std::sqrt(h2 / h1)};
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& other) {
      return other.drop == h1 && other.point.series == group.point.series &&
             other.point.diameter == group.point.diameter;
    });
    if (request.average && same != groups.end()) {
      same->e.push_back(group.e.front());
    } else {
      groups.push_back(std::move(group));
    }
  }
  bool few = false;
  for (Group& group : groups) {
    const double n = static_cast<double>(group.e.size());
    double mean = 0.0;
    for (const double e : group.e) mean += e / n;
    double square = 0.0;
    for (const double e : group.e) square += (e - mean) * (e - mean);
    // The error of the rebound: as stated, or what the repetitions show, whichever is larger.
    double own = 0.0;
    if (mean > 0.0) own = group.rebound_sd / (2.0 * group.drop * mean) / std::sqrt(n);
    if (group.e.size() > 1) own = std::max(own, std::sqrt(square / (n - 1.0) / n));
    few = few || (group.e.size() > 1 && group.e.size() < 5);
    const double shared = 0.5 * mean * group.drop_sd / group.drop;
    const double sd = std::hypot(own, shared);
    group.point.velocity = std::sqrt(2.0 * g * group.drop);
    group.point.restitution = mean;
    if (sd > 0.0) group.point.restitution_sd = sd;
    if (group.drop_sd > 0.0) {
      group.point.velocity_sd = 0.5 * group.point.velocity * group.drop_sd / group.drop;
    }
    if (request.average) group.point.events = n;
    out.points.push_back(group.point);
  }
  if (few) out.notes.push_back({ImportRemark::few_drops});
  if (!drop.stated() && !table.has("drop_height_sd")) {
    out.notes.push_back({ImportRemark::no_drop_error});
  }
  out.notes.push_back({ImportRemark::without_air});
  return out;
}

ImportedPoints read_intervals(const ImportRequest& request) {
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
  const StatedError time = stated_error(request.time_error, Dimension::time, "--time-error");
  const double g = gravity_of(request);
  const std::vector<Launch> launches = gather_launches(table, request);
  ImportedPoints out;
  std::size_t gaps = 0;
  for (const Launch& launch : launches) {
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
      out.points.push_back(point);
    }
  }
  if (out.points.empty()) {
    throw InputError({request.file.string(), 1, 1}, "no launch has two successive intervals",
                     "e is the ratio of successive intervals",
                     "say with --map launch=COLUMN which rows belong together");
  }
  if (gaps > 0) out.notes.push_back({ImportRemark::bounces_missing, {}, gaps});
  const std::vector<ReleaseCheck> releases = release_check(launches, g);
  if (!releases.empty()) out.notes.push_back({ImportRemark::release_heights, {}, 0, releases});
  out.notes.push_back({ImportRemark::shared_bounces});
  return out;
}

}  // namespace recoil
