#pragma once

#include <cstddef>
#include <vector>

#include "data/dataset.hpp"

namespace recoil {

struct SearchBase;

/// A point that no smooth function of V and d explains.
struct OutlyingPoint {
  std::size_t index = 0;  ///< among the observations
  std::size_t dataset = 0;
  int line = 0;           ///< in the dataset's file of points
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  double restitution = 0.0;
  double residual = 0.0;  ///< from what the other points predict, in standard deviations
};

/// The points that lie further from what the others predict than scatter puts one of all of them in
/// one of twenty data sets (Bonferroni's bound: |z| > 3.3 of 60 points).
///
/// The others predict a point by the base model, linear over its errors, and a smooth function of
/// ln V and ln d of any shape, so that a wrong model accuses no point: residuals
///   r ~ N(0, s^2 (I + U U')),
/// U the columns of the Jacobian (of any size), smooth discrepancies of e^2 of 0.3, and for every
/// diameter one of 1 that falls like (V_min / V)^2, as a wrong capture velocity leaves it. Without
/// point i its residual is predicted with an error of [C^-1 r]_i / [C^-1]_ii and variance 1 /
/// [C^-1]_ii (Rasmussen & Williams 2006, Gaussian Processes for Machine Learning, eq. 5.12). The
/// worst point is taken out, and so on; at the end each is asked once more against the points that
/// stay. s is 1.48 times the median of |z|, but no less than 1 where standard deviations are
/// stated: where all points scatter more than that says, none is odd. At most a fifth of the points
/// are. Too few points for a smooth function are asked by `odd_point`.
std::vector<OutlyingPoint> outlying_points(const SearchBase& base);

/// The datasets of a fit without these points.
std::vector<Dataset> without_points(std::vector<Dataset> datasets,
                                    const std::vector<OutlyingPoint>& outlying);

}  // namespace recoil
