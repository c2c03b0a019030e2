#include "uncertainty/identifiability.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace recoil {
namespace {

// A parameter known to worse than a factor of two says little beyond its order of magnitude.
constexpr double widest = 0.5;  // standard error relative to the value
// Two parameters this correlated trade against each other over the whole of their errors.
constexpr double strong_correlation = 0.97;

std::string obstacle(const FitResult& fitted, std::size_t j, const Interval& interval) {
  const ParameterSlot& slot = fitted.model.slots[j];
  if (fitted.at_bound[j]) return "rests on its bound";
  if (!interval.available()) return "has no interval: " + interval.why;
  if (*interval.lower <= slot.lower) {
    return slot.lower == 0.0 ? "is consistent with zero" : "reaches its lower bound";
  }
  if (*interval.upper >= slot.upper) return "reaches its upper bound";
  if (fitted.std_error[j] > widest * std::abs(fitted.theta[j])) {
    return fmt::format("is known only to {:.0f} %",
                       100.0 * fitted.std_error[j] / std::abs(fitted.theta[j]));
  }
  return "";
}

void describe_correlations(const FitResult& fitted, std::vector<std::string>& sentences) {
  const std::size_t p = fitted.theta.size();
  if (fitted.covariance.empty()) return;
  for (std::size_t a = 0; a < p; ++a) {
    for (std::size_t b = a + 1; b < p; ++b) {
      const double scale = fitted.std_error[a] * fitted.std_error[b];
      if (!(scale > 0.0)) continue;
      const double r = fitted.covariance[a * p + b] / scale;
      if (std::abs(r) < strong_correlation) continue;
      sentences.push_back(fmt::format(
          "{} and {} trade against each other (correlation {:.3f}): quote their intervals together",
          fitted.model.slots[a].label(), fitted.model.slots[b].label(), r));
    }
  }
}

void describe_reach(const Observations& data, const std::vector<CaptureEstimate>& capture,
                    std::vector<std::string>& sentences) {
  double nearest = INFINITY;
  for (const CaptureEstimate& at : capture) {
    if (!at.found || !(at.value > 0.0)) continue;
    for (const Observation& point : data.points) {
      if (point.dataset == at.dataset && point.diameter == at.diameter) {
        nearest = std::min(nearest, point.velocity / at.value);
      }
    }
  }
  // 1.5 V*: inside it the shape of the rise separates the adhesion from the plateau (measured on
  // the expected information of log-spaced designs).
  constexpr double close_enough = 1.5;
  if (std::isfinite(nearest) && nearest > close_enough) {
    sentences.push_back(fmt::format(
        "the slowest impacts are at {:.2g} times the fitted capture velocity; points below {:.2g} "
        "times would tell most about the adhesion",
        nearest, close_enough));
  }
}

}  // namespace

const Interval& recommended_interval(const IntervalSet& set) {
  if (set.recommended == "profile") return set.profile;
  if (set.recommended == "percentile") return set.percentile;
  if (set.recommended == "bca") return set.bca;
  if (set.recommended == "studentized") return set.studentized;
  return set.wald;
}

Identifiability judge_identifiability(const FitResult& fitted, const Observations& data,
                                      const std::vector<IntervalSet>& intervals,
                                      const std::vector<CaptureEstimate>& capture) {
  Identifiability result;
  std::vector<std::string> sentences;
  int free_count = 0;
  int good = 0;
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    result.parameter.push_back(false);
    if (!slot.free) continue;
    ++free_count;
    const std::string problem = obstacle(fitted, j, recommended_interval(intervals[j]));
    if (problem.empty()) {
      result.parameter.back() = true;
      ++good;
    } else {
      sentences.push_back(fmt::format("{} {}", slot.label(), problem));
    }
  }
  result.verdict = good == free_count ? "identifiable" : good > 0 ? "partly" : "not_identifiable";
  if (free_count == 0) result.verdict = "identifiable";
  if (sentences.empty()) {
    sentences.push_back(free_count == 0 ? "nothing was free"
                                        : "every free parameter is determined");
  }
  describe_correlations(fitted, sentences);
  describe_reach(data, capture, sentences);
  result.text = fmt::format("{}.", fmt::join(sentences, "; "));
  return result;
}

}  // namespace recoil
