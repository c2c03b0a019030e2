#include "plot/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace recoil::plot {
namespace {

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

std::string csv_of(const Picture& picture) {
  Sheet sheet(picture);
  for (const DataTable& table : data_of(picture)) sheet.add(table);
  return sheet.text();
}

}  // namespace recoil::plot
