#include "uncertainty/identifiability.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "estimate/point_conditions.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

constexpr double widest = 0.1;       // standard error relative to the scale of a parameter
constexpr double least_loss = 0.01;  // 1 - e^2 below which a point tells no scale
// Two parameters this correlated trade against each other over the whole of their errors.
constexpr double strong_correlation = 0.97;

/// For every slot the change that alone would make up the whole loss 1 - e^2 at the point that it
/// moves most: 1 / max_i |d ln(1 - e_i^2) / d theta_j| [slots]; 0 where nothing is moved.
std::vector<double> loss_scales(const FitResult& fitted) {
  std::vector<PointConditions> places;
  for (const Observation& point : fitted.data.points) {
    if (!point.censored) {
      places.push_back({point.dataset, point.diameter, point.velocity, point.series});
    }
  }
  std::vector<double> largest(fitted.theta.size(), 0.0);
  for (const Prediction& at : predict(fitted.model, fitted.theta, std::move(places), true)) {
    if (!at.usable()) continue;
    const double loss = std::max(1.0 - at.restitution_squared, least_loss);
    for (std::size_t j = 0; j < largest.size(); ++j) {
      largest[j] = std::max(largest[j], std::abs(at.gradient[j]) / loss);
    }
  }
  for (double& entry : largest) entry = entry > 0.0 ? 1.0 / entry : 0.0;
  return largest;
}

/// How much wider the errors are than normal ones, the noise having `dof` degrees of freedom.
double student_factor(int dof) {
  constexpr double level = 0.975;
  return dof > 0 ? gsl_cdf_tdist_Pinv(level, dof) / gsl_cdf_ugaussian_Pinv(level) : 1.0;
}

/// The standard error of slot j or, where it rests on a bound, what its interval says of one.
double error_of(const FitResult& fitted, std::size_t j, const Interval& interval) {
  constexpr double one_sided = 1.96;  // of a 95 % interval that begins at the bound
  if (fitted.std_error[j] > 0.0 || !interval.available()) return fitted.std_error[j];
  return (*interval.upper - *interval.lower) / one_sided;
}

/// @param error of the parameter, @param scale the size against which it counts
std::string obstacle(const FitResult& fitted, std::size_t j, const Interval& interval, double error,
                     double scale) {
  const ParameterSlot& slot = fitted.model.slots[j];
  if (!interval.available()) return "has no interval: " + interval.why;
  const bool low = *interval.lower <= slot.lower;
  if (*interval.upper >= slot.upper) return "reaches its upper bound";
  if (low && slot.lower != 0.0) return "reaches its lower bound";
  if (!(error > widest * scale)) return "";
  if (fitted.at_bound[j]) return "rests on its bound";
  return low ? "is consistent with zero"
             : fmt::format("is known only to {:.0f} %", 100.0 * error / std::abs(fitted.theta[j]));
}

/// "2.1 %", or "a factor of 3" where percents no longer make sense.
std::string known_to(double relative_sd) {
  constexpr double still_percent = 0.5;
  if (!std::isfinite(relative_sd)) return "nothing at all";
  if (relative_sd < still_percent) return fmt::format("{:.2g} %", 100.0 * relative_sd);
  return fmt::format("a factor of {:.2g}", std::exp(relative_sd));
}

void describe_correlations(const FitResult& fitted, const Information& information,
                           std::vector<std::string>& sentences) {
  const std::size_t p = fitted.theta.size();
  if (fitted.covariance.empty()) return;
  bool any = false;
  for (std::size_t a = 0; a < p; ++a) {
    for (std::size_t b = a + 1; b < p; ++b) {
      const double scale = fitted.std_error[a] * fitted.std_error[b];
      if (!(scale > 0.0)) continue;
      const double r = fitted.covariance[a * p + b] / scale;
      if (std::abs(r) < strong_correlation) continue;
      any = true;
      sentences.push_back(
          fmt::format("{} and {} can hardly be told apart (correlation {:.3f}): quote their "
                      "intervals together",
                      fitted.model.slots[a].label(), fitted.model.slots[b].label(), r));
    }
  }
  if (!any || information.directions.size() < 2) return;
  const InformationDirection& stiff = information.directions.front();
  const InformationDirection& sloppy = information.directions.back();
  sentences.push_back(fmt::format(
      "what the points do know is {}, to {}; what they hardly know is {}, to {}", stiff.words,
      known_to(stiff.relative_sd), sloppy.words, known_to(sloppy.relative_sd)));
}

