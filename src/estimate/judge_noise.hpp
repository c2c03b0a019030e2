#pragma once

#include "estimate/fit.hpp"
#include "estimate/misfit.hpp"

namespace recoil {

/// Compares the scatter of the points with their standard deviations: sets the verdict, the noise
/// scale and the degrees of freedom.
void judge_noise(FitResult& result, const Misfit& misfit);

}  // namespace recoil
