#pragma once

#include <optional>
#include <vector>

#include "core/names.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/fit_alternatives.hpp"
#include "uncertainty/information.hpp"
#include "uncertainty/interval.hpp"

namespace recoil {

enum class IdentifiabilityVerdict { identifiable, partly, not_identifiable };
constexpr auto names_of_values(IdentifiabilityVerdict) {
  return name_list("identifiable", "partly", "not_identifiable");
}

/// The reason why a parameter is not identifiable.
enum class Hindrance {
  no_interval,
  reaches_upper_bound,
  reaches_lower_bound,
  rests_on_bound,
  consistent_with_zero,
  large_error,
  uncertain_error,  ///< the error is small, but may be large because the noise is estimated
  undecided_noise,  ///< its error depends on the variance function that is assumed
  wide_spread,      ///< the capture velocity scatters too much from impact to impact
};
constexpr auto names_of_values(Hindrance) {
  return name_list("no_interval", "reaches_upper_bound", "reaches_lower_bound", "rests_on_bound",
                   "consistent_with_zero", "large_error", "uncertain_error", "undecided_noise",
                   "wide_spread");
}

/// Largest standard error over the scale of a parameter that counts as well determined [1].
inline constexpr double widest_error = 0.1;

struct ParameterIdentifiability {
  bool identifiable = false;            ///< well determined on its own; false if it is not free
  std::optional<Hindrance> hindrance;   ///< nullopt if it is not free or well determined
  double relative_error = 0.0;          ///< standard error over the estimate [1]
  double largest_relative_error = 0.0;  ///< its upper 95 % limit if the noise is estimated [1]
  double loss_scale = 0.0;  ///< the change that would alone account for the loss, see below
  /// Ratio of its largest to its smallest error under the variance functions [1].
  double noise_factor = 1.0;
  bool upper_limit = false;  ///< identifiable, with an interval that begins at zero
};

/// Two parameters so correlated (`strong_correlation`) that only a combination is determined.
struct CorrelatedParameters {
  std::size_t one = 0, other = 0;  ///< slots
  double correlation = 0.0;
};

/// How well the data determine the parameters.
struct Identifiability {
  IdentifiabilityVerdict verdict = IdentifiabilityVerdict::not_identifiable;
  std::vector<ParameterIdentifiability> parameter;  ///< [slots]
  double event_spread = 0.0;  ///< relative scatter of V* from impact to impact [1]
  std::vector<CorrelatedParameters> correlated;
  Information information;  ///< the information of the points by direction
  /// The smallest ratio of impact velocity to capture velocity [1], if it is too large to determine
  /// the adhesion.
  std::optional<double> slowest;
  /// More points would help: the impacts are too far above capture, or a parameter is not well
  /// determined.
  bool more_points = false;

  bool assessed() const { return !parameter.empty(); }
};

/// A parameter counts as well determined when its recommended interval exists and its standard
/// error is below `widest_error` of the parameter's scale: the larger of its value and of the
/// change that would alone account for the loss 1 - e^2 at the most sensitive point. This scale
/// hardly depends on the noise. The value alone does, and so does the criterion that the interval
/// excludes zero: both select data sets in which the estimate is large by chance, or in which the
/// coverage differs from the level (reports/coverage-grid-*.md). A parameter so small that its
/// interval begins at zero can therefore be well determined; the interval is then an upper limit.
///
/// If the noise is estimated, the error may be small by chance. Therefore its upper 95 % limit
/// (chi-squared) must be below the limit. A parameter with a larger true error then counts as well
/// determined in at most one of twenty data sets; the coverage study tabulates how often. The
/// selection still depends on the noise, and the level of the interval holds over all data sets.
///
/// If the noise is estimated, the error must also not depend on the variance function: if it
/// differs by more than the factor `undecided` between functions that the points cannot
/// distinguish, the interval may be too narrow or too wide. The scatter of the capture velocity
/// from impact to impact must not exceed `widest_spread`.
/// @param alternatives of `fit_alternatives`; may be empty if the noise is stated
Identifiability judge_identifiability(const FitResult& fitted,
                                      const std::vector<IntervalSet>& intervals,
                                      const std::vector<CaptureEstimate>& capture,
                                      const std::vector<FitAlternative>& alternatives = {});

}  // namespace recoil
