#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "core/quoting.hpp"
#include "core/statistics.hpp"
#include "experiment/import_formats.hpp"

namespace recoil {
namespace {

/// One drop, or all drops of one sphere from one height.
struct Drops {
  std::string series;
  std::optional<double> diameter;  ///< [m], as the file states it
  double velocity = 0.0;           ///< [m/s]
  double height = 0.0;             ///< [m]
  double height_sd = 0.0;          ///< [m]
  double rebound_sd = 0.0;         ///< of one rebound height [m]
  std::vector<double> e;           ///< of the rebounds
  std::vector<double> in_vacuum;   ///< e if air drag is neglected
  double captured = 0.0;           ///< number of captures
  int line = 0;
};

/// @param captured_below a restitution below this is a capture [1]
Drops read_drop(const ImportTable& table, std::size_t r, const StatedError& drop_error,
                const StatedError& rebound_error, double captured_below, Flights& flights) {
  Drops drop;
  drop.height = table.positive(r, "drop_height");
  const double rebound = table.needed(r, "rebound_height");
  if (rebound < 0.0) table.positive(r, "rebound_height");  // throws
  drop.series = table.name(r, "series");
  drop.diameter = table.value(r, "diameter");
  drop.line = table.line(r);
  drop.height_sd = table.value(r, "drop_height_sd").value_or(drop_error.of(drop.height));
  drop.rebound_sd = table.value(r, "rebound_height_sd").value_or(rebound_error.of(rebound));
  const double in_vacuum = std::sqrt(rebound / drop.height);
  const auto air = flights.in_air(drop.series, drop.diameter);
  drop.velocity = air ? flights.speed_after_fall(*air, drop.height)
                      : std::sqrt(2.0 * flights.gravity() * drop.height);
  const double e = air ? flights.launch_for_height(*air, rebound) / drop.velocity : in_vacuum;
  if (!(rebound > 0.0) || e < captured_below) {
    drop.captured = 1.0;
    return drop;
  }
  drop.e = {e};
  drop.in_vacuum = {in_vacuum};
  if (air) flights.note_drag(table, r, "rebound_height", *air, drop.velocity, e, in_vacuum);
  return drop;
}

/// Joins the drops of one sphere from one height, in the order of the file.
std::vector<Drops> joined(const std::vector<Drops>& drops) {
  std::vector<Drops> groups;
  std::map<std::tuple<std::string, double, std::optional<double>>, std::size_t> index;
  for (const Drops& drop : drops) {
    const auto [known, added] =
        index.try_emplace({drop.series, drop.height, drop.diameter}, groups.size());
    if (added) {
      groups.push_back(drop);
      continue;
    }
    Drops& group = groups[known->second];
    if (group.e.empty()) group.rebound_sd = drop.rebound_sd;
    group.e.insert(group.e.end(), drop.e.begin(), drop.e.end());
    group.in_vacuum.insert(group.in_vacuum.end(), drop.in_vacuum.begin(), drop.in_vacuum.end());
    group.captured += drop.captured;
  }
  return groups;
}

/// The mean of the drops. Its error has two parts: that of the rebound heights (as stated or from
/// the repetitions, whichever is larger), and that of the drop height, which the drops share.
/// @param shared other points have the same drop height: its error is then an error of V of the
///   setting, and no part of the error of e
ImportedPoint mean_of(const Drops& drops, bool shared) {
  ImportedPoint point =
      imported_point(drops.series, drops.line, drops.diameter, drops.velocity, std::nullopt);
  if (drops.height_sd > 0.0) {
    point.value[shared ? Quantity::setting_velocity_sd : Quantity::velocity_sd] =
        0.5 * drops.velocity * drops.height_sd / drops.height;
  }
  if (drops.e.empty()) return point;
  const double n = static_cast<double>(drops.e.size());
  const double e = mean(drops.e);
  const double in_vacuum = mean(drops.in_vacuum);
  const double stated = drops.rebound_sd / (2.0 * drops.height * in_vacuum) * (e / in_vacuum);
  const double own = std::max(stated, standard_deviation(drops.e)) / std::sqrt(n);
  const double of_height = shared ? 0.0 : 0.5 * e * drops.height_sd / drops.height;
  const double sd = std::hypot(own, of_height);
  point.value[Quantity::restitution] = e;
  if (sd > 0.0) point.value[Quantity::restitution_sd] = sd;
  return point;
}

/// The flight between two bounces.
struct Flight {
  double duration = 0.0;  ///< [s]
  double bounce = 0.0;    ///< number of the bounce at its beginning
  std::size_t row = 0;
};

/// The time of a bounce, and its number if the file counts them.
struct Bounce {
  double time = 0.0;  ///< [s]
  std::optional<double> number;
};

/// The flights of one ball after its release.
struct Launch {
  std::string series;
  std::string name;
  std::optional<double> release;  ///< height [m]
  std::optional<double> diameter;
  std::vector<Flight> flights = {};     ///< by number of the bounce
  double next = 1.0;                    ///< number of the next bounce, if the file has none
  std::optional<Bounce> last_bounce{};  ///< if the file has times
};

/// Sorts the flights by the number of their bounce. @throws InputError if a number appears twice
void sort_flights(const ImportTable& table, Launch& launch) {
  std::vector<Flight>& flights = launch.flights;
  std::ranges::stable_sort(flights, {}, &Flight::bounce);
  const auto twice = std::ranges::adjacent_find(flights, {}, &Flight::bounce);
  if (twice == flights.end()) return;
  table.fail(std::next(twice)->row, "bounce",
             fmt::format("bounce {:g} of launch '{}' appears here and on line {}", twice->bounce,
                         launch.name, table.line(twice->row)),
             "the ratio of intervals of two launches is not a restitution",
             "if several columns name a launch, join them: --map launch=COLUMN+COLUMN");
}

/// The column of the times of flights or bounces.
std::string time_column(const ImportTable& table) {
  return table.has("interval") ? "interval" : "time";
}

/// Refuses launches in columns: every column falls, and rows of successive flights do not.
void refuse_columns(const ImportTable& table, const std::string& column) {
  if (table.has("launch") || !table.has_replicates()) return;
  std::map<int, std::vector<std::optional<double>>> rows;  // by line
  for (std::size_t r = 0; r < table.size(); ++r) {
    rows[table.line(r)].push_back(table.value(r, column));
  }
  std::size_t across = 0, rises_across = 0, down = 0, rises_down = 0;
  const std::vector<std::optional<double>>* above = nullptr;
  for (const auto& [line, row] : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k > 0 && row[k] && row[k - 1]) {
        ++across;
        rises_across += *row[k] >= *row[k - 1] ? 1 : 0;
      }
      if (above && k < above->size() && row[k] && (*above)[k]) {
        ++down;
        rises_down += *row[k] >= *(*above)[k] ? 1 : 0;
      }
    }
    above = &row;
  }
  // Flights of a launch fall at every step; the first flights of launches are in any order.
  if (4 * rises_across < across || 10 * rises_down > down || down < 2) return;
  table.fail(
      0, column,
      fmt::format("{} of {} steps along the rows rise, {} of {} down the columns", rises_across,
                  across, rises_down, down),
      "successive flights fall: the launches seem to be in columns",
      fmt::format("add --transpose and write --map {}", shell_word(table.exchanged_map(column))));
}

