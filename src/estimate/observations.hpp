#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/observation.hpp"

namespace recoil {

/// All points of all datasets of a fit, with their weights.
struct Observations {
  std::vector<Observation> points;
  Noise noise;
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
Observations gather(const std::vector<Dataset>& datasets, const Noise::Spec& spec = {},
                    const Location& variance_place = {});

/// The same with the noise of a fit file.
Observations gather(const std::vector<Dataset>& datasets, const FitSpec& spec);

}  // namespace recoil
