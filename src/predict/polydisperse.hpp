#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/numerics.hpp"  // log_spaced
#include "data/dataset.hpp"
#include "data/measured_sizes.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"

namespace recoil {

/// A treatment of captured spheres in a weighted average. Li, Dunn & Brach (1999) do not state
/// theirs.
struct CaptureConvention {
  std::string_view name;   ///< in CSV and JSON
  std::string_view words;  ///< what it does
};
inline constexpr std::array<CaptureConvention, 3> capture_conventions = {
    {{"captured_as_zero", "captured spheres count as e = 0"},
     {"captured_left_out", "captured spheres left out"},
     {"unseen_left_out", "spheres left out also when too slow to be seen"}}};

/// A predicted quantity at one velocity, with its pointwise band.
struct BandedValue {
  std::optional<double> value;  ///< nullopt if no sphere contributes to the average
  /// Nullopt without a bootstrap, or if fewer than 90 % of the replicates have a value.
  std::optional<double> lower, upper;
};

/// The value of the fit with the percentiles of the replicates; NaN: no value.
BandedValue banded(double value, std::vector<double> replicates, double level);

/// e(V) of one size, for the paper's Fig. 10.
struct SizeCurve {
  std::string_view name;            ///< "smallest", "d10" (the mean diameter) or "largest"
  double diameter = 0.0;            ///< [m]
  double capture_velocity = 0.0;    ///< [m/s]; 0 if none was found
  std::vector<double> restitution;  ///< [1], at the velocities of the prediction
};

/// The deviation of the points of the dataset from one curve.
struct CurveMiss {
  /// Root mean square of e - e_predicted over the points with a prediction [1].
  std::optional<double> rmse;
  std::size_t points = 0;  ///< number of these points
};

/// The response of a mixture of sizes under a fit.
struct PolydispersePrediction {
  std::size_t dataset = 0;
  MeasuredSizes sizes;
  double probe_height = 0.0;     ///< h of the measuring plane [m]
  double slowest_seen = 0.0;     ///< sqrt(2 g h) [m/s]
  double level = 0.95;           ///< level of the bands
  std::size_t simulated = 0;     ///< number of simulated sizes
  std::size_t replicates = 0;    ///< number of bootstrap replicates for the bands; 0: none
  std::vector<double> velocity;  ///< V [m/s], ascending
  std::array<std::vector<BandedValue>, capture_conventions.size()> average;  ///< mean e [1]
  std::vector<BandedValue> captured;  ///< captured fraction of the spheres [1]
  /// Fraction that is captured or too slow to reach the measuring plane [1].
  std::vector<BandedValue> unseen;
  std::vector<SizeCurve> size_curves;
  std::array<CurveMiss, capture_conventions.size()>
      miss;               ///< deviation of the three averages at the points of the dataset
  CurveMiss miss_single;  ///< the same for spheres of diameter d10
};

struct PolydisperseOptions {
  double probe_height = 1e-3;  ///< [m]: about 1 mm in Li, Dunn & Brach (1999), section 2
  double level = 0.95;
  int threads = 0;       ///< 0: all cores. Results do not depend on it.
  int velocities = 60;   ///< number of velocities, log-spaced
  int replicates = 499;  ///< largest number of replicates
  /// Number of sizes into which a bin of stated width is divided; 1 uses its mid-point, as Li, Dunn
  /// & Brach (1999) did, which makes the captured fraction a step function.
  int parts = 5;
};

/// Weighted averages over `sizes` with the parameters of a fit: with weights w_i and e_i = e(d_i,
/// V) of every bin, 0 for a capture,
///   captured_as_zero   sum w_i e_i / sum w_i,
///   captured_left_out  the same over the bins with e_i > 0,
///   unseen_left_out    the same over the bins with e_i V > sqrt(2 g h),
/// each at every velocity and for every bootstrap replicate (the band: its percentiles). f0 of
/// every size follows from eq. 12. Mechanisms of the measurement do not act, as they would include
/// sizes and slow rebounds twice.
///
/// The parameters are those of the fit, in which every point has the diameter stated in the
/// dataset.
PolydispersePrediction predict_mixture(const FitResult& fitted, std::size_t dataset,
                                       const BootstrapResult& bootstrap, const MeasuredSizes& sizes,
                                       const PolydisperseOptions& options = {});

}  // namespace recoil