std::vector<Launch> read_launches(const ImportTable& table) {
  const std::string column = time_column(table);
  std::vector<Launch> launches;
  std::map<std::pair<std::string, std::string>, std::size_t> index;
  for (std::size_t r = 0; r < table.size(); ++r) {
    const std::string series = table.name(r, "series");
    std::string name = table.text(r, "launch");
    if (name.empty()) {
      const bool of_rows = !table.has("launch") && table.has_replicates();
      name = of_rows ? fmt::format("line {}", table.line(r)) : series;
    }
    const auto [known, added] = index.try_emplace({series, name}, launches.size());
    if (added) {
      launches.push_back(
          {series, name, table.value(r, "release_height"), table.value(r, "diameter")});
    }
    Launch& launch = launches[known->second];
    const std::optional<double> number = table.value(r, "bounce");
    if (table.lacks(r, column)) {
      launch.last_bounce.reset();  // a bounce that was not recorded
      ++launch.next;
      continue;
    }
    double duration = 0.0;
    if (column == "interval") {
      duration = table.positive(r, column);
    } else {
      const Bounce now{table.needed(r, column), number};
      const std::optional<Bounce> previous = std::exchange(launch.last_bounce, now);
      if (!previous) continue;  // it begins a flight
      if (number && previous->number && *number != *previous->number + 1.0) {
        launch.next += *number - *previous->number;
        continue;  // bounces between them were missed
      }
      duration = now.time - previous->time;
      if (!(duration > 0.0)) {
        table.fail(
            r, column, fmt::format("a flight of {:g} s", duration),
            "the times of one launch have to ascend",
            "state with --map launch=COLUMN which rows belong together, or correct the time");
      }
    }
    const double before = column == "time" ? 1.0 : 0.0;  // a time is that of the end of a flight
    launch.flights.push_back({duration, number ? *number - before : launch.next, r});
    ++launch.next;
  }
  for (Launch& launch : launches) sort_flights(table, launch);
  return launches;
}

