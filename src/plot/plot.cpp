#include "plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <type_traits>

#include "data/csv.hpp"

namespace recoil::plot {
namespace {

/// Numbers under a title: "restitution e, lower [1]".
struct Column {
  std::string title;
  std::vector<double> values;
};

/// The columns of one layer; none if it shows no data.
std::vector<Column> columns_of(const Layer& layer, const Plot& plot) {
  const auto titled = [](const Axis& axis, const char* otherwise, const char* what) {
    const std::string name = axis.label.empty() ? otherwise : axis.label;
    return (*what == '\0' ? name : fmt::format("{}, {}", name, what)) +
           (axis.unit.empty() ? "" : fmt::format(" [{}]", axis.unit));
  };
  const auto across = [&](const char* what, const std::vector<double>& values) {
    return Column{titled(plot.x, "x", what), values};
  };
  const auto up = [&](const char* what, const std::vector<double>& values) {
    return Column{titled(plot.y, "y", what), values};
  };
  const std::string value = plot.colours ? plot.colours->label : std::string("value");
  return std::visit(
      [&](const auto& shown) -> std::vector<Column> {
        using Kind = std::decay_t<decltype(shown)>;
        if constexpr (std::is_same_v<Kind, Points>) {
          std::vector<Column> columns = {across("", shown.x), up("", shown.y)};
          if (!shown.lower.empty()) {
            columns.push_back(up("lower", shown.lower));
            columns.push_back(up("upper", shown.upper));
          }
          return columns;
        } else if constexpr (std::is_same_v<Kind, Line>) {
          return {across("", shown.x), up("", shown.y)};
        } else if constexpr (std::is_same_v<Kind, Band>) {
          return {across("", shown.x), up("lower", shown.lower), up("upper", shown.upper)};
        } else if constexpr (std::is_same_v<Kind, Boxes>) {
          return {across("lower", shown.left), across("upper", shown.right),
                  up("lower", shown.bottom), up("upper", shown.top)};
        } else if constexpr (std::is_same_v<Kind, Discs>) {
          return {across("", shown.x), up("", shown.y), {value, shown.values}};
        } else {
          return {};
        }
      },
      layer);
}

}  // namespace

Points& Points::with_sd(const std::vector<double>& sd) {
  lower.clear();
  upper.clear();
  for (std::size_t i = 0; i < y.size(); ++i) {
    lower.push_back(y[i] - sd.at(i));
    upper.push_back(y[i] + sd.at(i));
  }
  return *this;
}

void Boxes::add(double from_x, double to_x, double from_y, double to_y) {
  left.push_back(from_x);
  right.push_back(to_x);
  bottom.push_back(from_y);
  top.push_back(to_y);
}

const std::string& name_of(const Layer& layer) {
  static const std::string none;
  return std::visit(
      [](const auto& shown) -> const std::string& {
        if constexpr (requires { shown.name; }) {
          return shown.name;
        } else {
          return none;
        }
      },
      layer);
}

std::string Axis::title() const {
  return unit.empty() || label.empty() ? label : fmt::format("{}  [{}]", label, unit);
}

std::string plot_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) {
    name = "f-" + name;
  }
  return name;
}

Range range_of(const std::vector<double>& values, double margin) {
  Range range{INFINITY, -INFINITY};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    range.lower = std::min(range.lower, value);
    range.upper = std::max(range.upper, value);
  }
  if (!(range.lower <= range.upper)) return {};
  double width = range.width();
  if (!(width > 0.0)) width = range.upper != 0.0 ? std::abs(range.upper) : 1.0;
  return {range.lower - margin * width, range.upper + margin * width};
}

Range log_range_of(const std::vector<double>& values, double margin) {
  std::vector<double> logs;
  for (const double value : values) {
    if (value > 0.0) logs.push_back(std::log10(value));
  }
  const Range range = range_of(logs, margin);
  return {std::pow(10.0, range.lower), std::pow(10.0, range.upper)};
}

std::string csv_of(const Picture& picture) {
  std::vector<Column> sheet;
  std::size_t rows = 0;
  const auto column = [&](const std::string& title) {
    return std::ranges::find_if(sheet, [&](const Column& one) { return one.title == title; });
  };
  const auto fill = [&](const Column& from, std::size_t row) {
    auto to = column(from.title);
    if (to == sheet.end()) to = sheet.insert(to, {from.title, {}});
    to->values.resize(row, NAN);
    to->values.insert(to->values.end(), from.values.begin(), from.values.end());
    rows = std::max(rows, to->values.size());
  };
  std::vector<std::pair<Column, std::size_t>> begun;  // first columns and their first rows
  for (const Plot& plot : picture.plots) {
    for (const Layer& layer : plot.layers) {
      std::vector<Column> columns = columns_of(layer, plot);
      if (columns.empty() || columns[0].values.empty()) continue;
      const auto same = std::ranges::find_if(begun, [&](const auto& one) {
        return one.first.title == columns[0].title && one.first.values == columns[0].values;
      });
      const std::size_t row = same == begun.end() ? rows : same->second;
      if (same == begun.end()) {
        begun.emplace_back(columns[0], row);
        fill(columns[0], row);
      }
      for (std::size_t c = 1; c < columns.size(); ++c) {
        if (!name_of(layer).empty()) columns[c].title = name_of(layer) + ": " + columns[c].title;
        const std::string title = columns[c].title;
        for (int k = 2; column(columns[c].title) != sheet.end(); ++k) {
          columns[c].title = fmt::format("{} ({})", title, k);
        }
        fill(columns[c], row);
      }
    }
  }
  if (sheet.empty()) return "";
  std::string out;
  for (const Column& one : sheet) out += (out.empty() ? "" : ",") + csv_cell(one.title);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c < sheet.size(); ++c) {
      out += c == 0 ? '\n' : ',';
      const double value = row < sheet[c].values.size() ? sheet[c].values[row] : NAN;
      if (std::isfinite(value)) out += value == 0.0 ? "0" : fmt::format("{:.5g}", value);
    }
  }
  return out + "\n";
}

}  // namespace recoil::plot
