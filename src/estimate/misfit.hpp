#pragma once

#include <span>
#include <vector>

#include "estimate/observations.hpp"

namespace recoil {

/// How far the points lie from a fit, in the measure that fits their distribution.
///
/// Where the noise is estimated, only means of rebounds count: counts of captures do not scatter
/// less when the standard deviations are larger.
struct Misfit {
  double square = 0.0;   ///< sum of r^2; for Student's t sum of psi(r)^2 / E psi^2: both expect dof
  int dof = 0;           ///< points less free parameters; captured points that the model also
                         ///< captures do not count, as they cannot scatter
  double p_value = 1.0;  ///< of `square` under the weights as they are; 1 without dof

  double scale() const;  ///< sqrt(square / dof): what the weights are too small by; 1 without dof
};

/// @param residuals of `weighted_residual`, [points]
/// @param predicted e^2 [points]
Misfit misfit(const Observations& data, std::span<const double> residuals,
              std::span<const double> predicted, int free_count);

/// (J'J)^-1 of a fit to `data` as a covariance for weights that are right up to `noise_scale`.
std::vector<double> scaled_covariance(const Observations& data,
                                      const std::vector<double>& inverse_information,
                                      double noise_scale);

}  // namespace recoil
