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

/// One variance function as fitted to the points, and how well it does.
struct VarianceCandidate {
  VarianceFunction function = VarianceFunction::constant;
  double scale = 0.0;              ///< s of the function, for a single impact [1]
  double criterion = 0.0;          ///< -2 ln restricted likelihood: smaller is better
  double event_spread = 0.0;       ///< NoiseModel::event_spread under it
  std::vector<double> theta = {};  ///< the parameters under it
};

/// What weights the points of a fit.
struct NoiseModel {
  VarianceFunction variance = VarianceFunction::stated;
  double scale = 0.0;  ///< s of the function, for a single impact [1]; 0 when stated
  std::vector<VarianceCandidate> candidates;  ///< all that were tried, when it was chosen
  /// Of the rounding of the readings of e, q / sqrt(12) where all are multiples of q = 0.1, 0.01
  /// ... (as far as 1e-6): no estimated sd is below it [1]; 0: not rounded
  double rounding_sd = 0.0;
  double event_spread = 0.0;  ///< relative sd of the capture velocity from impact to impact; 0
                              ///< where no point has both rebounds and captures
  std::optional<StudentNoise> student;  ///< residuals are Student's t, not normal
  bool known = true;  ///< false: neither stated nor to be estimated, as nothing scatters about the
                      ///< fit; then there are no errors and nothing can be tested
  double setting_sd = 0.0;  ///< of the error of e that the points of one setting share, as stated
                            ///< or estimated [1]
};

/// All points of all datasets of a fit, ready to be fitted.
struct Observations {
  std::vector<Observation> points;
  bool sd_stated = true;  ///< false: the noise is estimated from the residuals
  NoiseSpec spec;
  NoiseModel noise;
  int sd_set_aside = 0;  ///< points whose stated standard deviation is not used
  int sd_missing = 0;    ///< points with rebounds that state none where others do
  /// The stated values of ImpactModel::constants, which are observations, too: empty for those of
  /// the model, others in a bootstrap replicate.
  std::vector<double> constants;
  /// What their deviations weigh beside the residuals of the points: noise_scale of the fit, so
  /// that they keep their own errors when those of the points are widened.
  double constants_weight = 1.0;

  /// Those of every point.
  std::vector<PointConditions> conditions() const;

  /// The points `indices` in that order, under the same noise, constants and weights.
  Observations subset(std::span<const std::size_t> indices) const;

  /// Is the error that the points of one setting share to be estimated from them? By default where
  /// a dataset names its settings and some have several points.
  bool setting_sd_estimated = false;
  /// Is an error of V that the points of a setting share stated?
  bool setting_velocity_stated = false;
  /// Do the points of one setting share an error, stated or estimated?
  bool shares_settings() const {
    return setting_sd_estimated || setting_velocity_stated || spec.setting_sd.value_or(0.0) > 0.0;
  }
  /// Is an error of d that the points of a series share stated?
  bool series_diameter_stated = false;
  /// Are there successive bounces of one launch, timed at the same instants?
  bool shares_instants = false;
  /// Do points share any error?
  bool shares_errors() const {
    return shares_settings() || series_diameter_stated || shares_instants;
  }

  /// Must the weights be found together with the parameters?
  bool weights_depend_on_fit() const;
};

/// Which points lie where spheres of their dataset and diameter both rebound and stick: between the
/// slowest point with a rebound and the fastest with a capture, these included. Impacts differ
/// there, whether a row holds one of them or many. Of a size whose rows are single impacts, the
/// gap between its captures and its rebounds, where there is one: how much impacts differ then
/// shows in the scatter of e beside it.
std::vector<bool> among_captures(const std::vector<Observation>& points);

/// Flattens the datasets. Where the standard deviations are not stated (or not to be used) the
/// weights are a first guess, one constant for every impact.
/// @param variance_place where a fit file names the variance function, for the message
/// @throws InputError when `spec` insists on stated standard deviations and a point has none.
Observations gather(const std::vector<Dataset>& datasets, const NoiseSpec& spec = {},
                    const Location& variance_place = {});

/// The same as a fit file has it.
Observations gather(const std::vector<Dataset>& datasets, const FitSpec& spec);

}  // namespace recoil
