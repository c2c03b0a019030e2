#pragma once

#include <optional>
#include <vector>

#include "plot/plot.hpp"

/// How samples are spread, for pictures.
namespace recoil {

/// Bars of the Freedman-Diaconis width between two ends; values outside are counted.
struct Bars {
  plot::Boxes boxes;
  double highest = 0.0;
  std::size_t outside = 0;
};
Bars bars_of(const std::vector<double>& values, plot::Range range);

/// Entry `slot` of every row, times `factor`.
std::vector<double> column(const std::vector<std::vector<double>>& rows, std::size_t slot,
                           double factor);

/// A smooth density over the plane on a grid of `cells` x `cells` places between two ranges.
struct DensityGrid {
  static constexpr std::size_t cells = 40;
  plot::Range x, y;
  std::vector<std::vector<double>> rows;  ///< [y][x], 1 at the peak; empty without a spread

  /// Between the grid's places [same unit as rows]; 0 outside.
  double at(double x_value, double y_value) const;
};

/// Sum of Gaussian kernels about the points (x_i, y_i), as wide in each direction as Scott (1992),
/// Multivariate Density Estimation, proposes for two dimensions: sd n^(-1/6).
DensityGrid density(const std::vector<double>& x, const std::vector<double>& y, plot::Range x_range,
                    plot::Range y_range);

/// The density above which a share `inside` of the points lies.
double density_level(const DensityGrid& grid, const std::vector<double>& x,
                     const std::vector<double>& y, double inside);

/// The line around the densest places that hold a share `inside` of the points; none when there is
/// no such line.
std::optional<plot::Contour> contour_around(const std::vector<double>& x,
                                            const std::vector<double>& y, plot::Range x_range,
                                            plot::Range y_range, double inside,
                                            plot::Stroke stroke);

}  // namespace recoil
