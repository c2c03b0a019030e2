#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// Kinds of interval of a parameter, in the order of display.
enum class IntervalKind {
  wald,         ///< estimate and standard error
  profile,      ///< profile likelihood
  percentile,   ///< bootstrap percentiles
  bca,          ///< bootstrap percentiles, corrected for bias and acceleration
  studentized,  ///< bootstrap-t
};
constexpr auto names_of_values(IntervalKind) {
  return name_list("wald", "profile", "percentile", "bca", "studentized");
}

/// How many ends of a profile interval the likelihood determines: both, one, or none. The others
/// are bounds of the parameter.
enum class ProfileShape { bounded, one_sided, flat };
constexpr auto names_of_values(ProfileShape) { return name_list("bounded", "one-sided", "flat"); }

/// The reason for a missing interval.
enum class NoInterval {
  not_assessed,              ///< no uncertainty was requested
  fixed,                     ///< the parameter was not fitted
  nothing_free,              ///< no parameter was fitted
  no_standard_error,         ///< the parameter rests on a bound, or the points do not determine it
  no_ends,                   ///< neither end of the profile was found, see `find_profile_end`
  no_lower_end,              ///< the lower end of the profile was not found
  no_upper_end,              ///< the upper end of the profile was not found
  end_at_estimate,           ///< an end is the estimate, which is not at a bound
  few_replicates,            ///< fewer than `fewest_replicates`
  few_delete_one_refits,     ///< fewer than three delete-one refits succeeded
  one_sided_replicates,      ///< all replicates lie on one side of the estimate, as at a bound
  large_acceleration,        ///< the BCa acceleration is too large for the level
  replicates_without_error,  ///< more than 10 % of the replicates rest on a bound
  refits_failed,             ///< more than 10 % of the refits failed
  never_rebounds,  ///< capture velocity: spheres of this size are captured at any velocity
  never_captured,  ///< capture velocity: spheres of this size always rebound
  no_covariance,   ///< the fit has no standard errors
  noise_unknown,   ///< the noise is not stated and cannot be estimated
  all_captured,    ///< capture velocity: no sphere rebounded
};
constexpr auto names_of_values(NoInterval) {
  return name_list("not_assessed", "fixed", "nothing_free", "no_standard_error", "no_ends",
                   "no_lower_end", "no_upper_end", "end_at_estimate", "few_replicates",
                   "few_delete_one_refits", "one_sided_replicates", "large_acceleration",
                   "replicates_without_error", "refits_failed", "never_rebounds", "never_captured",
                   "no_covariance", "noise_unknown", "all_captured");
}

/// The smallest number of replicates for an interval: (B + 1) (1 - level) / 2 >= 1.
inline std::size_t fewest_replicates(double level) {
  return static_cast<std::size_t>(std::ceil(2.0 / (1.0 - level) - 1.0 - 1e-6));
}

/// The share of the replicates that must have a value for a band to be drawn [1].
inline constexpr double share_for_band = 0.9;

/// The correlation above which only a combination of two parameters counts as determined [1].
inline constexpr double strong_correlation = 0.97;

/// Coverage of the 95 % interval of V* if every point averages over the sizes of its spheres, from
/// 1000 data sets simulated sphere by sphere: the smaller of two results, with drawn (0.930) and
/// with exact material constants (0.923) (reports/coverage-designs.md,
/// reports/coverage-designs-exact.md).
inline constexpr double mixed_capture_coverage = 0.92;

/// A caution that belongs to an interval.
enum class Caution {
  spans_both_bounds,  ///< the data do not limit this parameter
  begins_at_bound,    ///< an upper limit
  ends_at_bound,      ///< a lower limit
  undecided_noise,    ///< see `undecided`
  wide_spread,        ///< see `widest_spread`
  mixed_sizes,        ///< see `mixed_capture_coverage`
  model_rejected,     ///< the data reject the model that gives the value
};
constexpr auto names_of_values(Caution) {
  return name_list("spans_both_bounds", "begins_at_bound", "ends_at_bound", "undecided_noise",
                   "wide_spread", "mixed_sizes", "model_rejected");
}

struct IntervalNote {
  Caution caution = Caution::begins_at_bound;
  /// The number of the caution: the bound, the ratio of the errors, the spread of the impacts, a
  /// simulated coverage, or the p-value of the fit.
  double value = 0.0;
};

