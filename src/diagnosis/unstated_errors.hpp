#pragma once

#include <vector>

#include "core/names.hpp"
#include "data/dataset.hpp"
#include "diagnosis/candidate_result.hpp"

namespace recoil {

struct SearchBase;

enum class ErrorSource {
  velocity_errors,    ///< every incident velocity is uncertain by the same part of itself
  larger_deviations,  ///< all standard deviations are too small by the same factor
  shared_setting,     ///< all points of one setting of the apparatus have an error in common
  height_readings,    ///< every height of a rebound is uncertain by the same length
  time_readings,      ///< every time of flight is uncertain by the same time
};
template <>
struct NamesOf<ErrorSource> {
  static constexpr std::array<std::string_view, 5> names = {
      "velocity_errors", "larger_deviations", "shared_setting", "height_readings", "time_readings"};
};

/// Errors of the measurement beyond the stated ones that might do in place of a cause.
struct UnstatedErrors {
  ErrorSource source = ErrorSource::velocity_errors;
  /// Relative sd of every velocity [1], factor on every deviation [1], sd of e that the points of a
  /// setting share [1], sd of every height [m] or time [s].
  double value = 0.0;
  double delta_aicc = 0.0;   ///< criterion less that of the base model as stated
  double remaining_p = 0.0;  ///< of what is systematic, or of heavy tails, under them

  /// Of a scale with finite steps, which every instrument of the kind has.
  bool of_readings() const {
    return source == ErrorSource::height_readings || source == ErrorSource::time_readings;
  }
  bool leave_nothing() const { return delta_aicc < 0.0 && remaining_p >= tolerated_level; }
};

/// What the stated standard deviations say of the misfit if they are not taken at their word: the
/// base model fitted with larger errors, which is no cause but may do without one. Under Student's
/// t none; where no standard deviations are stated, as their size then follows the residuals, none
/// but shared_setting.
///
/// - velocity_errors: every incident velocity is uncertain by the same part s of itself, which
///   counts most where e is steep, close to capture. Of a grid of s, and the parabola through the
///   best three, the smallest sum 2 ln sd_i + r_i^2. Only where no velocity errors are stated.
/// - height_readings, time_readings: where every dataset says that its velocities come from heights
///   (or from times of flight), the height of every rebound, e^2 V^2 / 2g (both times, 2 V / g and
///   2 e V / g), is uncertain by the same s, which counts most for the lowest ones. Found as s is
///   for velocities. A drop is set on a mark; what it is off by is the setting's.
/// - larger_deviations: all standard deviations are too small by the same factor,
///   sqrt(chi^2 / dof); the structure is then sought in residuals in units of their own size.
///
/// - shared_setting: the points of one setting (a column of the dataset; else equal series,
/// diameter
///   and incident velocity) share an error of e of the same size at all settings, found by the
///   likelihood from what lies between settings beside what lies within them. Only where settings
///   have several points.
///
/// What is left is judged by the tests of the residuals and by their tails: where a few points are
/// far off, the rest is no worse than stated.
std::vector<UnstatedErrors> unstated_errors(const SearchBase& base);

/// To which the sphere of `point` rises in vacuum, e^2 V^2 / 2g [m].
double rebound_height(const ImpactPoint& point);

/// The step [m] on which the heights of the rebounds lie where `dataset` says that
/// velocities come from heights; 0 where they lie on none of 1, 2, 5 and 10 mm.
///
/// With h the mean height of one size and velocity, it is the largest step for which the mean of
/// cos(2 pi h / step) is above 0.9 over those below fifteen steps (higher up three printed digits
/// of V do not show it), four of them at least. By chance that happens once in a thousand data
/// sets.
double height_step(const Dataset& dataset);

/// The largest one of several.
double height_step(const std::vector<Dataset>& datasets);

}  // namespace recoil