/// The bounce after the release, computed from the first two flights.
struct FirstBounce {
  ReleaseCheck check;     ///< of the release height
  double velocity = 0.0;  ///< at the end of the fall [m/s]
  int missed = 0;         ///< bounces before the first flight that the file does not list
};

/// nullopt without a release height, or without two successive flights from the first bounce on.
/// After k bounces a flight begins with e^k sqrt(2 g h), so that k = ln(first) / ln(second) with
/// the two e of `ReleaseCheck`. If k is near a whole number from 2 on, k - 1 bounces are not
/// listed.
std::optional<FirstBounce> first_bounce(const Launch& launch, const Flights& flights) {
  const double g = flights.gravity();
  if (!launch.release || launch.flights.size() < 2 || !(*launch.release > 0.0)) return std::nullopt;
  if (launch.flights[0].bounce != 1.0 || launch.flights[1].bounce != 2.0) return std::nullopt;
  const double height = *launch.release;
  const double t0 = launch.flights[0].duration;
  const double t1 = launch.flights[1].duration;
  FirstBounce bounce;
  bounce.velocity = std::sqrt(2.0 * g * height);
  ReleaseCheck& check = bounce.check;
  check = {height, 0.5 * g * t0 / bounce.velocity, t1 / t0, 0.0};
  check.missing = (check.first * check.first / (check.second * check.second) - 1.0) * height;
  if (const auto air = flights.in_air(launch.series, launch.diameter)) {
    const double up = air->launch_for_duration(t0);
    bounce.velocity = air->fall(height).speed;
    check.first = up / bounce.velocity;
    check.second = air->launch_for_duration(t1) / air->return_speed(up);
    check.missing = air->fall_to_reach(up / check.second) - height;
    if (!std::isfinite(check.missing)) return std::nullopt;
  }
  constexpr double whole = 0.15;  // widest distance of k from a whole number
  const double k = std::log(check.first) / std::log(check.second);
  if (check.second < 1.0 && k > 2.0 - whole && std::abs(k - std::round(k)) < whole) {
    bounce.missed = static_cast<int>(std::round(k)) - 1;
  }
  return bounce;
}

/// The checks of the release heights, averaged over the launches from each.
std::vector<ReleaseCheck> mean_checks(
    const std::map<double, std::vector<ReleaseCheck>>& by_height) {
  std::vector<ReleaseCheck> means;
  for (const auto& [height, checks] : by_height) {
    ReleaseCheck sum{height};
    for (const ReleaseCheck& check : checks) {
      sum.first += check.first;
      sum.second += check.second;
      sum.missing += check.missing;
    }
    const auto count = static_cast<double>(checks.size());
    means.push_back({height, sum.first / count, sum.second / count, sum.missing / count});
  }
  return means;
}

