#include "uncertainty/recommend.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "uncertainty/identifiability.hpp"

namespace recoil {
namespace {

constexpr double clear_difference = 0.15;  // of the recommended width
constexpr double many_at_bound = 0.05;
constexpr double strong_correlation = 0.97;
constexpr double coupled = 0.5;  // correlation at which another parameter's bound is felt
constexpr double clear_acceleration = 0.05;
constexpr double clear_bias = 0.15;
constexpr double clear_asymmetry = 1.25;
constexpr double clear_student = 1.1;

struct Kind {
  const char* name;
  const Interval& interval;
};

std::vector<Kind> available_kinds(const IntervalSet& set) {
  std::vector<Kind> kinds;
  for (const Kind& kind :
       {Kind{"Wald", set.wald}, Kind{"profile", set.profile}, Kind{"percentile", set.percentile},
        Kind{"BCa", set.bca}, Kind{"studentized", set.studentized}}) {
    if (kind.interval.available()) kinds.push_back(kind);
  }
  return kinds;
}

/// The larger distance of the two ends from those of `reference`, over its width, less what chance
/// can do (two Monte-Carlo errors).
double difference(const Interval& interval, const Interval& reference) {
  const double width = *reference.upper - *reference.lower;
  if (!(width > 0.0)) return 0.0;
  const double low =
      std::abs(*interval.lower - *reference.lower) -
      2.0 * (interval.lower_error.value_or(0.0) + reference.lower_error.value_or(0.0));
  const double high =
      std::abs(*interval.upper - *reference.upper) -
      2.0 * (interval.upper_error.value_or(0.0) + reference.upper_error.value_or(0.0));
  return std::max(low, high) / width;
}

/// Correlation of two free parameters; 0 where either has no error.
double correlation_of(const FitResult& fitted, std::size_t a, std::size_t b) {
  const double scale = fitted.std_error[a] * fitted.std_error[b];
  if (fitted.covariance.empty() || !(scale > 0.0)) return 0.0;
  return fitted.covariance[a * fitted.theta.size() + b] / scale;
}

std::string bound_reason(const FitResult& fitted, std::size_t slot,
                         const std::vector<IntervalSet>& sets) {
  if (fitted.at_bound[slot]) {
    return "the estimate rests on its bound, where the quadratic picture behind a standard error "
           "ends";
  }
  const double own = sets[slot].bound_share.value_or(0.0);
  if (own > many_at_bound) {
    return fmt::format("{:.0f} % of the replicates rest on a bound", 100.0 * own);
  }
  for (std::size_t j = 0; j < sets.size(); ++j) {
    const double share = sets[j].bound_share.value_or(0.0);
    const double r = j == slot ? 0.0 : correlation_of(fitted, slot, j);
    if (share <= many_at_bound || std::abs(r) <= coupled) continue;
    return fmt::format(
        "{:.0f} % of the replicates have {} on its bound, with which it is correlated ({:.2f})",
        100.0 * share, fitted.model.slots[j].label(), r);
  }
  return "";
}

std::string ridge_reason(const FitResult& fitted, std::size_t slot) {
  double largest = 0.0;
  std::size_t partner = slot;
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const double r = j == slot ? 0.0 : correlation_of(fitted, slot, j);
    if (std::abs(r) <= std::abs(largest)) continue;
    largest = r;
    partner = j;
  }
  if (std::abs(largest) <= strong_correlation) return "";
  return fmt::format("it trades along a ridge against {} (correlation {:.3f})",
                     fitted.model.slots[partner].label(), largest);
}

std::string skew_reason(const FitResult& fitted, std::size_t slot, const IntervalSet& set) {
  std::vector<std::string> signs;
  if (set.bca_constants) {
    if (std::abs(set.bca_constants->acceleration) > clear_acceleration) {
      signs.push_back(fmt::format("acceleration {:+.2g}", set.bca_constants->acceleration));
    }
    if (std::abs(set.bca_constants->bias) > clear_bias) {
      signs.push_back(fmt::format("bias z0 = {:+.2g}", set.bca_constants->bias));
    }
  }
  if (set.profile.available() && set.profile.shape == "bounded") {
    const double up = *set.profile.upper - fitted.theta[slot];
    const double down = fitted.theta[slot] - *set.profile.lower;
    if (down > 0.0 && (up / down > clear_asymmetry || down / up > clear_asymmetry)) {
      signs.push_back(fmt::format("the profile reaches {:.2g} times as far up as down", up / down));
    }
  }
  if (signs.empty()) return "";
  return fmt::format("the estimate's distribution is skewed ({})", fmt::join(signs, ", "));
}

std::string few_reason(const FitResult& fitted, bool sd_stated, double level) {
  if (sd_stated || fitted.dof <= 0) return "";
  const double p = 0.5 + level / 2.0;
  const double ratio = gsl_cdf_tdist_Pinv(p, fitted.dof) / gsl_cdf_ugaussian_Pinv(p);
  if (ratio <= clear_student) return "";
  return fmt::format(
      "with {} degrees of freedom the noise itself is uncertain, which only the Wald, profile and "
      "studentized intervals allow for (a factor of {:.2f})",
      fitted.dof, ratio);
}

}  // namespace

