#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// Ways to an interval of a parameter, in the order in which they are shown.
enum class IntervalKind {
  wald,         ///< estimate and standard error
  profile,      ///< of the likelihood
  percentile,   ///< of the bootstrap
  bca,          ///< of the bootstrap, corrected for bias and acceleration
  studentized,  ///< bootstrap-t
};
template <>
struct NamesOf<IntervalKind> {
  static constexpr std::array<std::string_view, 5> names = {"wald", "profile", "percentile", "bca",
                                                            "studentized"};
};

/// How many ends of a profile interval the likelihood has set, and not a bound of the parameter.
enum class ProfileShape { bounded, one_sided, flat };
template <>
struct NamesOf<ProfileShape> {
  static constexpr std::array<std::string_view, 3> names = {"bounded", "one-sided", "flat"};
};

/// Why there is no interval.
enum class NoInterval {
  not_assessed,              ///< nothing was asked about uncertainty
  fixed,                     ///< the parameter was not fitted
  nothing_free,              ///< nothing was fitted
  no_standard_error,         ///< it rests on a bound, or the points do not determine it
  refit_failed,              ///< one along the profile, with the parameter held
  few_replicates,            ///< fewer than `fewest_replicates`
  few_delete_one_refits,     ///< fewer than three
  one_sided_replicates,      ///< all on one side of the estimate, as at a bound
  large_acceleration,        ///< too large for the level
  replicates_without_error,  ///< more than a tenth of them rest on a bound
  refits_failed,             ///< more than a tenth of them
  never_rebounds,            ///< a capture velocity: spheres of this size stay at any velocity
  never_captured,            ///< a capture velocity of spheres that always rebound
  no_covariance,             ///< the fit has no standard errors
  noise_unknown,             ///< neither stated nor to be estimated
  all_captured,              ///< a capture velocity where no sphere rebounded
};
template <>
struct NamesOf<NoInterval> {
  static constexpr std::array<std::string_view, 16> names = {
      "not_assessed",          "fixed",
      "nothing_free",          "no_standard_error",
      "refit_failed",          "few_replicates",
      "few_delete_one_refits", "one_sided_replicates",
      "large_acceleration",    "replicates_without_error",
      "refits_failed",         "never_rebounds",
      "never_captured",        "no_covariance",
      "noise_unknown",         "all_captured"};
};

/// The least number of replicates that have an interval: (B + 1) (1 - level) / 2 >= 1.
inline std::size_t fewest_replicates(double level) {
  return static_cast<std::size_t>(std::ceil(2.0 / (1.0 - level) - 1.0 - 1e-6));
}

/// The share of the replicates that have to answer where a band is drawn.
inline constexpr double share_for_band = 0.9;

/// The correlation beyond which two parameters are known together only.
inline constexpr double strong_correlation = 0.97;

/// In how many of 1000 data sets, simulated sphere by sphere, the interval of V* at a level of 95 %
/// contained the truth where every point averages over the sizes of its spheres: the smaller of
/// what was found with constants of the materials that are drawn (0.930) and exact (0.923)
/// (reports/coverage-designs.md, reports/coverage-designs-exact.md).
inline constexpr double mixed_capture_coverage = 0.92;

/// What has to be known beside the numbers of an interval.
enum class Caution {
  spans_both_bounds,  ///< the data do not limit this parameter
  begins_at_bound,    ///< an upper limit
  ends_at_bound,      ///< a lower limit
  undecided_noise,    ///< see `undecided`
  wide_spread,        ///< see `widest_spread`
  mixed_sizes,        ///< see `mixed_capture_coverage`
  model_rejected,     ///< the data reject the model from which the value follows
};
template <>
struct NamesOf<Caution> {
  static constexpr std::array<std::string_view, 7> names = {
      "spans_both_bounds", "begins_at_bound", "ends_at_bound", "undecided_noise",
      "wide_spread",       "mixed_sizes",     "model_rejected"};
};

struct IntervalNote {
  Caution caution = Caution::begins_at_bound;
  /// The bound, the factor between the errors, the spread of the impacts, a measured coverage, or
  /// the p-value of the fit.
  double value = 0.0;
};

