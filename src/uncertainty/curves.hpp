#pragma once

#include <span>
#include <string>
#include <vector>

#include "estimate/fit.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/two_point_comparison.hpp"

namespace recoil {

/// One curve e(V) of a diameter, with a pointwise band.
struct RestitutionCurve {
  std::size_t dataset = 0;
  std::string series;
  double diameter = 0.0;             ///< [m]
  std::vector<double> velocity;      ///< [m/s]
  std::vector<double> restitution;   ///< full fit [1]
  std::vector<double> lower, upper;  ///< band of the full fit [1]; empty without a bootstrap
  std::vector<double> two_point;     ///< the two-point calibration [1]; empty if it failed
  std::size_t series_number = PointConditions::no_series;  ///< index of `series` in its dataset
};

/// The replicates from which a band is computed.
struct BandSource {
  const std::vector<std::vector<double>>& theta;  ///< [count][slots]
  double level = 0.95;
  int threads = 0;  ///< 0: all cores. Results do not depend on it.
};

/// Completes a curve of which dataset, diameter and velocities are known: e, and its band unless
/// there are too few replicates.
void add_restitution(const ImpactModel& model, std::span<const double> theta,
                     const BandSource& band, RestitutionCurve& curve);

/// e(V) of every series from below capture (or the slowest point) to above the fastest point, with
/// the pointwise percentile band of the bootstrap and the two-point curve of its dataset.
/// @param two_point one per dataset, or none
std::vector<RestitutionCurve> restitution_curves(const FitResult& fitted,
                                                 const std::vector<Dataset>& datasets,
                                                 const std::vector<CaptureEstimate>& capture,
                                                 const std::vector<TwoPointComparison>& two_point,
                                                 const BandSource& band);

}  // namespace recoil
