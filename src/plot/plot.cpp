#include "plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <type_traits>

namespace recoil::plot {
namespace {

std::string superscript(int number) {
  static constexpr std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴",
                                                         "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out;
  for (const char c : fmt::format("{}", number)) {
    out += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  }
  return out;
}

std::string quantity(const Axis& axis, const char* otherwise) {
  return axis.label.empty() ? otherwise : axis.label;
}

/// The ticks of an axis that are names of things, not numbers.
std::vector<Tick> named_ticks(const Axis& axis) {
  std::vector<Tick> named;
  for (const Tick& tick : axis.ticks) {
    const bool number = tick.label.empty() || tick.label.find_first_of("-0123456789") == 0 ||
                        tick.label.starts_with("\u2212");
    if (!number) named.push_back(tick);
  }
  return named;
}

/// The columns of one layer; none where it shows no data.
std::vector<Column> columns_of(const Layer& layer, const Plot& plot) {
  const std::string x = quantity(plot.x, "x");
  const std::string y = quantity(plot.y, "y");
  const std::string value = plot.colours ? plot.colours->label : std::string("value");
  const auto across = [&](const std::string& what, const std::vector<double>& values) {
    return Column{what.empty() ? x : x + ", " + what, plot.x.unit, values, named_ticks(plot.x)};
  };
  const auto up = [&](const std::string& what, const std::vector<double>& values) {
    return Column{what.empty() ? y : y + ", " + what, plot.y.unit, values, named_ticks(plot.y)};
  };
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
          std::vector<Column> columns = {across("lower", shown.left), across("upper", shown.right),
                                         up("lower", shown.bottom), up("upper", shown.top)};
          if (!shown.values.empty()) columns.push_back({value, "", shown.values});
          return columns;
        } else if constexpr (std::is_same_v<Kind, Spans>) {
          return {up("", shown.y), across("lower", shown.lower), across("upper", shown.upper)};
        } else if constexpr (std::is_same_v<Kind, Discs>) {
          return {across("", shown.x), up("", shown.y), {value, "", shown.values}};
        } else {
          return {};
        }
      },
      layer);
}

/// A cell in quotes where it has to be.
std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string out = "\"";
  for (const char c : cell) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string on_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// A number in five digits or, where its axis has one, its name; empty where it is none.
std::string cell_of(const Column& column, double value) {
  constexpr double close = 1e-9;
  for (const Tick& tick : column.named) {
    if (std::abs(value - tick.at) < close) return quoted(on_one_line(tick.label));
  }
  if (!std::isfinite(value)) return "";
  return value == 0.0 ? "0" : fmt::format("{:.5g}", value);
}

/// The table of a picture while it grows.
class Sheet {
 public:
  explicit Sheet(const Picture& picture) : picture_(picture) {}

  void add(const DataTable& table) {
    const Column& first = table.columns.front();
    const std::string shared = title_of(table.plot, "", first);
    const std::size_t row = rows_for(table.plot, first, column_named(shared));
    for (std::size_t c = 1; c < table.columns.size(); ++c) {
      const std::string title = title_of(table.plot, table.name, table.columns[c]);
      std::string own = title;
      for (int k = 2; known(own); ++k) own = fmt::format("{} ({})", title, k);
      fill(column_named(own), row, table.columns[c]);
    }
  }

  std::string text() const {
    std::string out;
    for (std::size_t c = 0; c < titles_.size(); ++c) {
      out += (c > 0 ? "," : "") + quoted(titles_[c]);
    }
    for (std::size_t r = 0; r < row_count_; ++r) {
      out += "\n";
      for (std::size_t c = 0; c < titles_.size(); ++c) {
        if (c > 0) out += ",";
        if (r < cells_[c].size()) out += cells_[c][r];
      }
    }
    return titles_.empty() ? "" : out + "\n";
  }

 private:
  /// Rows that a layer has taken, and what its first column has in them.
  struct Taken {
    std::size_t plot, column, row;
    std::vector<double> values;
  };

  std::string title_of(std::size_t plot, const std::string& layer, const Column& column) const {
    std::string title;
    if (picture_.plots.size() > 1) {
      const std::string& heading = picture_.plots[plot].heading;
      title = (heading.empty() ? fmt::format("plot {}", plot + 1) : heading) + ": ";
    }
    if (!layer.empty()) title += layer + ": ";
    title += column.name;
    if (!column.unit.empty()) title += fmt::format(" [{}]", column.unit);
    return on_one_line(title);
  }

  bool known(const std::string& title) const {
    return std::find(titles_.begin(), titles_.end(), title) != titles_.end();
  }

  std::size_t column_named(const std::string& title) {
    const auto found = std::find(titles_.begin(), titles_.end(), title);
    if (found != titles_.end()) return static_cast<std::size_t>(found - titles_.begin());
    titles_.push_back(title);
    cells_.emplace_back();
    return titles_.size() - 1;
  }

  /// The first row of a layer: that of another with the same first column, or a new one.
  std::size_t rows_for(std::size_t plot, const Column& first, std::size_t column) {
    for (const Taken& taken : taken_) {
      if (taken.plot == plot && taken.column == column && taken.values == first.values) {
        return taken.row;
      }
    }
    taken_.push_back({plot, column, row_count_, first.values});
    fill(column, row_count_, first);
    return taken_.back().row;
  }

  void fill(std::size_t column, std::size_t row, const Column& values) {
    std::vector<std::string>& cells = cells_[column];
    cells.resize(std::max(cells.size(), row + values.values.size()));
    for (std::size_t i = 0; i < values.values.size(); ++i) {
      cells[row + i] = cell_of(values, values.values[i]);
    }
    row_count_ = std::max(row_count_, cells.size());
  }

  const Picture& picture_;
  std::vector<std::string> titles_;
  std::vector<std::vector<std::string>> cells_;  ///< [column][row]; beyond the end: empty
  std::vector<Taken> taken_;
  std::size_t row_count_ = 0;
};

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

std::vector<DataTable> data_of(const Picture& picture) {
  std::vector<DataTable> tables;
  for (std::size_t p = 0; p < picture.plots.size(); ++p) {
    for (const Layer& layer : picture.plots[p].layers) {
      std::vector<Column> columns = columns_of(layer, picture.plots[p]);
      if (!columns.empty()) tables.push_back({name_of(layer), std::move(columns), p});
    }
  }
  return tables;
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

Range quantile_range(std::vector<double> values, double lower, double upper) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double p) {
    return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1) + 0.5)];
  };
  return {at(lower), at(upper)};
}

Scaling scaling_for(double magnitude, const std::string& unit) {
  if (!(magnitude > 0.0) || !std::isfinite(magnitude)) return {1.0, unit};
  if (magnitude >= 0.1 && magnitude < 1000.0) return {1.0, unit};
  const int power = 3 * static_cast<int>(std::floor(std::log10(magnitude) / 3.0));
  return {std::pow(10.0, -power), fmt::format("10{} {}", superscript(power), unit)};
}

std::string csv_of(const Picture& picture) {
  Sheet sheet(picture);
  for (const DataTable& table : data_of(picture)) sheet.add(table);
  return sheet.text();
}

}  // namespace recoil::plot