/// [lower, upper] in the parameter's unit, or the reason why there is none.
struct Interval {
  std::optional<double> lower;
  std::optional<double> upper;
  std::optional<NoInterval> missing;  ///< why there is none
  std::optional<ProfileShape> shape;  ///< of a profile
  std::optional<IntervalNote> note;
  /// Monte-Carlo error of each end: its standard deviation over repetitions of the resampling with
  /// other seeds. None where nothing is random.
  std::optional<double> lower_error, upper_error;

  bool available() const { return lower.has_value() && upper.has_value(); }
  bool contains(double value) const { return available() && *lower <= value && value <= *upper; }
};

inline Interval no_interval(NoInterval why) {
  Interval interval;
  interval.missing = why;
  return interval;
}

/// Constants of the BCa interval (Efron 1987, JASA 82, 171-185).
struct BcaConstants {
  double bias = 0.0;          ///< z0 = Phi^-1( fraction of replicates below the estimate )
  double acceleration = 0.0;  ///< a = sum d^3 / (6 (sum d^2)^(3/2)), d = mean - delete-one value
};

/// One point of a profile likelihood.
struct ProfilePoint {
  double value = 0.0;    ///< of the parameter [its unit]
  double rise = 0.0;     ///< of chi2 over its minimum, the others refitted, in units of s^2 [1]
  double allowed = 0.0;  ///< the rise at which the interval would end here [1]
};

/// By which rule of `recommend` an interval is the one to quote.
enum class RecommendedBecause {
  noise_stated,     ///< the profile, under stated standard deviations
  noise_estimated,  ///< the profile, with Student's factor
  no_profile,       ///< the next best, for want of a profile
};
template <>
struct NamesOf<RecommendedBecause> {
  static constexpr std::array<std::string_view, 3> names = {"noise_stated", "noise_estimated",
                                                            "no_profile"};
};

/// Why the intervals of one parameter differ: which of them differ, and what the numbers show.
struct Disagreement {
  struct Difference {
    IntervalKind kind = IntervalKind::wald;
    double by = 0.0;  ///< of the recommended width [1]
  };
  /// Replicates that rest on a bound, of this parameter or of one that it is correlated with.
  struct OnBound {
    std::size_t slot = 0;
    double share = 0.0;        ///< of the replicates [1]
    double correlation = 0.0;  ///< with this parameter, where it is another one
  };
  struct Ridge {
    std::size_t partner = 0;  ///< slot
    double correlation = 0.0;
  };
  struct FewPoints {
    int dof = 0;
    double factor = 1.0;  ///< of Student's quantile over the normal one
  };

  std::vector<Difference> differing;
  bool estimate_at_bound = false;
  std::optional<OnBound> on_bound;
  std::optional<Ridge> ridge;
  std::optional<double> acceleration, bias;  ///< of BCa, where they are large
  std::optional<double> arms;  ///< how many times as far up as down the profile reaches, if skewed
  std::optional<FewPoints> few_points;

  bool skewed() const { return acceleration || bias || arms; }
  bool explained() const {
    return estimate_at_bound || on_bound || ridge || skewed() || few_points;
  }
};

/// Every interval of one parameter, at one level.
struct IntervalSet {
  PerValue<IntervalKind, Interval> of_kind;
  IntervalKind recommended = IntervalKind::wald;
  RecommendedBecause because = RecommendedBecause::no_profile;
  std::vector<ProfilePoint> profile_curve;   ///< empty unless `curves` were asked for
  std::optional<Disagreement> disagreement;  ///< none when the kinds agree
  std::optional<BcaConstants> bca_constants;
  std::optional<double> bound_share;  ///< of the usable replicates that rest on a bound [1]

  Interval& operator[](IntervalKind kind) { return of_kind[kind]; }
  const Interval& operator[](IntervalKind kind) const { return of_kind[kind]; }
};

inline const Interval& recommended_interval(const IntervalSet& set) { return set[set.recommended]; }

}  // namespace recoil
