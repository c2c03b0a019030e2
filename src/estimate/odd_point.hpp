#pragma once

#include <cstddef>
#include <optional>

#include "estimate/fit.hpp"

namespace recoil {

/// A point whose removal makes the model fit the others.
struct OddPoint {
  std::size_t index = 0;  ///< index of the observation
  /// Its deviation from the prediction of the others, in standard deviations.
  double residual = 0.0;
  FitResult without;  ///< the fit to the others
};

/// Finds the point whose removal makes a rejected fit acceptable. With residual r and leverage h,
/// its deviation from what the others predict is
/// - r / sqrt(1 - h) if standard deviations are stated,
/// - else the externally studentised r / (s_(i) sqrt(1 - h)) (Cook & Weisberg 1982, Residuals and
///   Influence in Regression, section 2.2).
///
/// Nullopt unless more than one degree of freedom is left without the point and the largest
/// deviation among all points is significant (Bonferroni), at 5 % if standard deviations are
/// stated, else at 1 %. If they are stated, the fit to all points must also be rejected at 5 % and
/// the fit to the others not.
std::optional<OddPoint> odd_point(const FitResult& fitted);

}  // namespace recoil
