#include "report/density.hpp"

#include <algorithm>
#include <cmath>

namespace recoil {
namespace {

/// A standard deviation that single far values do not blow up: from the quartiles.
double robust_deviation(const std::vector<double>& values) {
  const plot::Range quartiles = plot::quantile_range(values, 0.25, 0.75);
  return (quartiles.upper - quartiles.lower) / 1.349;
}

double place(std::size_t cell, plot::Range range) {
  return range.lower + (range.upper - range.lower) * static_cast<double>(cell) /
                           static_cast<double>(DensityGrid::cells - 1);
}

/// exp(-((place - value) / width)^2 / 2) for every place of one axis.
std::vector<double> kernel(double value, double width, plot::Range range) {
  std::vector<double> weights(DensityGrid::cells);
  for (std::size_t c = 0; c < weights.size(); ++c) {
    weights[c] = std::exp(-0.5 * std::pow((place(c, range) - value) / width, 2));
  }
  return weights;
}

}  // namespace

Bars bars_of(const std::vector<double>& values, plot::Range range) {
  const plot::Range quartiles = plot::quantile_range(values, 0.25, 0.75);
  const double n = static_cast<double>(std::max<std::size_t>(values.size(), 1));
  const double ideal = 2.0 * quartiles.width() / std::cbrt(n);
  const double count =
      std::clamp(ideal > 0.0 ? std::round(range.width() / ideal) : 12.0, 8.0, 48.0);
  const double width = range.width() / count;
  std::vector<double> counts(static_cast<std::size_t>(count), 0.0);
  Bars bars;
  for (const double value : values) {
    const double bin = (value - range.lower) / width;
    if (!(bin >= 0.0) || bin > count) {
      ++bars.outside;
    } else {
      counts[std::min(static_cast<std::size_t>(bin), counts.size() - 1)] += 1.0;
    }
  }
  constexpr double gap = 0.03;  // of the width, at both sides of a bar
  for (std::size_t b = 0; b < counts.size(); ++b) {
    const double left = range.lower + (static_cast<double>(b) + gap) * width;
    bars.boxes.add(left, left + (1.0 - 2.0 * gap) * width, 0.0, counts[b]);
    bars.highest = std::max(bars.highest, counts[b]);
  }
  return bars;
}

std::vector<double> column(const std::vector<std::vector<double>>& rows, std::size_t slot,
                           double factor) {
  std::vector<double> values;
  for (const auto& row : rows) {
    if (slot < row.size()) values.push_back(row[slot] * factor);
  }
  return values;
}

double DensityGrid::at(double x_value, double y_value) const {
  if (rows.empty()) return 0.0;
  const double last = static_cast<double>(cells - 1);
  const double column_place = (x_value - x.lower) / (x.upper - x.lower) * last;
  const double row_place = (y_value - y.lower) / (y.upper - y.lower) * last;
  if (!(column_place >= 0.0 && column_place <= last && row_place >= 0.0 && row_place <= last)) {
    return 0.0;
  }
  const std::size_t c = std::min(static_cast<std::size_t>(column_place), cells - 2);
  const std::size_t r = std::min(static_cast<std::size_t>(row_place), cells - 2);
  const double right = column_place - static_cast<double>(c);
  const double up = row_place - static_cast<double>(r);
  return (1.0 - up) * ((1.0 - right) * rows[r][c] + right * rows[r][c + 1]) +
         up * ((1.0 - right) * rows[r + 1][c] + right * rows[r + 1][c + 1]);
}

DensityGrid density(const std::vector<double>& x, const std::vector<double>& y, plot::Range x_range,
                    plot::Range y_range) {
  DensityGrid grid;
  grid.x = x_range;
  grid.y = y_range;
  const double shrink = std::pow(static_cast<double>(x.size()), -1.0 / 6.0);
  const double x_width = robust_deviation(x) * shrink;
  const double y_width = robust_deviation(y) * shrink;
  if (!(x_width > 0.0) || !(y_width > 0.0)) return grid;
  grid.rows.assign(DensityGrid::cells, std::vector<double>(DensityGrid::cells, 0.0));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::vector<double> across = kernel(x[i], x_width, x_range);
    const std::vector<double> up = kernel(y[i], y_width, y_range);
    for (std::size_t r = 0; r < DensityGrid::cells; ++r) {
      for (std::size_t c = 0; c < DensityGrid::cells; ++c) grid.rows[r][c] += up[r] * across[c];
    }
  }
  double peak = 0.0;
  for (const auto& row : grid.rows)
    peak = std::max(peak, *std::max_element(row.begin(), row.end()));
  if (!(peak > 0.0)) {
    grid.rows.clear();
    return grid;
  }
  for (auto& row : grid.rows) {
    for (double& value : row) value /= peak;
  }
  return grid;
}

double density_level(const DensityGrid& grid, const std::vector<double>& x,
                     const std::vector<double>& y, double inside) {
  std::vector<double> at_points;
  for (std::size_t i = 0; i < x.size(); ++i) at_points.push_back(grid.at(x[i], y[i]));
  return plot::quantile_range(std::move(at_points), 1.0 - inside, 1.0).lower;
}

std::optional<plot::Contour> contour_around(const std::vector<double>& x,
                                            const std::vector<double>& y, plot::Range x_range,
                                            plot::Range y_range, double inside,
                                            plot::Stroke stroke) {
  DensityGrid grid = density(x, y, x_range, y_range);
  if (grid.rows.empty()) return std::nullopt;
  const double level = density_level(grid, x, y, inside);
  if (!(level > 0.0)) return std::nullopt;
  return plot::Contour{x_range, y_range, std::move(grid.rows), level, stroke};
}

}  // namespace recoil
