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
  int launches = 0;  ///< of these points; 0: none is stated
  std::string why = {};
};

/// A setting (a drop height) or a launch whose points lie together apart from all others.
struct OutlyingBatch {
  std::size_t dataset = 0;
  std::size_t series = 0;
  bool launch = false;  ///< a launch; otherwise a setting
  std::string name;     ///< of the launch or setting
  int points = 0;
  double velocity = 0.0;    ///< mean V [m/s]
  double value = 0.0;       ///< e expected from the others [1]
  double difference = 0.0;  ///< mean e minus `value` [1]
  double p_value = 1.0;     ///< of the largest of all such differences
  /// Of drop heights: the height that the name of the setting states [m].
  std::optional<double> height;
  /// Of drop heights: (true - stated) / stated height that would explain the difference, to first
  /// order, as e by the curve falls or rises with V [1]. Without `height` it is that of V^2, which
  /// differs with drag.
  double height_error = 0.0;
};

/// The rebounds of one size: mean e at the slowest setting, at the fastest, and where it is
/// largest.
struct RestitutionRange {
  struct End {
    double velocity = 0.0, value = 0.0;  ///< mean V [m/s] and mean e [1] of a setting
    double error = 0.0;                  ///< of the mean, from the stated errors; 0: none
  };
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  End slowest, largest, fastest;
  std::size_t settings = 0;

  /// Is e larger between the ends than at both, by more than two standard errors?
  bool peaks() const;
};

/// An effect that was tested against 0.
struct TestedEffect {
  std::optional<double> value;
  std::optional<std::array<double, 2>> interval;
  std::optional<double> p_value;
  std::string why = {};  ///< the reason for a missing value
};

/// The scatter of points about the line of `RestitutionSummary::velocity`.
struct LineScatter {
  double ratio = 1.0;    ///< to the stated errors [1]
  double p_value = 1.0;  ///< of no more scatter than stated (chi-square)
};

/// A summary of e without a model of the impact.
///
/// - Diameters within a factor of 1.2 are one size.
/// - A mean is unweighted. Its interval is the wider of two: Student's t with the scatter of the
///   points, and the normal one with their stated errors. A stated error s of V that a setting
///   shares contributes e s / V once per setting. Successive bounces of a launch share instants,
///   and their errors have that covariance. From five launches on, the scatter is that of the sums
///   over launches (Cameron & Miller 2015, J. Hum. Resour. 50, 317-372), with one degree of freedom
///   less than launches.
/// - A point without a stated error counts with the median of the others.
/// - `velocity` is b of e = a_series + b log10 V, by least squares weighted with the stated errors
///   [1/decade]; its p-value is the larger of those from stated errors and from the scatter. If the
///   means of the settings scatter more about the line than their points explain (F-test at 5 %),
///   each mean counts as one reading. A series with several sizes has an a for each. Points that
///   share instants are weighted with their covariance; where they scatter more than stated, an
///   independent error is added to all. From five launches on, the scatter of `velocity` is that
///   between launches, as for a mean.
/// - `outlier` is the setting, or else the launch, of a series that differs most from
///   e = a + b V^q through all others of its series, if these agree (5 %), and if it differs (1 %,
///   times the number of means) with every q for which they agree: -1/2, -1/4, 0 (ln V), 1/5,
///   and 1. At least two degrees of freedom are left, so that five settings are needed. It is not
///   named if its V is farther than a factor of 1.1 from the others, or if something else is more
///   than 1/100 as likely: that another one is apart, or, for settings, that e has a kink (a yield
///   velocity). A kink explains the outermost setting, which is therefore not named. The error of a
///   mean is the larger of the stated one and that from the scatter within all of them; without
///   stated ones also that from its own scatter.
/// - `bend` is the p-value of b = c = 0 in e = a_series + b log10 V + c (log10 V)^2, by the same
///   tests: near capture e rises and then falls, which a slope cannot show.
/// - `series` is the largest difference between two series of one size at equal velocity, and the
///   p-value is that of all such differences together (analysis of covariance).
/// - With adhesion, e rises steeply from capture and then falls, so there are only `ranges`.
struct RestitutionSummary {
  std::vector<RestitutionMean> means;    ///< every series, each followed by its settings
  std::vector<RestitutionRange> ranges;  ///< every size of every dataset
  TestedEffect velocity;
  TestedEffect series;
  std::optional<double> bend;             ///< nullopt: too few readings, or no errors
  std::array<double, 2> velocities = {};  ///< smallest and largest V of a rebound [m/s]
  std::array<double, 2> values = {};      ///< smallest and largest e of a rebound
  std::array<std::size_t, 2> most_different = {0, 0};  ///< indices into `means`
  std::size_t rebounds = 0;                            ///< points with a rebound
  std::size_t without_error = 0;  ///< those of them that state no error, if others state one
  bool several_series = false;
  std::optional<OutlyingBatch> outlier;
  std::optional<LineScatter> scatter;  ///< nullopt: points state no errors, or too few points
};

/// @param adhesion does the model have adhesion?
RestitutionSummary summarise_restitution(const std::vector<Dataset>& datasets,
                                         bool adhesion = false);

}  // namespace recoil
