#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "data/text.hpp"
#include "experiment/import_formats.hpp"

namespace recoil {
namespace {

/// One axis of the figure, in the unit that is printed beside it.
struct FigureAxis {
  std::string name;                                 ///< "x" or "y"
  Quantity quantity = Quantity::incident_velocity;  ///< of its coordinate
  double factor = 1.0;                              ///< of the coordinate, to SI
  bool logarithmic = false;
  double lower = 0.0;
  double upper = 0.0;
  double pixels = 0.0;         ///< its length in the picture; 0 when not stated
  double reading_error = 0.0;  ///< one standard deviation, part of the axis [1]; 0: not stated

  /// True if --axis states its ends.
  bool stated() const { return lower < upper; }
  /// One standard deviation of a reading at `value`, in the unit of the axis.
  double error_at(double value) const {
    return logarithmic ? std::abs(value) * reading_error * std::log(upper / lower)
                       : reading_error * (upper - lower);
  }
};

using FigureAxes = std::array<FigureAxis, 2>;

/// The number before the unit `px` or `%`; nullopt unless it is positive.
std::optional<double> positive_with(const std::string& word, std::string_view unit) {
  if (!word.ends_with(unit)) return std::nullopt;
  const auto number = parse_number(std::string_view(word).substr(0, word.size() - unit.size()));
  return number && *number > 0.0 ? number : std::nullopt;
}

void read_axis(FigureAxis& axis, const std::string& text) {
  const auto fail = [&](const std::string& why) {
    throw InputError(
        {}, fmt::format("--axis {}={}", axis.name, text), why,
        fmt::format("write --axis {0}=log,1,100 or --axis {0}=linear,0,1,600px", axis.name));
  };
  const std::vector<std::string> parts = split_list(text);
  if (parts.size() < 3 || parts.size() > 4) fail("it has a scale, two ends and perhaps pixels");
  axis.logarithmic = parts[0] == "log";
  if (!axis.logarithmic && parts[0] != "linear") fail("the scale is log or linear");
  const auto lower = parse_number(parts[1]);
  const auto upper = parse_number(parts[2]);
  if (!lower || !upper || !(*lower < *upper)) fail("its ends are numbers, the lower one first");
  if (axis.logarithmic && !(*lower > 0.0)) fail("a logarithmic axis begins above zero");
  axis.lower = *lower;
  axis.upper = *upper;
  axis.pixels = parts.size() == 4 ? positive_with(parts[3], "px").value_or(0.0) : 0.0;
  if (parts.size() == 4 && !(axis.pixels > 0.0)) fail("its length is a number of pixels");
}

void read_axes(const ImportRequest& request, FigureAxes& axes) {
  for (const std::string& word : request.axes) {
    const auto pair = split_pair(word);
    if (!pair || (pair->first != "x" && pair->first != "y")) {
      throw InputError({}, fmt::format("--axis {} names no axis", quote(word)),
                       "a figure has the axes x and y",
                       "write --axis x=log,1,100 or --axis y=linear,0,1");
    }
    read_axis(axes[pair->first == "x" ? 0 : 1], pair->second);
  }
}

void read_reading_error(const std::string& word, FigureAxes& axes) {
  if (word.empty()) return;
  const auto pixels = positive_with(word, "px");
  const auto percent = positive_with(word, "%");
  if (!pixels && !percent) {
    throw InputError({},
                     fmt::format("--reading-error {} is neither a percentage of the axis nor a "
                                 "number of pixels",
                                 quote(word)),
                     "", "write --reading-error 0.5% or --reading-error 2px");
  }
  for (FigureAxis& axis : axes) {
    if (!axis.stated()) {
      throw InputError(
          {}, fmt::format("--reading-error without --axis {}=...", axis.name),
          "a percentage of an axis means nothing without its ends",
          fmt::format("add --axis {0}=log,MIN,MAX or --axis {0}=linear,MIN,MAX", axis.name));
    }
    if (pixels && !(axis.pixels > 0.0)) {
      throw InputError({},
                       fmt::format("--reading-error is in pixels, but the length of --axis {} in "
                                   "pixels is not known",
                                   axis.name),
                       "", fmt::format("write --axis {}=...,600px", axis.name));
    }
    axis.reading_error = pixels ? *pixels / axis.pixels : *percent / 100.0;
  }
}

/// Reads --map of a figure: "incident_velocity=x:cm/s".
void read_coordinates(const std::vector<std::string>& map, FigureAxes& axes) {
  for (const std::string& entry : split_lists(map)) {
    const auto pair = split_pair(entry);
    const Quantity quantity =
        value_named<Quantity>(pair ? pair->first : "").value_or(Quantity::series);
    const std::size_t colon = pair ? pair->second.find(':') : std::string::npos;
    const std::string name = pair ? pair->second.substr(0, colon) : "";
    const bool suits = quantity == Quantity::incident_velocity ||
                       quantity == Quantity::rebound_velocity || quantity == Quantity::restitution;
    if (!suits || (name != "x" && name != "y")) {
      throw InputError({}, fmt::format("--map {} does not suit a figure", quote(entry)),
                       "it has x and y, one of them the incident velocity",
                       "write incident_velocity=x:m/s and restitution=y or rebound_velocity=y:m/s");
    }
    FigureAxis& axis = axes[name == "x" ? 0 : 1];
    axis.quantity = quantity;
    axis.factor = colon == std::string::npos
                      ? 1.0
                      : known_scale(dimension_of(quantity), pair->second.substr(colon + 1),
                                    fmt::format("--map {}", pair->first), {})
                            .factor;
  }
  if ((axes[0].quantity == Quantity::incident_velocity) ==
      (axes[1].quantity == Quantity::incident_velocity)) {
    throw InputError({}, "which axis is the incident velocity?", "",
                     "write incident_velocity=x:m/s");
  }
}

/// The axes x and y; incident velocity and restitution, unless --map states other quantities.
FigureAxes axes_of(const ImportRequest& request) {
  FigureAxes axes;
  axes[0].name = "x";
  axes[1].name = "y";
  axes[1].quantity = Quantity::restitution;
  read_axes(request, axes);
  read_reading_error(request.reading_error, axes);
  read_coordinates(request.map, axes);
  return axes;
}

struct Layout {
  std::vector<std::string> series;  ///< one per pair of columns
  std::size_t first_row = 0;        ///< 1 or 2 below the header lines; 0 without any
};

Layout layout_of(const std::vector<CsvRow>& rows, const ImportRequest& request) {
  Layout layout;
  const CsvRow& first = rows.front();
  const NumberFormat format = number_format(request);
  if (first.size() >= 2 && parse_number(first[0].text, format) &&
      parse_number(first[1].text, format)) {
    layout.series = {default_series(request)};
    return layout;
  }
  const auto is_xy = [](const CsvRow& row) {
    return row.size() >= 2 && (row[0].text == "X" || row[0].text == "x") &&
           (row[1].text == "Y" || row[1].text == "y");
  };
  const std::size_t header = is_xy(first) ? 0 : 1;
  if (rows.size() <= header || !is_xy(rows[header])) {
    throw InputError({request.file.string(), first.front().line, 1},
                     "this is not WebPlotDigitizer's CSV",
                     "that has the names of the series in the first line and X,Y under each",
                     "export all series as CSV, or use --format csv with --map");
  }
  for (std::size_t k = 0; k + 1 < rows[header].size(); k += 2) {
    std::string name = header == 1 && k < first.size() ? first[k].text : "";
    if (name.empty()) name = k == 0 ? default_series(request) : fmt::format("series {}", k / 2 + 1);
    layout.series.push_back(name);
  }
  layout.first_row = header + 1;
  return layout;
}

/// Series whose points are ends of error bars: --error-series SERIES=UPPER,LOWER.
struct ErrorSeries {
  std::string of;
  std::vector<std::string> ends;
};

std::vector<ErrorSeries> error_series_of(const ImportRequest& request, const Layout& layout) {
  std::vector<ErrorSeries> all;
  for (const std::string& word : request.error_series) {
    const auto pair = split_pair(word);
    ErrorSeries one{pair ? pair->first : "",
                    pair ? split_list(pair->second) : std::vector<std::string>()};
    if (one.ends.empty() || one.ends.size() > 2) {
      throw InputError({}, fmt::format("--error-series {} names no ends of bars", quote(word)), "",
                       "write --error-series SERIES=UPPER or SERIES=UPPER,LOWER");
    }
    std::vector<std::string> names = one.ends;
    names.push_back(one.of);
    for (const std::string& name : names) {
      if (std::ranges::find(layout.series, name) != layout.series.end()) continue;
      throw InputError({}, fmt::format("--error-series: there is no series {}", quote(name)), "",
                       did_you_mean(name, layout.series));
    }
    all.push_back(one);
  }
  return all;
}

/// Gives the points of a series standard deviations of the rebound: the distance from the point to
/// the end of its error bar, or the mean of two such distances. Removes the ends from the points.
/// Points and ends are matched in the order of incident velocity.
void take_error_bars(const ErrorSeries& bars, const ImportRequest& request,
                     std::vector<ImportedPoint>& points) {
  const auto sorted = [&](const std::string& series) {
    std::vector<ImportedPoint*> members;
    for (ImportedPoint& point : points) {
      if (point.series == series) members.push_back(&point);
    }
    std::ranges::stable_sort(members, [](const ImportedPoint* a, const ImportedPoint* b) {
      return *a->value[Quantity::incident_velocity] < *b->value[Quantity::incident_velocity];
    });
    return members;
  };
  const std::vector<ImportedPoint*> own = sorted(bars.of);
  std::vector<double> length(own.size(), 0.0);
  for (const std::string& name : bars.ends) {
    const std::vector<ImportedPoint*> ends = sorted(name);
    if (ends.size() != own.size()) {
      throw InputError({request.file.string()},
                       fmt::format("'{}' has {} points and its error bars '{}' have {} ends",
                                   bars.of, own.size(), name, ends.size()),
                       "every point needs its end", "read the missing ones, or remove the others");
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto e = own[i]->restitution();
      const auto end = ends[i]->restitution();
      if (e && end) length[i] += std::abs(*end - *e) / static_cast<double>(bars.ends.size());
    }
  }
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (length[i] > 0.0) own[i]->value[Quantity::restitution_sd] = length[i];
  }
  std::erase_if(points, [&](const ImportedPoint& point) {
    return std::ranges::find(bars.ends, point.series) != bars.ends.end();
  });
}

/// Reads one coordinate of a point. @returns its reading error, in the SI unit of the quantity
std::optional<double> read_coordinate(const CsvField& cell, const FigureAxis& axis,
                                      const ImportRequest& request, ImportedPoint& point) {
  const std::string file = request.file.string();
  const double printed = number_in(cell, file, to_string(axis.quantity), number_format(request));
  const double value = printed * axis.factor;
  if (axis.quantity == Quantity::incident_velocity && !(value > 0.0)) {
    throw InputError(cell.in(file), fmt::format("V = {:g} m/s", value),
                     "an incident velocity has to be positive",
                     "check the calibration of the axes, or remove the point");
  }
  if (value < 0.0 && !(request.captured_below > 0.0)) {
    throw InputError(cell.in(file), fmt::format("{} = {:g}", name_of(axis.quantity), value),
                     "a rebound cannot be negative",
                     "take it as a capture with --captured-below 0.01, or remove the point");
  }
  point.value[axis.quantity] = value;
  if (!(axis.reading_error > 0.0)) return std::nullopt;
  return axis.error_at(printed) * axis.factor;
}

ImportedPoint point_of(const CsvField& x, const CsvField& y, const FigureAxes& axes,
                       const ImportRequest& request) {
  ImportedPoint point;
  std::optional<double> velocity_error = read_coordinate(x, axes[0], request, point);
  std::optional<double> rebound_error = read_coordinate(y, axes[1], request, point);
  if (axes[1].quantity == Quantity::incident_velocity) std::swap(velocity_error, rebound_error);
  if (*point.restitution() < request.captured_below) {
    point.value[Quantity::restitution] = std::nullopt;
    point.value[Quantity::rebound_velocity] = std::nullopt;
    point.value[Quantity::events] = 1.0;
    point.value[Quantity::captured] = 1.0;
  } else if (rebound_error) {
    // The contribution of the error of V to e follows from velocity_sd.
    const bool is_velocity = point.value[Quantity::rebound_velocity].has_value();
    point.value[Quantity::restitution_sd] =
        is_velocity ? *rebound_error / *point.value[Quantity::incident_velocity] : *rebound_error;
  }
  point.value[Quantity::velocity_sd] = velocity_error;
  return point;
}

}  // namespace

