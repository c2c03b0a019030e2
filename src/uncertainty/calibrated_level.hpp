#pragma once

#include <cstdint>
#include <vector>

#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/noise_alternatives.hpp"

namespace recoil {

struct CalibrationOptions {
  int simulations = 99;  ///< of data sets
  double level = 0.95;
  std::uint64_t seed = 20260101;
  int threads = 0;  ///< 0: all cores. No digit depends on it.
};

/// At which level the plain intervals of a fit have to be made so that they contain the truth as
/// often as they should: the prepivoted bootstrap (Beran 1987, Biometrika 74, 457-468; Loh 1987, J.
/// Am. Stat. Assoc. 82, 155-162). Data sets are simulated from the fit, each under one of the
/// variance functions that its points allow, drawn by weight, and fitted as the data were, the
/// choice of the variance function included. Of each, the level at which its own interval would
/// just contain the parameters that it was simulated with; the `level` quantile of these is the
/// answer.
struct CalibratedLevels {
  std::vector<double> parameters;  ///< [slots]; NaN where there is no profile
  std::vector<double> capture;     ///< in the order of the estimates; NaN where there is none
  int failed = 0;                  ///< simulated data sets without a fit
};

/// @param alternatives of `noise_alternatives`; the first is the fit
CalibratedLevels calibrate_levels(const std::vector<NoiseAlternative>& alternatives,
                                  const std::vector<CaptureEstimate>& capture,
                                  const CalibrationOptions& options);

}  // namespace recoil
