#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// The part that uncertain constants of the materials have in a fit.
struct ConstantsInFit {
  double square = 0.0;   ///< sum of their deviations from what is stated, in standard deviations
  double learned = 0.0;  ///< how many constants the points determine: trace of the points' hat
                         ///< matrix less the free parameters, from 0 to their number
};

/// @param run a fit whose last residuals are those of `count` constants that it moved
/// @param weight of them, Observations::constants_weight
ConstantsInFit constants_in_fit(const LeastSquaresResult& run, std::size_t count, double weight);

/// How far the points lie from a fit, in the measure that fits their distribution.
///
/// Where the noise is estimated, only means of rebounds count: counts of captures do not scatter
/// less when the standard deviations are larger. Uncertain constants of the materials are
/// observations that count where the standard deviations are stated: as many come as there are
/// parameters for them. An estimate of the noise is from the points alone, by restricted maximum
/// likelihood: sum r^2 / (points - trace of their hat matrix).
struct Misfit {
  double square = 0.0;  ///< sum of r^2; for Student's t sum of psi(r)^2 / E psi^2: both expect dof
  double point_square = 0.0;  ///< the part of the points
  double learned = 0.0;       ///< ConstantsInFit::learned
  int dof = 0;                ///< points less free parameters; captured points that the model also
                              ///< captures do not count, as they cannot scatter
  double p_value = 1.0;       ///< of `square` under the weights as they are; 1 without dof. For
                              ///< Student's t, see StudentNoise::p_value

  /// sqrt(point_square / (dof - learned)): what the weights are too small by; 1 without dof.
  double scale() const;
};

/// @param residuals of `weighted_residual`, [points]
/// @param predicted e^2 [points]
Misfit misfit(const Observations& data, std::span<const double> residuals,
              std::span<const double> predicted, int free_count,
              const ConstantsInFit& constants = {});

/// (J'J)^-1 of a fit to `data` as a covariance for weights that are right up to `noise_scale`.
std::vector<double> scaled_covariance(const Observations& data,
                                      const std::vector<double>& inverse_information,
                                      double noise_scale);

}  // namespace recoil
