#pragma once

#include <cstddef>
#include <optional>

#include "estimate/fit.hpp"

namespace recoil {

/// A point without which the others fit.
struct OddPoint {
  std::size_t index = 0;  ///< among the observations
  double residual = 0.0;  ///< from what the others predict, in standard deviations
  FitResult without;      ///< the fit to the others
};

/// The point whose removal mends a fit. None unless more than one degree of freedom is left without
/// it, and it lies further from what the others predict than one of all points does in one of
/// twenty data sets (Bonferroni), by its residual r and leverage h: r / sqrt(1 - h) where standard
/// deviations are stated, else the externally studentised r / (s_(i) sqrt(1 - h)) (Cook & Weisberg
/// 1982, Residuals and Influence in Regression, section 2.2), at one of a hundred. Where they are
/// stated, the fit to all has to be rejected at 5 %, and the fit to the others not.
std::optional<OddPoint> odd_point(const FitResult& fitted);

}  // namespace recoil