/// The point of the bounce after the release, with V at the end of the fall.
ImportedPoint point_after_release(const Launch& launch, const FirstBounce& bounce,
                                  const ImportTable& table, const StatedError& time,
                                  const StatedError& drop) {
  ImportedPoint point = imported_point(launch.series, table.line(launch.flights.front().row),
                                       launch.diameter, bounce.velocity, bounce.check.first);
  point.launch = launch.name;
  const double of_height = 0.5 * drop.of(bounce.check.height) / bounce.check.height;
  const double duration = launch.flights.front().duration;
  const double of_time = std::sqrt(2.0) * time.of(duration) / duration;
  if (of_height > 0.0) {
    point.value[Quantity::velocity_sd] = of_height * bounce.velocity;
    point.value[Quantity::restitution_sd] = bounce.check.first * std::hypot(of_height, of_time);
  }
  return point;
}

/// The places where an interval may be missing: there e is near the square of the median e of the
/// launch, and every other e is near the median or its square.
std::vector<std::string> suspected_gaps(const Launch& launch,
                                        const std::vector<ImportedPoint>& points) {
  std::vector<double> logs;
  for (const ImportedPoint& point : points) {
    logs.push_back(std::log(*point.value[Quantity::restitution]));
  }
  if (logs.size() < 3) return {};
  std::vector<double> sorted = logs;
  std::ranges::sort(sorted);
  const double middle = sorted[sorted.size() / 2];
  if (!(middle < 0.0)) return {};
  std::vector<std::string> places;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const double times = logs[i] / middle;
    constexpr double near = 0.25;
    if (std::abs(times - 1.0) < near) continue;
    if (std::abs(times - 2.0) > near) return {};
    places.push_back(fmt::format("line {} of launch {}", points[i].line, launch.name));
  }
  return places;
}

/// The point of the bounce between two successive flights.
ImportedPoint bounce_between(const Flight& in, const Flight& back, const Launch& launch,
                             const ImportTable& table, const StatedError& time, Flights& flights) {
  const std::string column = time_column(table);
  const double g = flights.gravity();
  const double e_vacuum = back.duration / in.duration;
  if (e_vacuum > limits::restitution.upper) {
    table.fail(back.row, column,
               fmt::format("restitution = {:.3g}: a flight of {:g} s after one of {:g} s", e_vacuum,
                           back.duration, in.duration),
               "no flight is longer than the one before; a bounce between them is missing, or they "
               "are of two launches",
               column == "time"
                   ? "put a row with an empty time before this one: the launch is then split there"
                   : "leave the cell empty: the launch is then split there");
  }
  const double v_vacuum = 0.5 * g * in.duration;
  double e = e_vacuum;
  double v = v_vacuum;
  if (const auto air = flights.in_air(launch.series, launch.diameter)) {
    v = air->return_speed(air->launch_for_duration(in.duration));
    e = air->launch_for_duration(back.duration) / v;
    flights.note_drag(table, back.row, column, *air, v, e, e_vacuum);
  }
  ImportedPoint point = imported_point(launch.series, table.line(back.row), launch.diameter, v, e);
  point.launch = launch.name;
  if (time.stated()) {
    const double tau = time.of(in.duration);
    const double sd_vacuum =
        tau / in.duration * std::sqrt(2.0 * (1.0 + e_vacuum + e_vacuum * e_vacuum));
    point.value[Quantity::restitution_sd] = sd_vacuum * (e / e_vacuum);
    point.value[Quantity::velocity_sd] = g * tau / std::sqrt(2.0) * (v / v_vacuum);
  }
  return point;
}

}  // namespace

bool air_acts(const Air& air) { return air.pressure >= 1e-3; }

std::optional<AirFlight> Flights::in_air(const std::string& series,
                                         const std::optional<double>& diameter_in_file) const {
  const auto [known, is_new] = known_.try_emplace({series, diameter_in_file});
  if (!is_new) return known->second;
  const auto diameter = known_diameter(request_, series, diameter_in_file);
  const bool possible = diameter && limits::diameter.contains(*diameter) &&
                        limits::density.contains(sphere_.density) && air_acts(sphere_.air) &&
                        limits::pressure.contains(sphere_.air.pressure) &&
                        limits::temperature.contains(sphere_.air.temperature);
  if (possible) known->second.emplace(sphere_.air, *diameter, sphere_.density, gravity());
  return known->second;
}

