#include "experiment/import_digitised.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "data/text.hpp"
#include "experiment/import_table.hpp"

namespace recoil {
namespace {

/// One axis of the figure, in the unit that is printed beside it.
struct FigureAxis {
  bool logarithmic = false;
  double lower = 0.0;
  double upper = 0.0;
  double pixels = 0.0;  ///< its length in the picture; 0 when not stated
};

/// What a digitised coordinate is: "incident_velocity=x:cm/s".
struct Coordinate {
  std::string quantity;
  double factor = 1.0;
};

FigureAxis read_axis(const std::string& name, const std::string& text) {
  const std::vector<std::string> parts = split_list(text);
  const auto bad = [&](const std::string& why) {
    return InputError(
        {}, fmt::format("--axis {}={}", name, text), why,
        fmt::format("write --axis {}=log,1,100 or --axis {}=linear,0,1,600px", name, name));
  };
  if (parts.size() < 3 || parts.size() > 4)
    throw bad("it has a scale, two ends and perhaps pixels");
  FigureAxis axis;
  axis.logarithmic = parts[0] == "log";
  if (!axis.logarithmic && parts[0] != "linear") throw bad("the scale is log or linear");
  const auto lower = parse_number(parts[1]);
  const auto upper = parse_number(parts[2]);
  if (!lower || !upper || !(*lower < *upper))
    throw bad("its ends are numbers, the lower one first");
  if (axis.logarithmic && !(*lower > 0.0)) throw bad("a logarithmic axis begins above zero");
  axis.lower = *lower;
  axis.upper = *upper;
  if (parts.size() == 4) {
    const std::string& word = parts[3];
    const auto pixels =
        word.ends_with("px") ? parse_number(word.substr(0, word.size() - 2)) : std::nullopt;
    if (!pixels || !(*pixels > 0.0)) throw bad("its length is a number of pixels");
    axis.pixels = *pixels;
  }
  return axis;
}

std::map<std::string, FigureAxis> read_axes(const std::vector<std::string>& words) {
  std::map<std::string, FigureAxis> axes;
  for (const std::string& word : words) {
    const auto pair = split_pair(word);
    if (!pair || (pair->first != "x" && pair->first != "y")) {
      throw InputError({}, fmt::format("--axis {} names no axis", quote(word)),
                       "a figure has the axes x and y",
                       "write --axis x=log,1,100 or --axis y=linear,0,1");
    }
    axes[pair->first] = read_axis(pair->first, pair->second);
  }
  return axes;
}

/// One standard deviation of a reading at `value` on the axis, in its unit.
class ReadingError {
 public:
  explicit ReadingError(const ImportRequest& request) : axes_(read_axes(request.axes)) {
    const std::string& word = request.reading_error;
    if (word.empty()) return;
    const bool pixels = word.ends_with("px");
    const bool percent = word.ends_with("%");
    const auto number = parse_number(word.substr(0, word.size() - (pixels ? 2 : 1)));
    if (!(pixels || percent) || !number || !(*number > 0.0)) {
      throw InputError(
          {},
          fmt::format(
              "--reading-error {} is neither a percentage of the axis nor a number of pixels",
              quote(word)),
          "", "write --reading-error 0.5% or --reading-error 2px");
    }
    for (const char* name : {"x", "y"}) {
      if (!axes_.contains(name)) {
        throw InputError(
            {}, fmt::format("--reading-error without --axis {}=...", name),
            "a percentage of an axis means nothing without its ends",
            fmt::format("add --axis {}=log,MIN,MAX or --axis {}=linear,MIN,MAX", name, name));
      }
      if (pixels && !(axes_[name].pixels > 0.0)) {
        throw InputError(
            {},
            fmt::format(
                "--reading-error is in pixels, but the length of --axis {} in pixels is not known",
                name),
            "", fmt::format("write --axis {}=...,600px", name));
      }
      fraction_[name] = pixels ? *number / axes_[name].pixels : *number / 100.0;
    }
  }

  bool stated() const { return !fraction_.empty(); }
  bool any_axis() const { return !axes_.empty(); }

  double at(const std::string& name, double value) const {
    const FigureAxis& axis = axes_.at(name);
    const double f = fraction_.at(name);
    return axis.logarithmic ? std::abs(value) * f * std::log(axis.upper / axis.lower)
                            : f * (axis.upper - axis.lower);
  }

