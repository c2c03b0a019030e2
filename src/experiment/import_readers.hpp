#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/import.hpp"

/// One reader per format; what they hand on is the same.
namespace recoil {

/// A point as imported, SI.
struct ImportedPoint {
  std::string series;
  std::optional<double> diameter;          ///< [m]; nothing when the file does not say
  double velocity = 0.0;                   ///< [m/s]
  std::optional<double> restitution;       ///< [1]; nothing when all were captured
  std::optional<double> rebound_velocity;  ///< [m/s], instead of it
  std::optional<double> restitution_sd, velocity_sd, diameter_sd;
  std::optional<double> events, captured;
  int line = 0;  ///< in the file
};

struct ImportedPoints {
  std::vector<ImportedPoint> points;
  std::vector<std::string> notes;
};

/// WebPlotDigitizer's CSV: names of the series in the first line, each over two columns, X and Y in
/// the second; or, for one series, nothing but two columns of numbers. With `axes` and
/// `reading_error` f (part of an axis), the standard deviations are
///   f (max - min) on a linear axis,   V f ln(max / min) on a logarithmic one.
ImportedPoints read_digitised(const ImportRequest& request);

/// e = sqrt(h2 / h1), V = sqrt(2 g h1) without air;
/// sd(e) = (e/2) sqrt((s1/h1)^2 + (s2/h2)^2), sd(V) = (V/2) s1/h1. With `average`, drops from the
/// same height make one point: the mean e, its standard error from their scatter, and s1 once.
ImportedPoints read_heights(const ImportRequest& request);

/// Flights of duration t between bounces: a ball that leaves with v is back after t = 2 v / g and
/// hits with v again, so that V = g t_i / 2 and e = t_{i+1} / t_i at the bounce between them. With
/// an error tau of the time of one bounce
///   sd(e) = (tau / t_i) sqrt(1 + e + e^2) sqrt(2),   sd(V) = g tau / sqrt(2).
/// The release height, where it is given, is compared with what the first two flights say of it.
ImportedPoints read_intervals(const ImportRequest& request);

/// Any table: quantities as a dataset has them.
/// @param package_map entries for columns that the dataset to be replaced already knows
ImportedPoints read_columns(const ImportRequest& request,
                            const std::vector<std::string>& package_map);

/// --gravity [m/s2]. @throws InputError
double gravity_of(const ImportRequest& request);

}  // namespace recoil