double Flights::speed_after_fall(const AirFlight& air, double height) {
  const auto [known, is_new] = falls_.try_emplace({air, height});
  if (is_new) known->second = air.fall(height).speed;
  return known->second;
}

double Flights::launch_for_height(const AirFlight& air, double height) {
  const auto [known, is_new] = launches_.try_emplace({air, height});
  if (is_new) known->second = air.launch_for_height(height);
  return known->second;
}

void Flights::note_drag(const ImportTable& table, std::size_t row, const std::string& quantity,
                        const AirFlight& air, double velocity, double e, double in_vacuum) {
  constexpr double largest = limits::restitution.upper;
  if (!(e <= largest) && in_vacuum <= largest) {
    table.fail(row, quantity,
               fmt::format("restitution = {:.3g} when the drag of air at {:g} Pa is taken out", e,
                           sphere_.air.pressure),
               "a sphere of this size and density could not have risen so high",
               "check the units in --map, --diameter and the density, or write "
               "--ambient-pressure 0 for vacuum");
  }
  const double share = e > 0.0 ? 1.0 - in_vacuum / e : 0.0;
  if (!any_ || velocity < share_.slow) {
    share_.slow = velocity;
    share_.slow_share = share;
  }
  if (!any_ || velocity > share_.fast) {
    share_.fast = velocity;
    share_.fast_share = share;
  }
  share_.reynolds = std::max(share_.reynolds, air.reynolds(velocity));
  any_ = true;
}

