#pragma once

#include <optional>

#include "estimate/fit.hpp"

namespace recoil {

/// ln of the density of the mean e, and of the probability of the counts, of a point where the
/// residual is 0: ln |dr / de| at `restitution_squared` for the scale of e, and the constant of the
/// normal density or of Student's t. 0 if only the sign of e^2 is known.
double log_peak_density(const Observation& point, const PointWeights& weights,
                        double restitution_squared,
                        const std::optional<StudentNoise>& student = std::nullopt);

/// -2 ln likelihood of the points at the fit, with all constants, so that fits with different
/// residual models are comparable:
///   sum r^2 + ln |R| - 2 sum ln p_0,
/// with the residuals r (for Student's t D instead of r^2), the correlations R of shared errors and
/// p_0 of `log_peak_density`. The squared deviations of uncertain material constants are added.
/// Binomial coefficients of the counts are omitted: they depend on the points alone.
/// @return nullopt for Student's t with captures, whose residuals do not belong to a density
std::optional<double> minus_two_log_likelihood(const FitResult& fitted);

}  // namespace recoil
