#pragma once

#include "uncertainty/uncertainty.hpp"

namespace recoil {

/// Refits `options.replicates` resampled data sets from the full fit's parameters.
///
/// Parametric where the noise is stated, e*_i = e_model,i + s sigma_i z with s the fit's
/// noise_scale; otherwise residual with leverage, e*_i = e_model,i + sigma_i rho with rho drawn
/// from the centred r_j / sqrt(1 - h_j) (Davison & Hinkley 1997, Bootstrap Methods and their
/// Application, section 6.2.3). A replicate is a pure function of (seed, replicate index). The
/// paper's two-point iteration runs on the same replicates.
BootstrapResult bootstrap(const FitResult& fitted, const Observations& data,
                          const std::vector<CaptureEstimate>& capture,
                          const std::vector<TwoPointResult>& two_point,
                          const UncertaintyOptions& options);

/// The estimates of all delete-one data sets [points][slots], for the acceleration of BCa. A set
/// whose refit fails gives an empty entry.
std::vector<std::vector<double>> jackknife(const FitResult& fitted, const Observations& data,
                                           int threads);

}  // namespace recoil
