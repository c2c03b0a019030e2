#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"
#include "estimate/weights.hpp"

namespace recoil {

/// The change of a fit with fixed material constants when one constant is one standard deviation
/// higher, to first order:
///   d theta / d c = -(J'J)^-1 J' J_c,
/// where J holds the derivatives of the residuals in the moving parameters and J_c those in the
/// constant (implicit differentiation of J'r = 0, without the second derivatives, as in
/// Gauss-Newton).
/// @param run the descent, with the Jacobian and (J'J)^-1 at its end
/// @param points number of its points
/// @return [constant][slot], in the units of the slots, including the constant's own slot; empty if
///   fits move the constants, if all are exact, or without (J'J)^-1
std::vector<std::vector<double>> constant_effects(const ImpactModel& model,
                                                  const LeastSquaresResult& run,
                                                  std::size_t points);

/// Adds sum_k e_k e_k' to `covariance` [slots x slots], with the effects e_k, as the errors of the
/// constants are independent of each other and of those of the points.
/// @param sign -1 subtracts them
void add_constant_effects(const std::vector<std::vector<double>>& effects,
                          std::vector<double>& covariance, double sign = 1.0);

/// The contribution of uncertain material constants to a fit.
struct ConstantsInFit {
  /// Sum of squares of their deviations from the stated values, in standard deviations.
  double square = 0.0;
  /// Number of constants that the points determine: trace of the points' hat matrix minus the
  /// number of free parameters, from 0 to the number of constants.
  double learned = 0.0;
};

/// @param run a fit whose last residuals are those of `count` constants that it moved
/// @param weight their weight, Noise::constants_weight
ConstantsInFit constants_in_fit(const LeastSquaresResult& run, std::size_t count, double weight);

/// The distance of the points from a fit, in the measure of their distribution.
///
/// If the noise is estimated, only means of rebounds count: the standard deviations do not affect
/// the scatter of counts of captures. If the standard deviations are stated, uncertain material
/// constants count as observations; they add as many observations as parameters. The noise is
/// estimated from the points alone, by restricted maximum likelihood: sum r^2 / (points - trace of
/// their hat matrix).
struct Misfit {
  double square = 0.0;  ///< sum of r^2; for Student's t sum of psi(r)^2 / E psi^2: the expectation
                        ///< of both is dof
  double point_square = 0.0;  ///< the part from the points, without the constants
  double learned = 0.0;       ///< ConstantsInFit::learned
  /// The expectation of `square`, without the constants: points minus free parameters. Captured
  /// points that the model also captures do not count, as they cannot scatter. If some
  /// points only count captures, counts add the mean of `count_moments`, and the spread of the
  /// impacts that they determine takes one away.
  double expected = 0.0;
  int dof = 0;  ///< `expected`, rounded
  /// Of `square` under the present weights; 1 without dof. With counts, `square` is taken as a
  /// multiple of chi-squared with its mean and variance (Satterthwaite 1946, Biometrics Bull. 2,
  /// 110). For pooled standard deviations see `pool_deviations`: it is F-distributed. For Student's
  /// t, see StudentNoise::p_value.
  double p_value = 1.0;

  /// sqrt(point_square / (expected - learned)): the factor by which the standard deviations are too
  /// small; 1 without dof.
  double scale() const;
};

/// @param residuals values of `weighted_residual` [points]
/// @param predicted predicted e^2 [points]
Misfit misfit(const Observations& data, const Weights& weights, std::span<const double> residuals,
              std::span<const double> predicted, int free_count,
              const ConstantsInFit& constants = {});

/// The covariance of a fit to `data` from its (J'J)^-1, for standard deviations that are too small
/// by the factor `noise_scale`.
std::vector<double> scaled_covariance(const Observations& data,
                                      const std::vector<double>& inverse_information,
                                      double noise_scale);

}  // namespace recoil