void Flights::add_notes(std::vector<ImportNote>& notes) const {
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

ImportedPoints read_heights(const ImportRequest& request, const SphereInAir& sphere) {
  ImportTable table(request, {{"series", Dimension::text},
                              {"diameter", Dimension::length},
                              {"drop_height", Dimension::length, true},
                              {"rebound_height", Dimension::length, true},
                              {"drop_height_sd", Dimension::length},
                              {"rebound_height_sd", Dimension::length}});
  const StatedError drop = stated_error(request.drop_error, Dimension::length, "m", "--drop-error");
  const StatedError rebound =
      stated_error(request.rebound_error, Dimension::length, "m", "--rebound-error");
  Flights flights(request, sphere);
  std::vector<Drops> drops;
  bool stated = drop.stated();
  for (std::size_t r = 0; r < table.size(); ++r) {
    if (table.lacks(r, "drop_height") || table.lacks(r, "rebound_height")) {
      table.leave_out(r);
      continue;
    }
    drops.push_back(read_drop(table, r, drop, rebound, request.captured_below, flights));
    stated = stated || drops.back().height_sd > 0.0;
  }
  if (request.average) drops = joined(drops);
  // If any row is a capture, the rows without one state that none occurred.
  const bool counted = std::ranges::any_of(drops, [](const Drops& d) { return d.captured > 0.0; });
  std::map<std::pair<std::string, double>, int> groups_of_height;
  for (const Drops& d : drops) ++groups_of_height[{d.series, d.height}];
  ImportedPoints out;
  out.notes = table.notes();
  bool few = false;
  for (const Drops& d : drops) {
    const bool shared = groups_of_height[{d.series, d.height}] > 1;
    ImportedPoint point = mean_of(d, shared);
    few = few || (d.e.size() > 1 && d.e.size() < 5);
    if (request.average || counted) {
      point.value[Quantity::events] = static_cast<double>(d.e.size()) + d.captured;
    }
    if (counted) point.value[Quantity::captured] = d.captured;
    // Drops from one height share its error.
    if (shared) point.setting = fmt::format("{} from {:.6g} mm", d.series, d.height / units::mm);
    out.points.push_back(point);
  }
  if (few) out.notes.push_back({ImportRemark::few_drops});
  if (!stated) out.notes.push_back({ImportRemark::no_drop_error});
  out.notes.push_back(
      {air_acts(sphere.air) ? ImportRemark::same_point : ImportRemark::without_air});
  flights.add_notes(out.notes);
  return out;
}

ImportedPoints read_intervals(const ImportRequest& request, const SphereInAir& sphere) {
  const ImportTable table(request, {{"series", Dimension::text},
                                    {"launch", Dimension::text},
                                    {"bounce", Dimension::count},
                                    {"interval", Dimension::time},
                                    {"time", Dimension::time},
                                    {"release_height", Dimension::length},
                                    {"diameter", Dimension::length}});
  table.require_one_of(
      "interval", "time",
      "name one with --map interval=COLUMN:s, or time=COLUMN:s for times of bounces");
  const StatedError time = stated_error(request.time_error, Dimension::time, "s", "--time-error");
  const StatedError drop = stated_error(request.drop_error, Dimension::length, "m", "--drop-error");
  Flights flights(request, sphere);
  if (table.has("interval")) refuse_columns(table, "interval");
  const std::vector<Launch> launches = read_launches(table);
  ImportedPoints out;
  out.notes = table.notes();
  std::size_t gaps = 0;
  ImportNote missed{ImportRemark::first_bounces_missed};
  ImportNote suspected{ImportRemark::bounces_suspected};
  ImportNote impossible{ImportRemark::impossible_left_out};
  const bool launches_known = table.has("launch") || table.has_replicates();
  std::map<double, std::vector<ReleaseCheck>> by_height;
  bool unused = false;
  for (const Launch& launch : launches) {
    const auto first = first_bounce(launch, flights);
    if (first && first->missed > 0) {
      missed.names.push_back(fmt::format("{} ({})", launch.name, first->missed));
    } else if (first) {
      by_height[first->check.height].push_back(first->check);
      // Without an error of the height this point would be exact beside points with errors.
      const bool usable = drop.stated() || !time.stated();
      unused = unused || !usable;
      if (usable && first->check.first <= limits::restitution.upper) {
        out.points.push_back(point_after_release(launch, *first, table, time, drop));
      }
    }
    std::vector<ImportedPoint> own;
    for (std::size_t i = 0; i + 1 < launch.flights.size(); ++i) {
      const Flight& in = launch.flights[i];
      const Flight& back = launch.flights[i + 1];
      const double ratio = back.duration / in.duration;
      if (launches_known && back.bounce == in.bounce + 1.0 && ratio > limits::restitution.upper) {
        // The longer flight holds a missed bounce, so that the next ratio is wrong, too.
        impossible.names.push_back(
            fmt::format("line {} (e = {:.3g})", table.line(back.row), ratio));
        ++i;
      } else if (back.bounce == in.bounce + 1.0) {
        own.push_back(bounce_between(in, back, launch, table, time, flights));
      } else {
        ++gaps;
      }
    }
    const std::vector<std::string> places = suspected_gaps(launch, own);
    suspected.names.insert(suspected.names.end(), places.begin(), places.end());
    out.points.insert(out.points.end(), own.begin(), own.end());
  }
  if (out.points.empty()) {
    throw InputError({request.file.string(), 1, 1}, "no launch has two successive intervals",
                     "e is the ratio of successive intervals",
                     "state with --map launch=COLUMN which rows belong together");
  }
  if (gaps > 0) out.notes.push_back({ImportRemark::bounces_missing, {}, gaps});
  if (!missed.names.empty()) out.notes.push_back(missed);
  if (!suspected.names.empty()) out.notes.push_back(suspected);
  if (!impossible.names.empty()) out.notes.push_back(impossible);
  if (!by_height.empty()) {
    out.notes.push_back({ImportRemark::release_heights, {}, 0, mean_checks(by_height)});
  }
  if (unused) out.notes.push_back({ImportRemark::first_bounces_not_used});
  flights.add_notes(out.notes);
  if (!time.stated()) out.notes.push_back({ImportRemark::shared_bounces});
  return out;
}

}  // namespace recoil
