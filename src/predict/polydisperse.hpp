#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/json.hpp"
#include "data/dataset.hpp"
#include "data/measured_sizes.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"

namespace recoil {

/// What a weighted average does with spheres that do not come back. Li, Dunn & Brach (1999) do not
/// say which of these theirs is.
enum class CaptureConvention {
  captured_as_zero,   ///< a captured sphere counts with e = 0
  captured_left_out,  ///< the mean is that of the spheres that rebound
  unseen_left_out,    ///< and of those only that climb back to the measuring plane
};
/// Their names in CSV and JSON.
template <>
struct NamesOf<CaptureConvention> {
  static constexpr std::array<std::string_view, 3> names = {"captured_as_zero", "captured_left_out",
                                                            "unseen_left_out"};
};
inline constexpr std::array all_conventions = values_of<CaptureConvention>();

/// A predicted quantity at one velocity, with its pointwise band.
struct BandedValue {
  std::optional<double> value;         ///< nothing where no sphere is left to average
  std::optional<double> lower, upper;  ///< nothing without a bootstrap, or where fewer than nine in
                                       ///< ten replicates have a value
};

/// The value of the fit with the percentiles of the replicates; NaN: no value.
BandedValue banded(double value, std::vector<double> replicates, double level);

/// e of spheres of one size at every velocity, without errors of the measurement [1]; NaN where the
/// model has no answer.
std::vector<double> true_restitutions(const ImpactModel& model, std::span<const double> theta,
                                      std::size_t dataset, double diameter,
                                      const std::vector<double>& velocities);

/// `count` values from `first` to `last`, evenly spaced in their logarithm.
std::vector<double> log_spaced(double first, double last, int count);

/// A size of a mixture that has a curve of its own; d10 is the mean.
enum class NamedSize { smallest, d10, largest };
template <>
struct NamesOf<NamedSize> {
  static constexpr std::array<std::string_view, 3> names = {"smallest", "d10", "largest"};
};

/// e(V) of one size, for the paper's Fig. 10.
struct SizeCurve {
  NamedSize size = NamedSize::d10;
  double diameter = 0.0;            ///< [m]
  double capture_velocity = 0.0;    ///< [m/s]; 0 where none was found
  std::vector<double> restitution;  ///< [1], at the velocities of the prediction
};

/// How far the points of the dataset lie from one curve.
struct CurveMiss {
  std::optional<double> rmse;  ///< of e over the points with a prediction [1]
  std::size_t points = 0;      ///< how many these are
  RECOIL_FIELDS(rmse, points)
};

/// The response of a mixture of sizes under a fit.
struct PolydispersePrediction {
  std::size_t dataset = 0;
  MeasuredSizes sizes;
  double probe_height = 0.0;                        ///< h of the measuring plane [m]
  double slowest_seen = 0.0;                        ///< sqrt(2 g h) [m/s]
  double level = 0.95;                              ///< of the bands
  std::size_t simulated = 0;                        ///< how many sizes were simulated
  std::size_t replicates = 0;                       ///< of the bootstrap behind the bands; 0: none
  std::vector<double> velocity;                     ///< V [m/s], ascending
  std::array<std::vector<BandedValue>, 3> average;  ///< by convention: mean e [1]
  std::vector<BandedValue> captured;                ///< part of the spheres that stay [1]
  std::vector<BandedValue> unseen;  ///< part that stays or returns too slowly to be seen [1]
  std::vector<SizeCurve> size_curves;
  std::array<CurveMiss, 3> miss;  ///< of the three averages at the points of the dataset
  CurveMiss miss_single;          ///< of d10 alone, on the same footing
};

struct PolydisperseOptions {
  double probe_height = 1e-3;  ///< [m]: about 1 mm in Li, Dunn & Brach (1999), section 2
  double level = 0.95;
  int threads = 0;       ///< 0: all cores. No digit depends on it.
  int velocities = 60;   ///< log-spaced
  int replicates = 499;  ///< at most
  /// Into how many sizes a bin of stated width is divided; 1 takes its mid-point for all, as Li,
  /// Dunn & Brach (1999) did, which makes steps of the captures.
  int parts = 5;
};

/// Weighted averages over `sizes` with the parameters of a fit: with weights w_i and e_i = e(d_i,
/// V) of every bin, 0 for a capture,
///   captured_as_zero   sum w_i e_i / sum w_i,
///   captured_left_out  the same over the bins with e_i > 0,
///   unseen_left_out    the same over the bins with e_i V > sqrt(2 g h),
/// each at every velocity and for every bootstrap replicate (the band: its percentiles). f0 of
/// every size follows from eq. 12. Mechanisms of the measurement are left out, for they would count
/// sizes and slow rebounds twice.
///
/// The parameters are those of the fit as it stands, in which every point has the diameter that the
/// dataset gives it.
PolydispersePrediction predict_mixture(const FitResult& fitted, std::size_t dataset,
                                       const BootstrapResult& bootstrap, const MeasuredSizes& sizes,
                                       const PolydisperseOptions& options = {});

}  // namespace recoil
