#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "core/numerics.hpp"
#include "experiment/import_formats.hpp"

namespace recoil {
namespace {

constexpr double solver_tolerance = 1e-10;  // relative, of e
constexpr double most_bounces = 1000.0;     // in a block
constexpr double most_for_rest = 0.9995;    // e of a ball that comes to rest in air

/// Flights of one sphere, in air or in vacuum.
class Bouncing {
 public:
  Bouncing(std::optional<AirFlight> air, double gravity) : air_(air), g_(gravity) {}

  /// A fall from rest.
  AirFlight::Part fall(double height) const {
    if (air_) return air_->fall(height);
    const double speed = std::sqrt(2.0 * g_ * height);
    return {speed / g_, height, speed};
  }
  double launch_for_height(double height) const {
    return air_ ? air_->launch_for_height(height) : std::sqrt(2.0 * g_ * height);
  }

  /// The time from a launch with `first` until rest, if every impact has this e. From 1e-3 of the
  /// first speed on, the air is neglected.
  double time_to_rest(double first, double e) const {
    double time = 0.0;
    double speed = first;
    while (air_ && speed > 1e-3 * first) time += flight(speed, e);
    return time + 2.0 * speed / (g_ * (1.0 - e));
  }
  /// The time of `count` flights, and the speed of the launch after them instead of `speed`.
  double time_of(double count, double& speed, double e) const {
    double time = 0.0;
    for (double k = 0.0; k < count; ++k) time += flight(speed, e);
    return time;
  }

  const std::optional<AirFlight>& air() const { return air_; }

 private:
  /// The duration of a flight, and the speed after the impact at its end instead of `speed`.
  double flight(double& speed, double e) const {
    if (!air_) {
      const double time = 2.0 * speed / g_;
      speed *= e;
      return time;
    }
    const AirFlight::Part up = air_->rise(speed);
    const AirFlight::Part down = air_->fall(up.height);
    speed = e * down.speed;
    return up.time + down.time;
  }

  std::optional<AirFlight> air_;
  double g_;
};

/// The points of one import, and what air does to them.
class Sequences {
 public:
  /// @param measured the quantity at whose cell an impossible e is reported
  Sequences(const ImportRequest& request, const SphereInAir& sphere, const ImportTable& table,
            std::string measured)
      : request_(request),
        flights_(request, sphere),
        table_(table),
        measured_(std::move(measured)) {}

  Bouncing in_vacuum() const { return {std::nullopt, request_.gravity}; }
  /// In air, unless there is none or its effect cannot be computed.
  Bouncing bouncing(std::size_t row) const {
    return {flights_.in_air(table_.name(row, "series"), table_.value(row, "diameter")),
            request_.gravity};
  }

  /// @param in_vacuum e if the drag of air is neglected
  ImportedPoint& add(std::size_t row, const Bouncing& bouncing, double velocity, double e,
                     double in_vacuum) {
    if (!(in_vacuum > 0.0 && in_vacuum <= limits::restitution.upper)) fail(row, in_vacuum);
    const auto& air = bouncing.air();
    if (air) flights_.note_drag(table_, row, measured_, *air, velocity, e, in_vacuum);
    out_.points.push_back(imported_point(table_.name(row, "series"), table_.line(row),
                                         table_.value(row, "diameter"), velocity, e));
    return out_.points.back();
  }

  [[noreturn]] void fail(std::size_t row, double e) const {
    table_.fail(row, measured_, fmt::format("restitution = {:.3g}", e), "it is between 0 and 1",
                "check the units in --map, or leave the cell empty where a value was not recorded");
  }

  /// @param what one point needs
  ImportedPoints result(const std::string& what, const std::vector<ImportRemark>& remarks) {
    out_.notes = table_.notes();
    if (out_.points.empty()) {
      throw InputError({request_.file.string(), 1, 1}, "no point is left",
                       fmt::format("a point needs {}", what),
                       "state with --map launch=COLUMN which rows belong together");
    }
    for (const ImportRemark remark : remarks) out_.notes.push_back({remark});
    flights_.add_notes(out_.notes);
    return out_;
  }

