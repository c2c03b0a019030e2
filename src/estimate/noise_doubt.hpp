#pragma once

#include <vector>

#include "estimate/fit.hpp"

namespace recoil {

/// Why the errors of the points may be larger than the fit takes them to be. A data set that is
/// simulated at the estimate has none of these errors, so it cannot show how often intervals hold.
struct NoiseDoubt {
  enum class Cause {
    sd_of_few,       ///< stated sds may be computed from few impacts: `number` points
    unequal_scales,  ///< one scale is estimated for datasets that scatter differently: their ratio
    setting_velocity,  ///< the points of every setting have one velocity, whose error is not stated
    few_settings,      ///< `number` settings cannot determine the error that their points share
  };
  Cause cause = Cause::sd_of_few;
  double number = 0.0;
};

std::vector<NoiseDoubt> noise_doubts(const FitResult& fitted);

}  // namespace recoil
