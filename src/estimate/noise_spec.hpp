#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/names.hpp"

namespace recoil {

/// How the standard deviation of a measured e depends on the predicted one. Except for `stated`,
/// with one number s for all points, and n the rebounds that a point averages:
///   constant       sd = s / sqrt(n)
///   proportional   sd = s sqrt(e^2 + 0.1^2) / sqrt(n): relative noise, with a floor so that no
///                  point close to capture weighs without limit
///   capture        sd(e^2) = s / sqrt(n), that is sd = s / (2 e) far from capture and larger close
///                  to it: what comes of impacts that differ in the energy they lose
///   steep          sd = s exp(2 (V* / V)^2) / sqrt(n): sevenfold at capture, 7 % more at 5 V*, and
///                  so over a wider range than `capture`; V* to the first order in the damping
/// Constant, proportional and capture are the powers 0, 1 and -1 of the power-of-the-mean family,
/// steep an exponential of a variable of the design (both: Carroll & Ruppert 1988, Transformation
/// and Weighting in Regression, chapter 3).
enum class VarianceFunction { stated, constant, proportional, capture, steep };

template <>
struct NamesOf<VarianceFunction> {
  static constexpr std::array<std::string_view, 5> names = {"stated", "constant", "proportional",
                                                            "capture", "steep"};
};

/// The `[noise]` table of a fit file.
struct NoiseSpec {
  /// Empty for "auto": the stated standard deviations when every point has one, else whichever
  /// function the points ask for.
  std::optional<VarianceFunction> variance;

  bool student = false;      ///< `residuals = "student"`: Student's t instead of the normal
  double student_dof = 4.0;  ///< its degrees of freedom, at least 1

  /// Standard deviation of an error of e that the points of one setting share [1]; 0: none. Empty:
  /// estimated from the points, where settings are named or `every_setting` asks for it.
  std::optional<double> setting_sd;
  bool every_setting = false;  ///< also of settings that have no name: of equal series, diameter
                               ///< and velocity

  bool velocity_errors = true;        ///< use the velocity_sd of the points
  double velocity_relative_sd = 0.0;  ///< for points without one; 0: none
  bool diameter_errors = true;        ///< use the diameter_sd of the points
  double diameter_relative_sd = 0.0;  ///< for points without one; 0: none
};

}  // namespace recoil
