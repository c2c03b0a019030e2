#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "data/dataset.hpp"
#include "estimate/error_source.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/observation.hpp"

namespace recoil {

/// All points of all datasets of a fit, and what is stated about their errors. They do not change
/// after loading: a fit and a replicate have their own copy or their own `Weights`.
struct Observations {
  std::vector<Observation> points;
  StatedNoise noise;
  std::vector<const ErrorSource*> sources;  ///< those of `error_sources` that act on the points
  /// The observed values of ImpactModel::constants: empty for the stated ones, redrawn in a
  /// bootstrap replicate.
  std::vector<double> constants;

  /// The conditions of every point.
  std::vector<PointConditions> conditions() const;

  /// The points `indices` in that order, under the same noise and constants.
  Observations subset(std::span<const std::size_t> indices) const;

  /// Do points share an error in this way?
  bool share(SharedBy by) const;
  /// Do points share any error?
  bool share_errors() const;

  /// Do the weights depend on the parameters, so that `reweighted_fit` is needed?
  bool weights_depend_on_fit() const;
};

/// Marks the points in the range of velocities where spheres of their dataset and diameter both
/// rebound and stick: between the slowest point with a rebound and the fastest with a capture,
/// inclusive. Impacts differ from each other there, whether a row holds one of them or many. If the
/// rows of a size are single impacts, the range is the gap between its captures and its rebounds,
/// if there is one: the scatter of e next to the gap then shows how much impacts differ. [points]
std::vector<bool> among_captures(const std::vector<Observation>& points);

/// Collects the points of all datasets.
/// @param variance_place place of the variance function in the fit file, for the message
/// @throws InputError if `spec` requires stated standard deviations and a point has none
Observations gather(const std::vector<Dataset>& datasets, const NoiseSpec& spec = {},
                    const Location& variance_place = {});

/// The same with the noise of a fit file.
Observations gather(const std::vector<Dataset>& datasets, const FitSpec& spec);

}  // namespace recoil