/// How far the points reach down to the capture velocity, and what more of them would do.
void describe_reach(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                    const Information& information, bool wanting,
                    std::vector<std::string>& sentences) {
  double nearest = INFINITY;
  for (const CaptureEstimate& at : capture) {
    if (!at.found || !(at.value > 0.0)) continue;
    for (const Observation& point : fitted.data.points) {
      if (point.dataset == at.dataset && point.diameter == at.diameter) {
        nearest = std::min(nearest, point.velocity / at.value);
      }
    }
  }
  constexpr double close_enough = 1.5;  // inside it the rise of e separates adhesion from plateau
  const bool far = std::isfinite(nearest) && nearest > close_enough;
  if (far) {
    sentences.push_back(fmt::format(
        "the slowest impacts are at {:.2g} times the fitted capture velocity", nearest));
  }
  if (!(far || wanting) || information.plans.empty()) return;
  const PlannedPoints& plan = information.plans.front();
  std::vector<std::string> gains;
  constexpr double worth_a_word = 0.8;  // of the present error
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const double now = information.relative_sd[j];
    const double then = plan.relative_sd[j];
    if (!(now > 0.0) || !(then < worth_a_word * now)) continue;
    gains.push_back(fmt::format("of {} from {} to {}", fitted.model.slots[j].label(), known_to(now),
                                known_to(then)));
  }
  if (gains.empty()) return;
  const auto at = std::find_if(capture.begin(), capture.end(), [&](const CaptureEstimate& c) {
    return c.dataset == plan.dataset && c.diameter == plan.diameter;
  });
  sentences.push_back(fmt::format(
      "{} more points at d = {:.3g} um, V = {:.3g} m/s ({:.3g} times the capture velocity) would "
      "tell {}",
      plan.points, plan.diameter / units::um, plan.velocity, plan.velocity / at->value,
      fmt::join(gains, ", ")));
}

std::vector<CapturePlace> places_of(const std::vector<CaptureEstimate>& capture) {
  std::vector<CapturePlace> places;
  for (const CaptureEstimate& at : capture) {
    places.push_back({at.dataset, at.diameter, at.found ? at.value : 0.0});
  }
  return places;
}

}  // namespace

const Interval& recommended_interval(const IntervalSet& set) {
  if (set.recommended == "profile") return set.profile;
  if (set.recommended == "percentile") return set.percentile;
  if (set.recommended == "bca") return set.bca;
  if (set.recommended == "studentized") return set.studentized;
  return set.wald;
}

Identifiability judge_identifiability(const FitResult& fitted,
                                      const std::vector<IntervalSet>& intervals,
                                      const std::vector<CaptureEstimate>& capture,
                                      const std::vector<NoiseAlternative>& alternatives) {
  Identifiability result;
  std::vector<std::string> sentences, not_trusted;
  int free_count = 0;
  int good = 0;
  const std::vector<double> scales = loss_scales(fitted);
  const double widened = student_factor(fitted.data.sd_stated ? 0 : fitted.dof);
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    result.parameter.push_back(false);
    if (!slot.free) continue;
    ++free_count;
    const Interval& interval = recommended_interval(intervals[j]);
    const std::string problem =
        obstacle(fitted, j, interval, widened * error_of(fitted, j, interval),
                 std::max(std::abs(fitted.theta[j]), scales[j]));
    const double factor =
        alternatives.empty() ? 1.0 : undecided_factor(terms_of_slot(alternatives, j));
    if (problem.empty() && fitted.data.noise.event_spread > widest_spread) {
      not_trusted.push_back(slot.label());
    } else if (problem.empty() && factor > undecided) {
      sentences.push_back(undecided_words(slot.label(), factor));
    } else if (problem.empty()) {
      result.parameter.back() = true;
      ++good;
      if (*interval.lower <= slot.lower) {
        sentences.push_back(fmt::format(
            "{} is consistent with zero, and small: read its interval as an upper limit",
            slot.label()));
      }
    } else {
      sentences.push_back(fmt::format("{} {}", slot.label(), problem));
    }
  }
  if (!not_trusted.empty()) {
    sentences.push_back(wide_spread_words(fmt::format("{}", fmt::join(not_trusted, " and of ")),
                                          fitted.data.noise.event_spread));
  }
  result.verdict = good == free_count ? "identifiable" : good > 0 ? "partly" : "not_identifiable";
  if (free_count == 0) result.verdict = "identifiable";
  if (sentences.empty()) {
    sentences.push_back(free_count == 0 ? "nothing was free"
                                        : "every free parameter is determined");
  }
  result.information = information_at(fitted, places_of(capture));
  describe_correlations(fitted, result.information, sentences);
  describe_reach(fitted, capture, result.information, good < free_count, sentences);
  result.text = fmt::format("{}.", fmt::join(sentences, "; "));
  return result;
}

}  // namespace recoil
