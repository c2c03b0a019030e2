#pragma once

#include <span>
#include <vector>

#include "estimate/capture_velocity.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {

/// The covariance of a fit `run` to data like those of `plan` [p x p], made in the same way for the
/// fit and for its replicates: from (J'J)^-1, or by the sandwich where the scheme allows for points
/// that scatter unequally (wild, case, cluster). Empty where there is none.
std::vector<double> replicate_covariance(const LeastSquaresResult& run, const Observations& data,
                                         const FitResult& fitted, const ResamplingPlan& plan);

/// That of the fit itself.
std::vector<double> reference_covariance(const FitResult& fitted, const ResamplingPlan& plan);

/// Standard errors [p]; zeros without a covariance.
std::vector<double> roots_of_diagonal(std::span<const double> covariance, std::size_t p);

/// The standard error of ln V* by its gradient; 0 where there is none.
double logarithmic_error(const CaptureVelocity& capture, std::span<const double> covariance);

}  // namespace recoil
