#pragma once

#include <optional>
#include <vector>

#include "core/names.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/information.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/noise_alternatives.hpp"

namespace recoil {

enum class IdentifiabilityVerdict { identifiable, partly, not_identifiable };
template <>
struct NamesOf<IdentifiabilityVerdict> {
  static constexpr std::array<std::string_view, 3> names = {"identifiable", "partly",
                                                            "not_identifiable"};
};

/// What stands in the way of a parameter.
enum class Hindrance {
  no_interval,
  reaches_upper_bound,
  reaches_lower_bound,
  rests_on_bound,
  consistent_with_zero,
  large_error,
  uncertain_error,  ///< small, but as the noise is estimated it may be large
  undecided_noise,  ///< its error depends on the variance function that is assumed
  wide_spread,      ///< the capture velocity scatters too much from impact to impact
};
template <>
struct NamesOf<Hindrance> {
  static constexpr std::array<std::string_view, 9> names = {
      "no_interval",     "reaches_upper_bound",  "reaches_lower_bound",
      "rests_on_bound",  "consistent_with_zero", "large_error",
      "uncertain_error", "undecided_noise",      "wide_spread"};
};

/// Standard error over the scale of a parameter that counts as well determined, at most.
inline constexpr double widest_error = 0.1;

struct ParameterIdentifiability {
  bool identifiable = false;            ///< on its own; false where it is not free
  std::optional<Hindrance> hindrance;   ///< none where it is not free
  double relative_error = 0.0;          ///< standard error over the estimate [1]
  double largest_relative_error = 0.0;  ///< its upper 95 % limit, the noise being estimated [1]
  double loss_scale = 0.0;              ///< what alone would make up the whole loss, see below
  double noise_factor = 1.0;            ///< between its errors under the variance functions
  bool upper_limit = false;             ///< identifiable though its interval begins at zero
};

/// Two parameters that trade against each other over the whole of their errors.
struct CorrelatedParameters {
  std::size_t one = 0, other = 0;  ///< slots
  double correlation = 0.0;
};

/// What the data can tell about the parameters.
struct Identifiability {
  IdentifiabilityVerdict verdict = IdentifiabilityVerdict::not_identifiable;
  std::vector<ParameterIdentifiability> parameter;  ///< [slots]
  double event_spread = 0.0;  ///< relative scatter of V* from impact to impact [1]
  std::vector<CorrelatedParameters> correlated;
  Information information;  ///< what the points know, direction by direction
  /// The slowest impacts over the capture velocity [1], where they are too far from it.
  std::optional<double> slowest;
  bool more_points = false;  ///< would they help?

  bool assessed() const { return !parameter.empty(); }
};

/// A parameter counts as well determined when its recommended interval exists and its standard
/// error is below `widest_error` of the parameter's scale: the larger of its value and of what
/// alone would make up the whole loss 1 - e^2 at the point that it moves most. That scale hardly
/// depends on the luck of an estimate. Its value alone would, and so would asking whether the
/// interval is clear of zero: both pick the data sets in which the parameter came out large, or in
/// which the interval contains the truth more often than promised (reports/coverage-grid-*.md). A
/// parameter so small that its interval begins at zero can therefore be well determined; it is then
/// an upper limit.
///
/// Where the noise is estimated, so is the error, and a lucky one must not make a parameter
/// well determined: it is the upper 95 % limit of the error (chi-squared) that has to be below the
/// limit. So a parameter whose actual error is above it is called well determined in one of twenty
/// data sets at most; how often it is stands in the tables of the coverage study. Which data sets
/// are called so still depends on their noise, and the interval's level is that over all data sets.
///
/// Where the noise is estimated, its error must not depend on the variance function, either: where
/// it differs by more than `undecided` between functions that the points cannot decide between, the
/// interval may be too narrow or too wide.
/// Nor may the capture velocity scatter by more than `widest_spread` from impact to impact.
/// @param alternatives of `noise_alternatives`; may be left out where the noise is stated
Identifiability judge_identifiability(const FitResult& fitted,
                                      const std::vector<IntervalSet>& intervals,
                                      const std::vector<CaptureEstimate>& capture,
                                      const std::vector<NoiseAlternative>& alternatives = {});

}  // namespace recoil
