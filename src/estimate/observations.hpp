#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/observation.hpp"
#include "estimate/student.hpp"

namespace recoil {

/// One variance function fitted to the points, with its criterion.
struct VarianceCandidate {
  VarianceFunction function = VarianceFunction::constant;
  double scale = 0.0;              ///< s of the function, for a single impact [1]
  double criterion = 0.0;          ///< -2 ln restricted likelihood: smaller is better
  double event_spread = 0.0;       ///< NoiseModel::event_spread under this function
  std::vector<double> theta = {};  ///< the estimate under this function
};

/// The noise model that determines the weights of the points.
struct NoiseModel {
  VarianceFunction variance = VarianceFunction::stated;
  double scale = 0.0;  ///< s of the function, for a single impact [1]; 0 when stated
  /// All functions that were compared, if the function was chosen.
  std::vector<VarianceCandidate> candidates;
  /// Sd of the rounding of e, q / sqrt(12) if all readings are multiples of q = 0.1, 0.01, ...
  /// 1e-6; lower limit of an estimated sd [1]; 0: not rounded
  double rounding_sd = 0.0;
  double event_spread = 0.0;  ///< relative sd of the capture velocity from impact to impact; 0 if
                              ///< rebounds and captures do not overlap (`among_captures`)
  std::optional<StudentNoise> student;  ///< residuals are Student's t, not normal
  /// False: the noise is not stated and cannot be estimated, because the points do not scatter
  /// about the fit; there are then no standard errors and no tests.
  bool known = true;
  /// sd of the error of e that the points of one setting share, stated or estimated [1].
  double setting_sd = 0.0;
};

/// All points of all datasets of a fit, with their weights.
struct Observations {
  std::vector<Observation> points;
  bool sd_stated = true;  ///< false: the noise is estimated from the residuals
  NoiseSpec spec;
  NoiseModel noise;
  int sd_set_aside = 0;  ///< points whose stated standard deviation is not used
  int sd_missing = 0;    ///< points with rebounds that state no sd while others do
  /// The observed values of ImpactModel::constants: empty for the stated ones, redrawn in a
  /// bootstrap replicate.
  std::vector<double> constants;
  /// Weight of their deviations relative to the residuals of the points: noise_scale of the fit, so
  /// that they keep their own errors if those of the points are widened.
  double constants_weight = 1.0;

  /// The conditions of every point.
  std::vector<PointConditions> conditions() const;

  /// The points `indices` in that order, under the same noise, constants and weights.
  Observations subset(std::span<const std::size_t> indices) const;

  /// Is the error that the points of one setting share estimated from them? By default if a dataset
  /// names its settings and some have several points.
  bool setting_sd_estimated = false;
  /// Does a dataset state an error of V that the points of a setting share?
  bool setting_velocity_stated = false;
  /// Do the points of one setting share an error, stated or estimated?
  bool shares_settings() const {
    return setting_sd_estimated || setting_velocity_stated || spec.setting_sd.value_or(0.0) > 0.0;
  }
  /// Does a dataset state an error of d that the points of a series share?
  bool series_diameter_stated = false;
  /// Do successive bounces of a launch share timing errors?
  bool shares_instants = false;
  /// Do points share any error?
  bool shares_errors() const {
    return shares_settings() || series_diameter_stated || shares_instants;
  }

  /// Do the weights depend on the parameters, so that `reweighted_fit` is needed?
  bool weights_depend_on_fit() const;
};

/// Marks the points in the range of velocities where spheres of their dataset and diameter both
/// rebound and stick: between the slowest point with a rebound and the fastest with a capture,
/// inclusive. Impacts differ from each other there, whether a row holds one of them or many. If the
/// rows of a size are single impacts, the range is the gap between its captures and its rebounds,
/// if there is one: the scatter of e next to the gap then shows how much impacts differ. [points]
std::vector<bool> among_captures(const std::vector<Observation>& points);

/// Collects the points of all datasets. If the standard deviations are not stated (or not used),
/// the weights are a first guess, constant for every impact.
/// @param variance_place place of the variance function in the fit file, for the message
/// @throws InputError if `spec` requires stated standard deviations and a point has none
Observations gather(const std::vector<Dataset>& datasets, const NoiseSpec& spec = {},
                    const Location& variance_place = {});

/// The same with the noise of a fit file.
Observations gather(const std::vector<Dataset>& datasets, const FitSpec& spec);

}  // namespace recoil