void recommend(IntervalSet& set, bool sd_stated) {
  if (set.profile.available()) {
    set.recommended = "profile";
    set.recommended_why =
        sd_stated
            ? "it follows the likelihood where that is not a parabola, stops at the bounds and "
              "takes the spread of the impacts along; in the coverage study it did no worse than "
              "the others"
            : "it follows the likelihood where that is not a parabola, stops at the bounds and "
              "knows by Student's factor how few points estimate the noise; intervals from "
              "replicates hold less often where two or three points near capture decide";
    return;
  }
  set.recommended = set.percentile.available() ? "percentile" : "wald";
  set.recommended_why = "the profile is not available: " + set.profile.why;
}

std::string explain_disagreement(const FitResult& fitted, std::size_t slot,
                                 const std::vector<IntervalSet>& sets, bool sd_stated,
                                 double level) {
  const IntervalSet& set = sets[slot];
  const Interval& reference = recommended_interval(set);
  if (!reference.available()) return "";
  std::vector<std::string> differing;
  for (const Kind& kind : available_kinds(set)) {
    const double by = difference(kind.interval, reference);
    if (by > clear_difference) {
      differing.push_back(fmt::format("{} by {:.0f} %", kind.name, 100.0 * by));
    }
  }
  if (differing.empty()) return "";
  std::vector<std::string> reasons;
  for (std::string reason :
       {bound_reason(fitted, slot, sets), ridge_reason(fitted, slot),
        skew_reason(fitted, slot, set), few_reason(fitted, sd_stated, level)}) {
    if (!reason.empty()) reasons.push_back(std::move(reason));
  }
  return fmt::format("{}: intervals differ from the {} one ({} of its width): {}",
                     fitted.model.slots[slot].label(), set.recommended, fmt::join(differing, ", "),
                     reasons.empty() ? "no bound, ridge, skew or lack of points explains it; look "
                                       "at the residuals"
                                     : fmt::format("{}", fmt::join(reasons, "; ")));
}

std::optional<double> bound_share(const BootstrapResult& boot, const ParameterSlot& slot,
                                  std::size_t index) {
  if (boot.theta.empty()) return std::nullopt;
  std::size_t resting = 0;
  for (const std::vector<double>& theta : boot.theta) {
    if (theta[index] <= slot.lower || theta[index] >= slot.upper) ++resting;
  }
  return static_cast<double>(resting) / static_cast<double>(boot.theta.size());
}

void note_bounds(Interval& interval, const ParameterSlot& slot) {
  if (!interval.available()) return;
  const bool low = *interval.lower <= slot.lower;
  const bool high = *interval.upper >= slot.upper;
  if (low && high) {
    interval.note = "it spans both bounds: the data do not limit this parameter";
  } else if (low) {
    interval.note =
        fmt::format("its lower end is the bound {:g}: read it as an upper limit", slot.lower);
  } else if (high) {
    interval.note =
        fmt::format("its upper end is the bound {:g}: read it as a lower limit", slot.upper);
  }
}

}  // namespace recoil