/// [lower, upper] in the parameter's unit, or the reason for a missing interval.
struct Interval {
  std::optional<double> lower;
  std::optional<double> upper;
  std::optional<NoInterval> missing;  ///< reason for a missing interval
  std::optional<ProfileShape> shape;  ///< shape of a profile interval
  std::optional<IntervalNote> note;
  /// Monte-Carlo error of each end: its standard deviation over repetitions of the resampling with
  /// other seeds. Nullopt if nothing is random.
  std::optional<double> lower_error, upper_error;

  bool available() const { return lower.has_value() && upper.has_value(); }
  bool contains(double value) const { return available() && *lower <= value && value <= *upper; }
};

inline Interval no_interval(NoInterval why) {
  Interval interval;
  interval.missing = why;
  return interval;
}

/// Was an end of this profile interval not found?
inline bool lacks_ends(const Interval& profile) {
  return profile.missing == NoInterval::no_ends || profile.missing == NoInterval::no_lower_end ||
         profile.missing == NoInterval::no_upper_end;
}

/// `interval`, or none if one of its ends is an estimate that is at neither bound.
inline Interval with_both_arms(Interval interval, double estimate, double lower, double upper) {
  const bool missing = interval.lower == estimate || interval.upper == estimate;
  if (missing && estimate > lower && estimate < upper) {
    return no_interval(NoInterval::end_at_estimate);
  }
  return interval;
}

/// Constants of the BCa interval (Efron 1987, JASA 82, 171-185).
struct BcaConstants {
  double bias = 0.0;          ///< z0 = Phi^-1( fraction of replicates below the estimate )
  double acceleration = 0.0;  ///< a = sum d^3 / (6 (sum d^2)^(3/2)), d = mean - delete-one value
};

/// One point of a profile likelihood.
struct ProfilePoint {
  double value = 0.0;  ///< value of the parameter [its unit]
  double rise = 0.0;   ///< increase of chi2 over its minimum with the other parameters refitted, in
                       ///< units of s^2 [1]
  double allowed = 0.0;  ///< the rise at which an interval ends at this value [1]
};

/// The differences between the intervals of one parameter, and their causes.
struct Disagreement {
  struct Difference {
    IntervalKind kind = IntervalKind::wald;
    double by = 0.0;  ///< largest difference of an end, over the recommended width [1]
  };
  /// Replicates at a bound of this parameter, or of one that is correlated with it.
  struct OnBound {
    std::size_t slot = 0;
    double share = 0.0;        ///< share of the replicates [1]
    double correlation = 0.0;  ///< correlation with this parameter, if it is another one
  };
  struct Ridge {
    std::size_t partner = 0;  ///< slot
    double correlation = 0.0;
  };
  struct FewPoints {
    int dof = 0;
    double factor = 1.0;  ///< ratio of Student's quantile to the normal one [1]
  };

  std::vector<Difference> differing;
  bool estimate_at_bound = false;
  std::optional<OnBound> on_bound;
  std::optional<Ridge> ridge;
  std::optional<double> acceleration, bias;  ///< constants of BCa, if they are large
  std::optional<double> arms;                ///< upper over lower arm of the profile, if skewed [1]
  std::optional<FewPoints> few_points;

  bool skewed() const { return acceleration || bias || arms; }
  bool explained() const {
    return estimate_at_bound || on_bound || ridge || skewed() || few_points;
  }
};

/// All intervals of one parameter, at one level.
struct IntervalSet {
  PerValue<IntervalKind, Interval> of_kind;
  IntervalKind recommended = IntervalKind::wald;
  bool student = false;  ///< the profile has Student's factor, as the noise is estimated
  std::vector<ProfilePoint> profile_curve;   ///< empty unless requested (`add_profile_curves`)
  std::optional<Disagreement> disagreement;  ///< nullopt if the kinds agree
  std::optional<BcaConstants> bca_constants;
  std::optional<double> bound_share;  ///< share of the usable replicates at a bound [1]

  Interval& operator[](IntervalKind kind) { return of_kind[kind]; }
  const Interval& operator[](IntervalKind kind) const { return of_kind[kind]; }
};

inline const Interval& recommended_interval(const IntervalSet& set) { return set[set.recommended]; }

}  // namespace recoil
