#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "uncertainty/interval.hpp"

namespace recoil {

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
