#include "report/words_identifiability.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "report/format.hpp"
#include "report/words_intervals.hpp"

namespace recoil {
namespace {

using Sentences = std::vector<Sentence>;

/// "2.1 %", or "a factor of 3" where percents no longer make sense.
std::string known_to(double relative_sd) {
  constexpr double still_percent = 0.5;
  constexpr double still_known = 7.0;  // a factor of 1100
  if (!(relative_sd < still_known)) return "nothing at all";
  if (relative_sd < still_percent) return fmt::format("{:.2g} %", 100.0 * relative_sd);
  return fmt::format("a factor of {:.2g}", std::exp(relative_sd));
}

/// What stands in the way of one parameter, after its name.
std::string hindrance_words(const ParameterIdentifiability& found, const Interval& interval) {
  switch (*found.hindrance) {
    case Hindrance::no_interval:
      return "has no interval: " + missing_words(interval);
    case Hindrance::reaches_upper_bound:
      return "reaches its upper bound";
    case Hindrance::reaches_lower_bound:
      return "reaches its lower bound";
    case Hindrance::rests_on_bound:
      return "rests on its bound";
    case Hindrance::consistent_with_zero:
      return "is consistent with zero";
    case Hindrance::large_error:
      return fmt::format("is known only to {:.0f} %", 100.0 * found.relative_error);
    case Hindrance::uncertain_error:
      return fmt::format(
          "is known to {:.0f} % as it seems, but the noise is estimated, and it may be {:.0f} %",
          100.0 * found.relative_error, 100.0 * found.largest_relative_error);
    case Hindrance::undecided_noise:
    case Hindrance::wide_spread:
      break;  // sentences of their own
  }
  return "";
}

void describe_parameters(const FitResult& fitted, const UncertaintyResult& uncertainty,
                         Sentences& sentences) {
  const Identifiability& found = uncertainty.identifiability;
  Sentences not_trusted;
  bool anything_free = false;
  for (std::size_t j = 0; j < found.parameter.size(); ++j) {
    if (!fitted.model.slots[j].free) continue;
    anything_free = true;
    const ParameterIdentifiability& parameter = found.parameter[j];
    const Sentence label = symbol(fitted.model.slots[j].label());
    if (parameter.upper_limit) {
      sentences.push_back(
          say("{} is consistent with zero, and small: read its interval as an upper limit", label));
    }
    if (!parameter.hindrance) continue;
    if (parameter.hindrance == Hindrance::wide_spread) {
      not_trusted.push_back(label);
    } else if (parameter.hindrance == Hindrance::undecided_noise) {
      sentences.push_back(undecided_words(label, parameter.noise_factor));
    } else {
      const Interval& interval = recommended_interval(uncertainty.intervals[j]);
      sentences.push_back(say("{} {}", label, hindrance_words(parameter, interval)));
    }
  }
  if (!not_trusted.empty()) {
    sentences.push_back(wide_spread_words(join(not_trusted, " and of "), found.event_spread));
  }
  if (sentences.empty()) {
    sentences.emplace_back(anything_free ? "every free parameter is determined"
                                         : "nothing was free");
  }
}

void describe_correlations(const FitResult& fitted, const Identifiability& found,
                           Sentences& sentences) {
  for (const auto& [one, other, correlation] : found.correlated) {
    sentences.push_back(
        say("{} and {} can hardly be told from each other (correlation {:.3f}): quote "
            "their intervals together",
            symbol(fitted.model.slots[one].label()), symbol(fitted.model.slots[other].label()),
            correlation));
  }
  const auto& directions = found.information.directions;
  if (found.correlated.empty() || directions.size() < 2) return;
  sentences.push_back(
      say("the points determine {} to {}, but {} only to {}",
          direction_words(fitted, directions.front()), known_to(directions.front().relative_sd),
          direction_words(fitted, directions.back()), known_to(directions.back().relative_sd)));
}

/// How far the points reach down to the capture velocity, and what more of them would do.
void describe_reach(const FitResult& fitted, const Identifiability& found, Sentences& sentences) {
  if (found.slowest) {
    sentences.push_back(fmt::format(
        "the slowest impacts are at {:.2g} times the fitted capture velocity", *found.slowest));
  }
  // Without a covariance there is nothing from which a gain could be counted.
  if (!found.more_points || fitted.covariance.empty()) return;
  Sentences gains;
  for (const auto& [slot, now, then] : worthwhile_gains(found.information)) {
    gains.push_back(say("{} to {} instead of {}", symbol(fitted.model.slots[slot].label()),
                        known_to(then), known_to(now)));
  }
  if (gains.empty()) return;
  const PlannedPoints& plan = found.information.plans.front();
  const std::string above = plan.capture_velocity > 0.0
                                ? fmt::format(" ({:.3g} times the capture velocity)",
                                              plan.velocity / plan.capture_velocity)
                                : std::string();
  sentences.push_back(say("{} more points of {} at {:.3g} m/s{} would determine {}", plan.points,
                          diameter_sentence(plan.diameter), plan.velocity, above,
                          join(gains, ", ")));
}

Sentence words_of(Combination combination) {
  switch (combination) {
    case Combination::capture_velocity:
      return say("the capture velocity: {V*}{} ~ {V_a}{} ({C_A} + 2 {C_H})", exponent("2"),
                 exponent("3"));
    case Combination::adhesion_loss:
      return say("the loss to adhesion far above capture, {C_A} {f0}");
    case Combination::plateau_loss:
      return say("the loss of the fastest impacts, {C_H}");
  }
  return {};
}

}  // namespace

Sentence direction_words(const FitResult& fitted, const InformationDirection& direction) {
  constexpr double negligible = 0.05;
  Sentence product;
  for (std::size_t j = 0; j < direction.exponents.size(); ++j) {
    const double power = direction.exponents[j];
    if (std::abs(power) < negligible) continue;
    if (!product.empty()) product += " ";
    product += symbol(fitted.model.slots[j].label());
    if (std::abs(power - 1.0) >= 0.005) product += exponent(fmt::format("{:.2f}", power));
  }
  if (direction.meaning) product += say(" ({})", words_of(*direction.meaning));
  return product;
}

Sentence identifiability_words(const FitResult& fitted, const UncertaintyResult& uncertainty) {
  const Identifiability& found = uncertainty.identifiability;
  if (!found.assessed()) return {};
  Sentences sentences;
  describe_parameters(fitted, uncertainty, sentences);
  describe_correlations(fitted, found, sentences);
  describe_reach(fitted, found, sentences);
  return join(sentences, "; ") + ".";
}

std::vector<Sentence> uncertainty_warnings(const UncertaintyResult& uncertainty,
                                           const Observations& data) {
  Sentences warnings;
  const BootstrapResult& boot = uncertainty.bootstrap;
  if (boot.failed_often()) {
    warnings.emplace_back(
        failures_words(boot, data) +
        (boot.withheld() ? "; more than a tenth: the intervals from replicates are withheld" : ""));
  }
  const UncertaintyOptions& options = uncertainty.options;
  if (options.replicates_auto && boot.relative_error.value_or(0.0) > options.wanted_error) {
    warnings.push_back(fmt::format(
        "after {} replicates an interval's end is still uncertain by {:.1f} % of its width, more "
        "than the {:.1f} % wanted",
        boot.replicates, 100.0 * *boot.relative_error, 100.0 * options.wanted_error));
  }
  for (const CaptureEstimate& capture : uncertainty.capture) {
    const Sentence size = diameter_sentence(capture.diameter);
    if (!capture.found) {
      warnings.push_back(
          say("no capture velocity at {d} = {}: {}", size, missing_words(capture.interval)));
    } else if (capture.interval.note) {
      warnings.push_back(
          say("{d} = {}: {}", size, note_words(capture.interval, "the capture velocity")));
    }
  }
  return warnings;
}

}  // namespace recoil
