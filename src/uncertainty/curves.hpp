#pragma once

#include "uncertainty/uncertainty.hpp"

namespace recoil {

/// e(V) of every series from below capture (or the slowest point) to above the fastest point, with
/// the pointwise percentile band of the bootstrap and the two-point curve of its dataset.
std::vector<RestitutionCurve> restitution_curves(const FitResult& fitted,
                                                 const std::vector<Dataset>& datasets,
                                                 const UncertaintyResult& so_far);

}  // namespace recoil
