#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"

namespace recoil {

inline constexpr double summary_level = 0.95;  ///< level of every interval of a summary

/// A mean of e over the points of one series and diameter, or of one setting (a drop height) of it.
struct RestitutionMean {
  std::size_t dataset = 0;
  std::size_t series = 0;
  double diameter = 0.0;  ///< [m]
  /// Name of the setting; empty: the whole series, or a setting without name.
  std::string setting = {};
  std::optional<double> velocity;  ///< mean V of a setting [m/s]; nullopt: the whole series
  double value = 0.0;              ///< [1]
  std::optional<std::array<double, 2>> interval;  ///< nullopt: see `why`
  int points = 0;
  std::string why = {};
};

/// An effect that was tested against 0.
struct TestedEffect {
  std::optional<double> value;
  std::optional<std::array<double, 2>> interval;
  std::optional<double> p_value;
  std::string why = {};  ///< the reason for a missing value
};

/// A summary of e without a model of the impact.
///
/// - A mean is unweighted. Its interval is the wider of two: Student's t with the scatter of the
///   points, and the normal one with their stated errors. A stated error s of V that a setting
///   shares contributes e s / V once per setting.
/// - `velocity` is b of e = a_series + b log10 V, by least squares weighted with the stated errors
///   [1/decade]; its p-value is the larger of those from stated errors and from the scatter. If the
///   means of the settings scatter more about the line than their points explain (F-test at 5 %),
///   each mean counts as one reading.
/// - `bend` is the p-value of b = c = 0 in e = a_series + b log10 V + c (log10 V)^2, by the same
///   tests: near capture e rises and then falls, which a slope cannot show.
/// - `series` is the largest difference between two series at equal velocity, and the p-value is
///   that of all differences together (analysis of covariance).
struct RestitutionSummary {
  std::vector<RestitutionMean> means;  ///< every series, each followed by its settings
  TestedEffect velocity;
  TestedEffect series;
  std::optional<double> bend;             ///< nullopt: too few readings, or no errors
  std::array<double, 2> velocities = {};  ///< smallest and largest V of a rebound [m/s]
  std::array<double, 2> values = {};      ///< smallest and largest e of a rebound
  std::array<std::size_t, 2> most_different = {0, 0};  ///< indices into `means`
  bool several_series = false;
};

RestitutionSummary summarise_restitution(const std::vector<Dataset>& datasets);

}  // namespace recoil
