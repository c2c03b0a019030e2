#pragma once

#include <cstddef>
#include <vector>

#include "data/dataset.hpp"

namespace recoil {

struct SearchBase;

/// A point that no smooth function of V and d explains.
struct OutlyingPoint {
  std::size_t index = 0;  ///< index of the observation
  std::size_t dataset = 0;
  int line = 0;           ///< line in the dataset's file of points
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  double restitution = 0.0;
  /// Deviation from the prediction by the other points, in standard deviations.
  double residual = 0.0;
};

/// Finds the points whose deviation from the prediction by the others is significant at 5 % for the
/// largest of all points (Bonferroni: |z| > 3.3 for 60 points).
///
/// The others predict a point by the base model, linear over its errors, and a smooth function of
/// ln V and ln d of any shape, so that a wrong model does not make points outlying. The residuals
/// are
///   r ~ N(0, s^2 (I + U U')),
/// where U has the columns of the Jacobian (with a wide prior), smooth discrepancies of e^2 with sd
/// 0.3, and for every diameter one with sd 1 proportional to (V_min / V)^2, the residual of a wrong
/// capture velocity. With C the covariance, the prediction of residual i from the others has the
/// error [C^-1 r]_i / [C^-1]_ii and the variance 1 / [C^-1]_ii (Rasmussen & Williams 2006, Gaussian
/// Processes for Machine Learning, eq. 5.12). The worst point is removed, and so on; at the end
/// each removed point is tested again against the remaining ones. s is 1.48 times the median of
/// |z|, at least 1 if standard deviations are stated: if all points scatter more than stated, no
/// single one is outlying. At most a fifth of the points can be outlying. `odd_point` is used if
/// there are too few points for smooth functions.
std::vector<OutlyingPoint> outlying_points(const SearchBase& base);

/// The datasets of a fit without these points.
std::vector<Dataset> without_points(std::vector<Dataset> datasets,
                                    const std::vector<OutlyingPoint>& outlying);

}  // namespace recoil