 private:
  const ImportRequest& request_;
  Flights flights_;
  const ImportTable& table_;
  std::string measured_;
  ImportedPoints out_;
};

/// The e below `most` at which `excess`, which rises with e, vanishes; infinity if there is none.
/// @param in_vacuum e if the air is neglected, which is too low
template <class F>
double solved(const F& excess, double in_vacuum, double most, bool in_air) {
  if (!in_air) return in_vacuum;
  double high = in_vacuum;
  while (!(excess(high) > 0.0)) {
    if (high == most) return std::numeric_limits<double>::infinity();
    high = std::min(1.02 * high, most);
  }
  return find_root(excess, 0.9 * in_vacuum, high, solver_tolerance);
}

/// The rows of each launch in the order of the file. An empty cell splits a launch.
std::vector<std::vector<std::size_t>> launches_of(const ImportTable& table,
                                                  const std::string& quantity) {
  std::vector<std::vector<std::size_t>> launches;
  std::map<std::string, std::size_t> index;
  for (std::size_t r = 0; r < table.size(); ++r) {
    std::string name = table.text(r, "launch");
    if (!table.has("launch") && table.has_replicates()) name = std::to_string(table.line(r));
    const auto [known, added] = index.try_emplace(name, launches.size());
    if (added) launches.emplace_back();
    if (table.lacks(r, quantity)) {
      known->second = launches.size();
      launches.emplace_back();
    } else {
      launches[known->second].push_back(r);
    }
  }
  return launches;
}

}  // namespace

ImportedPoints read_rest(const ImportRequest& request, const SphereInAir& sphere) {
  ImportTable table(request, {{"series", Dimension::text},
                              {"diameter", Dimension::length},
                              {"drop_height", Dimension::length, true},
                              {"rest_time", Dimension::time, true},
                              {"drop_height_sd", Dimension::length},
                              {"rest_time_sd", Dimension::time}});
  const StatedError drop = stated_error(request.drop_error, Dimension::length, "m", "--drop-error");
  const StatedError time = stated_error(request.time_error, Dimension::time, "s", "--time-error");
  Sequences sequences(request, sphere, table, "rest_time");
  for (std::size_t r = 0; r < table.size(); ++r) {
    if (table.lacks(r, "drop_height") || table.lacks(r, "rest_time")) {
      table.leave_out(r);
      continue;
    }
    const double height = table.positive(r, "drop_height");
    const double total = table.positive(r, "rest_time");
    const double fall = sequences.in_vacuum().fall(height).time;
    const double in_vacuum = (total - fall) / (total + fall);
    if (!(in_vacuum > 0.0)) {
      table.fail(r, "rest_time", fmt::format("at rest after {:g} s", total),
                 fmt::format("the fall alone takes {:.3g} s", fall), "check the units in --map");
    }
    const Bouncing bouncing = sequences.bouncing(r);
    const AirFlight::Part down = bouncing.fall(height);
    const double e = solved(
        [&](double at) { return down.time + bouncing.time_to_rest(at * down.speed, at) - total; },
        in_vacuum, most_for_rest, bouncing.air().has_value());
    ImportedPoint& point = sequences.add(r, bouncing, down.speed, e, in_vacuum);
    const double height_sd = table.value(r, "drop_height_sd").value_or(drop.of(height));
    const double total_sd = table.value(r, "rest_time_sd").value_or(time.of(total));
    const double fall_sd = 0.5 * fall * height_sd / height;
    const double sd =
        2.0 * std::hypot(fall * total_sd, total * fall_sd) / std::pow(total + fall, 2);
    if (sd > 0.0) point.value[Quantity::restitution_sd] = sd * (e / in_vacuum);
    if (height_sd > 0.0) point.value[Quantity::velocity_sd] = 0.5 * down.speed * height_sd / height;
  }
  std::vector<ImportRemark> remarks = {ImportRemark::mean_of_bounces};
  if (!drop.stated() && !table.has("drop_height_sd"))
    remarks.push_back(ImportRemark::no_drop_error);
  return sequences.result("a drop height and a time to rest", remarks);
}

ImportedPoints read_tops(const ImportRequest& request, const SphereInAir& sphere) {
  const ImportTable table(request, {{"series", Dimension::text},
                                    {"launch", Dimension::text},
                                    {"diameter", Dimension::length},
                                    {"top", Dimension::length, true},
                                    {"top_sd", Dimension::length}});
  const StatedError first =
      stated_error(request.drop_error, Dimension::length, "m", "--drop-error");
  const StatedError error =
      stated_error(request.rebound_error, Dimension::length, "m", "--rebound-error");
  Sequences sequences(request, sphere, table, "top");
  for (const std::vector<std::size_t>& rows : launches_of(table, "top")) {
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
      const double from = table.positive(rows[i], "top");
      const double to = table.positive(rows[i + 1], "top");
      const double from_sd =
          table.value(rows[i], "top_sd")
              .value_or(i == 0 && first.stated() ? first.of(from) : error.of(from));
      const double to_sd = table.value(rows[i + 1], "top_sd").value_or(error.of(to));
      const Bouncing bouncing = sequences.bouncing(rows[i + 1]);
      const double velocity = bouncing.fall(from).speed;
      const double e = bouncing.launch_for_height(to) / velocity;
      ImportedPoint& point =
          sequences.add(rows[i + 1], bouncing, velocity, e, std::sqrt(to / from));
      const double sd = 0.5 * e * std::hypot(from_sd / from, to_sd / to);
      if (sd > 0.0) point.value[Quantity::restitution_sd] = sd;
      if (from_sd > 0.0) point.value[Quantity::velocity_sd] = 0.5 * velocity * from_sd / from;
    }
  }
  return sequences.result("two successive heights of one launch",
                          {ImportRemark::same_point, ImportRemark::shared_values});
}