ImportedPoints read_digitised(const ImportRequest& request) {
  ImportedPoints out;
  const std::vector<CsvRow> rows = import_rows(request, out.notes);
  const Layout layout = layout_of(rows, request);
  const FigureAxes axes = axes_of(request);
  const std::vector<ErrorSeries> bars = error_series_of(request, layout);
  for (std::size_t s = 0; s < layout.series.size(); ++s) {
    for (std::size_t r = layout.first_row; r < rows.size(); ++r) {
      const CsvRow& row = rows[r];
      const bool has_x = 2 * s < row.size() && !row[2 * s].text.empty();
      const bool has_y = 2 * s + 1 < row.size() && !row[2 * s + 1].text.empty();
      if (!has_x && !has_y) continue;
      if (has_x != has_y) {
        throw InputError({request.file.string(), row.front().line, row.back().column},
                         fmt::format("a point of '{}' lacks x or y", layout.series[s]), "",
                         "remove the cell or complete it");
      }
      ImportedPoint point = point_of(row[2 * s], row[2 * s + 1], axes, request);
      point.series = layout.series[s];
      point.line = row.front().line;
      out.points.push_back(point);
    }
  }
  for (const ErrorSeries& one : bars) take_error_bars(one, request, out.points);
  if (!bars.empty()) return out;
  if (request.reading_error.empty()) {
    out.notes.push_back({ImportRemark::no_reading_error});
  } else if (request.scatter.empty()) {
    out.notes.push_back({ImportRemark::reading_error_alone});
  }
  return out;
}

}  // namespace recoil
