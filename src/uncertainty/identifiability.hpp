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
  model_rejected,   ///< the points contradict the model: its errors hold only if the model does
  uncertain_error,  ///< the error is small, but may be large because the noise is estimated
  undecided_noise,  ///< its error depends on the variance function that is assumed
  wide_spread,      ///< the capture velocity scatters too much from impact to impact
};
constexpr auto names_of_values(Hindrance) {
  return name_list("no_interval", "reaches_upper_bound", "reaches_lower_bound", "rests_on_bound",
                   "consistent_with_zero", "large_error", "model_rejected", "uncertain_error",
                   "undecided_noise", "wide_spread");
}

/// Largest error over the value of a parameter that counts as well determined [1].
inline constexpr double widest_error = 0.1;

struct ParameterIdentifiability {
  bool identifiable = false;            ///< well determined on its own; false if it is not free
  std::optional<Hindrance> hindrance;   ///< nullopt if it is not free or well determined
  double relative_error = 0.0;          ///< error of its interval over the estimate [1]
  double largest_relative_error = 0.0;  ///< its upper 95 % limit if the noise is estimated [1]
  /// Ratio of its largest to its smallest error under the variance functions [1].
  double noise_factor = 1.0;
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
  bool rejected = false;                            ///< `judge_model`: the model does not fit
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

/// A parameter counts as well determined when the model fits (`judge_model`), its recommended
/// interval excludes both bounds, and its error is at most `widest_error` of its value. The error
/// is that of the interval: half its width over the normal quantile.
///
/// If the noise is estimated, the error may be small by chance. Therefore the upper 95 % limit of
/// the standard error (chi-squared) must be below the limit, too. The criterion selects data sets
/// with a large estimate or a small error; the level of the interval holds over all data sets, and
/// the coverage study tabulates how often a parameter with a larger true error is called well
/// determined.
///
/// If the noise is estimated, the error must also not depend on the variance function: if it
/// differs by more than the factor `undecided` between functions that the points cannot
/// distinguish, the interval may be too narrow or too wide. The scatter of the capture velocity
/// from impact to impact must not exceed `widest_spread`.
/// @param level of `intervals`
/// @param alternatives of `fit_alternatives`; may be empty if the noise is stated
Identifiability judge_identifiability(const FitResult& fitted,
                                      const std::vector<IntervalSet>& intervals,
                                      const std::vector<CaptureEstimate>& capture, double level,
                                      const std::vector<FitAlternative>& alternatives = {});

}  // namespace recoil