ImportedPoints read_blocks(const ImportRequest& request, const SphereInAir& sphere) {
  const ImportTable table(request, {{"series", Dimension::text},
                                    {"launch", Dimension::text},
                                    {"diameter", Dimension::length},
                                    {"block_time", Dimension::time, true},
                                    {"bounces", Dimension::count, true}});
  const StatedError error = stated_error(request.time_error, Dimension::time, "s", "--time-error");
  Sequences sequences(request, sphere, table, "block_time");
  const auto bounces_in = [&](std::size_t row) {
    const double count = table.positive(row, "bounces");
    if (count == std::round(count) && count <= most_bounces) return count;
    table.fail(row, "bounces", fmt::format("{:g} bounces", count), "a block has 1 to 1000",
               "correct the number");
  };
  for (const std::vector<std::size_t>& rows : launches_of(table, "block_time")) {
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
      const std::size_t row = rows[i + 1];
      const double t[2] = {table.positive(rows[i], "block_time"),
                           table.positive(row, "block_time")};
      const double n[2] = {bounces_in(rows[i]), bounces_in(row)};
      // The times of the two blocks in units of the first flight, in vacuum.
      const auto length = [&](double e, int block) {
        const double own = e == 1.0 ? n[block] : (1.0 - std::pow(e, n[block])) / (1.0 - e);
        return block == 0 ? own : own * std::pow(e, n[0]);
      };
      const double ratio = t[1] / t[0];
      const auto log_ratio = [&](double e) { return std::log(length(e, 1) / length(e, 0)); };
      constexpr double least = 1e-3;
      const double most = limits::restitution.upper;
      if (!(log_ratio(least) < std::log(ratio) && log_ratio(most) > std::log(ratio))) {
        const double about = std::pow(ratio * n[0] / n[1], 2.0 / (n[0] + n[1]));
        sequences.fail(row, about);
      }
      const double in_vacuum =
          find_root([&](double e) { return log_ratio(e) - std::log(ratio); }, least, most);
      const Bouncing bouncing = sequences.bouncing(row);
      // The launch that makes the first block take its time.
      const auto launch = [&](double e) {
        const double start = 0.5 * request.gravity * t[0] / length(e, 0);
        if (!bouncing.air().has_value()) return start;
        const auto excess = [&](double u) { return bouncing.time_of(n[0], u, e) - t[0]; };
        double high = 1.5 * start;
        while (excess(high) < 0.0 && high < 1e3 * start) high *= 1.5;
        return find_root(excess, 0.5 * start, high, solver_tolerance);
      };
      const double e = solved(
          [&](double at) {
            double speed = launch(at);
            bouncing.time_of(n[0], speed, at);
            return bouncing.time_of(n[1], speed, at) - t[1];
          },
          in_vacuum, most, bouncing.air().has_value());
      // V of the impact between the blocks, at which the e of the impacts around it are weighed.
      double after = std::isfinite(e) ? launch(e) : 0.0;
      bouncing.time_of(n[0], after, e);
      ImportedPoint& point = sequences.add(row, bouncing, after / e, e, in_vacuum);
      if (!error.stated()) continue;
      // d ln e = (d ln t_1 - d ln t_0) / slope and d ln V = d ln t_0 + d ln(V / t_0), in the errors
      // of the three instants at the ends of the blocks.
      constexpr double step = 1e-5;
      const auto slope_of = [&](const auto& function) {
        return (function(in_vacuum * (1.0 + step)) - function(in_vacuum * (1.0 - step))) /
               (2.0 * step);
      };
      const double slope = slope_of(log_ratio);
      const double speed_slope = slope_of(
          [&](double at) { return (n[0] - 1.0) * std::log(at) - std::log(length(at, 0)); });
      const double tau = error.of(t[0]);
      const double of_e[3] = {1.0 / t[0] / slope, -(1.0 / t[0] + 1.0 / t[1]) / slope,
                              1.0 / t[1] / slope};
      const double of_time[3] = {-1.0 / t[0], 1.0 / t[0], 0.0};
      double e_squares = 0.0;
      double v_squares = 0.0;
      for (int k = 0; k < 3; ++k) {
        e_squares += std::pow(of_e[k], 2);
        v_squares += std::pow(of_time[k] + speed_slope * of_e[k], 2);
      }
      point.value[Quantity::restitution_sd] = e * tau * std::sqrt(e_squares);
      point.value[Quantity::velocity_sd] = after / e * tau * std::sqrt(v_squares);
    }
  }
  return sequences.result("two successive blocks of one launch",
                          {ImportRemark::mean_of_bounces, ImportRemark::shared_values});
}

}  // namespace recoil
