#pragma once

#include <vector>

#include "core/names.hpp"
#include "data/dataset.hpp"
#include "diagnosis/candidate_result.hpp"

namespace recoil {

struct SearchBase;

enum class UnstatedSource {
  velocity_errors,    ///< every incident velocity has the same relative error
  larger_deviations,  ///< all standard deviations are too small by the same factor
  shared_setting,     ///< all points of one setting of the apparatus share an error
  height_readings,    ///< every height of a rebound has the same error [m]
  time_readings,      ///< every time of flight has the same error [s]
};
constexpr auto names_of_values(UnstatedSource) {
  return name_list("velocity_errors", "larger_deviations", "shared_setting", "height_readings",
                   "time_readings");
}

/// Errors of the measurement beyond the stated ones that may explain the data instead of a cause.
struct UnstatedErrors {
  UnstatedSource source = UnstatedSource::velocity_errors;
  /// Relative sd of every velocity [1], factor on every standard deviation [1], sd of e that the
  /// points of a setting share [1], sd of every height [m] or time [s].
  double value = 0.0;
  double delta_aicc = 0.0;   ///< criterion minus that of the base model with the stated errors
  double remaining_p = 0.0;  ///< p-value of the structure, or of heavy tails, under these errors

  /// Are they errors of reading a scale with finite steps, which every such instrument has?
  bool of_readings() const {
    return source == UnstatedSource::height_readings || source == UnstatedSource::time_readings;
  }
  bool leave_nothing() const { return delta_aicc < 0.0 && remaining_p >= tolerated_level; }
};

/// Fits the base model with larger errors than stated, which may explain the misfit without a
/// cause. Returns none for Student's t. If no standard deviations are stated, their size follows
/// from the residuals, and only shared_setting is tested.
///
/// - velocity_errors: every incident velocity has the same relative error s, which matters most
///   where e is steep, close to capture. s minimises sum 2 ln sd_i + r_i^2 on a grid, refined by
///   the parabola through the best three points. Only if no velocity errors are stated.
/// - height_readings, time_readings: if every dataset states that its velocities come from heights
///   (or from times of flight), the height of every rebound, e^2 V^2 / 2g (or both times, 2 V / g
///   and 2 e V / g), has the same error s, which matters most for the smallest ones. s is found as
///   for velocities. The error of a drop height is an error of its setting.
/// - larger_deviations: all standard deviations are too small by the same factor, sqrt(chi^2 /
///   dof); the structure is then tested in residuals in units of their root mean square.
/// - shared_setting: the points of one setting (a column of the dataset; else equal series,
///   diameter and incident velocity) share an error of e of the same size at all settings; the
///   likelihood determines it from the scatter between settings compared with that within them.
///   Only if settings have several points.
///
/// The remaining structure is judged by the tests of the residuals and by their tails: if only a
/// few points are outlying, the stated errors of the others are right.
std::vector<UnstatedErrors> unstated_errors(const SearchBase& base);

/// The step [m] of which the heights of the rebounds are multiples, if `dataset` states that
/// velocities come from heights; 0 if it is none of 1, 2, 5 and 10 mm.
///
/// With h the mean height of one size and velocity, it is the largest step for which the mean of
/// cos(2 pi h / step) is above 0.9 over those below fifteen steps (for larger heights three printed
/// digits of V do not resolve it), with at least four of them. Chance gives this once in a thousand
/// data sets.
double height_step(const Dataset& dataset);

/// The largest step of several datasets.
double height_step(const std::vector<Dataset>& datasets);

}  // namespace recoil
