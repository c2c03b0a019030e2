#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// How far a fit that holds the constants of the materials goes when one of them is stated one
/// standard deviation higher, to first order:
///   d theta / d c = -(J'J)^-1 J' J_c,
/// J the derivatives of the residuals in the parameters that move, J_c those in the constant
/// (implicit differentiation of J'r = 0, without the second derivatives, as in Gauss-Newton).
/// @param run with the Jacobian and (J'J)^-1 at its end; @param points the number of its points
/// @return [constant][slot], in the units of the slots, the constant's own slot included; empty
///   where fits move the constants or all are exact, or without (J'J)^-1
std::vector<std::vector<double>> constant_effects(const ImpactModel& model,
                                                  const LeastSquaresResult& run,
                                                  std::size_t points);

/// Adds sum_k e_k e_k' of the effects e_k to `covariance` [slots x slots]: the errors of the
/// constants are independent of those of the points and of one another.
void add_constant_effects(const std::vector<std::vector<double>>& effects,
                          std::vector<double>& covariance, double sign = 1.0);

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