 private:
  std::map<std::string, FigureAxis> axes_;
  std::map<std::string, double> fraction_;
};

/// x and y, incident velocity and restitution unless --map says otherwise.
std::map<std::string, Coordinate> read_coordinates(const std::vector<std::string>& map) {
  std::map<std::string, Coordinate> found = {{"x", {"incident_velocity", 1.0}},
                                             {"y", {"restitution", 1.0}}};
  for (const std::string& list : map) {
    for (const std::string& entry : split_list(list)) {
      const auto pair = split_pair(entry);
      const std::string axis = pair ? pair->second.substr(0, pair->second.find(':')) : "";
      const bool velocity =
          pair && (pair->first == "incident_velocity" || pair->first == "rebound_velocity");
      if (!(velocity || (pair && pair->first == "restitution")) || (axis != "x" && axis != "y")) {
        throw InputError(
            {}, fmt::format("--map {} does not suit a figure", quote(entry)),
            "it has x and y, one of them the incident velocity",
            "write incident_velocity=x:m/s and restitution=y or rebound_velocity=y:m/s");
      }
      Coordinate coordinate{pair->first, 1.0};
      if (const std::size_t at = pair->second.find(':'); at != std::string::npos) {
        const Dimension dimension = velocity ? Dimension::velocity : Dimension::ratio;
        const auto factor = unit_factor(dimension, pair->second.substr(at + 1));
        if (!factor) {
          throw InputError({}, fmt::format("--map {}: unknown unit", entry), "",
                           fmt::format("use {}", join(unit_names(dimension))));
        }
        coordinate.factor = *factor;
      }
      found[axis] = coordinate;
    }
  }
  const bool x_is = found["x"].quantity == "incident_velocity";
  if (x_is == (found["y"].quantity == "incident_velocity")) {
    throw InputError({}, "which axis is the incident velocity?", "",
                     "write incident_velocity=x:m/s");
  }
  return found;
}

/// The two header lines, or none.
struct Layout {
  std::vector<std::string> series;  ///< one per pair of columns
  std::size_t first_row = 0;
};

Layout layout_of(const std::vector<CsvRow>& rows, const ImportRequest& request) {
  Layout layout;
  const std::string file = request.file.string();
  const std::string fallback =
      request.series.empty() ? request.file.stem().string() : request.series;
  const CsvRow& first = rows.front();
  if (first.size() >= 2 && parse_number(first[0].text) && parse_number(first[1].text)) {
    layout.series = {fallback};
    return layout;
  }
  const auto is_xy = [](const CsvRow& row) {
    return row.size() >= 2 && (row[0].text == "X" || row[0].text == "x") &&
           (row[1].text == "Y" || row[1].text == "y");
  };
  const std::size_t header = is_xy(first) ? 0 : 1;
  if (rows.size() <= header || !is_xy(rows[header])) {
    throw InputError({file, first.front().line, 1}, "this is not WebPlotDigitizer's CSV",
                     "that has the names of the series in the first line and X,Y under each",
                     "export all series as CSV, or use --format csv with --map");
  }
  for (std::size_t k = 0; k + 1 < rows[header].size(); k += 2) {
    std::string name = header == 1 && k < first.size() ? first[k].text : "";
    if (name.empty()) name = layout.series.empty() ? fallback : fmt::format("series {}", k / 2 + 1);
    layout.series.push_back(name);
  }
  layout.first_row = header + 1;
  return layout;
}

}  // namespace

ImportedPoints read_digitised(const ImportRequest& request) {
  const std::string file = request.file.string();
  const std::vector<CsvRow> rows = import_rows(request.file);
  const Layout layout = layout_of(rows, request);
  const ReadingError error(request);
  const auto coordinates = read_coordinates(request.map);
  ImportedPoints out;
  for (std::size_t s = 0; s < layout.series.size(); ++s) {
    for (std::size_t r = layout.first_row; r < rows.size(); ++r) {
      const CsvRow& row = rows[r];
      const bool x_there = 2 * s < row.size() && !row[2 * s].text.empty();
      const bool y_there = 2 * s + 1 < row.size() && !row[2 * s + 1].text.empty();
      if (!x_there && !y_there) continue;
      if (x_there != y_there) {
        throw InputError({file, row.front().line, row.back().column},
                         fmt::format("a point of '{}' lacks x or y", layout.series[s]), "",
                         "remove the cell or complete it");
      }
      ImportedPoint point;
      point.series = layout.series[s];
      point.line = row.front().line;
      std::optional<double> sd_e;
      std::optional<double> sd_rebound;
      for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
        const CsvField& cell = row[2 * s + axis];
        const std::string name = axis == 0 ? "x" : "y";
        const Coordinate& coordinate = coordinates.at(name);
        const double printed = import_number(cell, file, coordinate.quantity);
        const double value = printed * coordinate.factor;
        const std::optional<double> sd =
            error.stated() ? std::optional<double>(error.at(name, printed) * coordinate.factor)
                           : std::nullopt;
        if (coordinate.quantity == "incident_velocity") {
          if (!(value > 0.0)) {
            throw InputError({file, cell.line, cell.column}, fmt::format("V = {:g} m/s", value),
                             "an incident velocity has to be positive",
                             "check the calibration of the axes, or remove the point");
          }
          point.velocity = value;
          point.velocity_sd = sd;
          continue;
        }
        if (value < 0.0 && !(request.captured_below > 0.0)) {
          throw InputError({file, cell.line, cell.column},
                           fmt::format("{} = {:g}", coordinate.quantity, value),
                           "a rebound cannot be negative",
                           "take it as a capture with --captured-below 0.01, or remove the point");
        }
        if (coordinate.quantity == "restitution") {
          point.restitution = value;
          sd_e = sd;
        } else {
          point.rebound_velocity = value;
          sd_rebound = sd;
        }
      }
      const double e =
          point.restitution ? *point.restitution : *point.rebound_velocity / point.velocity;
      point.restitution_sd = sd_e;
      // The error of V reaches e by way of velocity_sd.
      if (sd_rebound) point.restitution_sd = *sd_rebound / point.velocity;
      if (e < request.captured_below) {
        point.restitution = std::nullopt;
        point.rebound_velocity = std::nullopt;
        point.restitution_sd = std::nullopt;
        point.events = 1.0;
        point.captured = 1.0;
      }
      out.points.push_back(point);
    }
  }
  if (!error.stated()) {
    out.notes.push_back({ImportRemark::no_reading_error});
  } else if (request.scatter.empty()) {
    out.notes.push_back({ImportRemark::reading_error_alone});
  }
  return out;
}

}  // namespace recoil
