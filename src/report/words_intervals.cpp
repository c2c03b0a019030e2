#include "report/words_intervals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/catalogue.hpp"
#include "mechanism/mechanism.hpp"
#include "report/format.hpp"
#include "uncertainty/noise_alternatives.hpp"

namespace recoil {
namespace {

Sentence bound_words(const Disagreement& found, const FitResult& fitted, std::size_t slot) {
  if (found.estimate_at_bound) {
    return "the estimate rests on its bound, where the likelihood is not a parabola and a standard "
           "error says nothing";
  }
  if (!found.on_bound) return {};
  const auto& [other, share, correlation] = *found.on_bound;
  if (other == slot) return say("{:.0f} % of the replicates rest on a bound", 100.0 * share);
  return say(
      "{:.0f} % of the replicates have {} on its bound, with which it is correlated ({:.2f})",
      100.0 * share, symbol(fitted.model.slots[other].label()), correlation);
}

std::string skew_words(const Disagreement& found) {
  std::vector<std::string> signs;
  if (found.acceleration) {
    signs.push_back(fmt::format("acceleration {:+.2g}", *found.acceleration));
  }
  if (found.bias) signs.push_back(fmt::format("bias z0 = {:+.2g}", *found.bias));
  if (found.arms) {
    signs.push_back(fmt::format("the profile reaches {:.2g} times as far up as down", *found.arms));
  }
  return fmt::format("the estimate's distribution is skewed ({})", fmt::join(signs, ", "));
}

const char* what_it_does(Scheme scheme) {
  switch (scheme) {
    case Scheme::parametric:
      return "new noise of the fit's size is drawn about the fitted curve";
    case Scheme::residual:
      return "the fit's own residuals, scaled for leverage and centred, are exchanged among the "
             "points";
    case Scheme::wild:
      return "each point keeps its own residual, scaled for leverage (HC3), with a random sign";
    case Scheme::cases:
      return "whole points are drawn with replacement, captured ones with the others";
    case Scheme::cluster:
      return "whole series are drawn with replacement, with all their points";
    case Scheme::automatic:
      break;
  }
  return "";
}

std::string suspect_words(const FailedReplicates::Suspect& suspect, Scheme scheme,
                          const Observations& data) {
  const Observation& point = data.points[suspect.point];
  const std::string place = fmt::format("point {} (d = {}, V = {:.4g} m/s)", suspect.point + 1,
                                        diameter_words(point.diameter), point.velocity);
  const bool counted = scheme == Scheme::cases || scheme == Scheme::cluster;
  return counted ? fmt::format("{} is drawn {:.2g} times instead of {:.2g}", place,
                               suspect.failed + 1.0, suspect.usual + 1.0)
                 : fmt::format("{} is moved by {:+.2g} standard deviations instead of {:+.2g}",
                               place, suspect.failed, suspect.usual);
}

}  // namespace

std::string words_of(IntervalKind kind) {
  switch (kind) {
    case IntervalKind::wald:
      return "Wald";
    case IntervalKind::bca:
      return "BCa";
    case IntervalKind::profile:
    case IntervalKind::percentile:
    case IntervalKind::studentized:
      break;
  }
  return to_string(kind);
}

std::string missing_words(const Interval& interval) {
  if (interval.available()) return "";
  if (!interval.missing) return "not computed";
  switch (*interval.missing) {
    case NoInterval::not_assessed:
      return "no uncertainty was assessed";
    case NoInterval::fixed:
      return "the parameter is fixed";
    case NoInterval::nothing_free:
      return "nothing was free in this fit";
    case NoInterval::no_standard_error:
      return "no standard error (at a bound, or not determined)";
    case NoInterval::refit_failed:
      return "a constrained refit along the profile failed";
    case NoInterval::few_replicates:
      return fmt::format("fewer than {} usable replicates", fewest_replicates);
    case NoInterval::few_delete_one_refits:
      return "fewer than three delete-one refits succeeded";
    case NoInterval::one_sided_replicates:
      return "all replicates lie on one side of the estimate, as at a bound";
    case NoInterval::large_acceleration:
      return "the acceleration is too large for this level: the delete-one fits differ too much";
    case NoInterval::replicates_without_error:
      return "more than a tenth of the replicates rest on a bound and have no error";
    case NoInterval::refits_failed:
      return "withheld: more than a tenth of the refits failed, and those that did not are not a "
             "fair sample";
    case NoInterval::never_rebounds:
      return "spheres of this size never rebound under the fit";
    case NoInterval::never_captured:
      return "nothing is captured under the fit";
    case NoInterval::no_covariance:
      return "the fit has no standard errors";
  }
  return "";
}

Sentence note_words(const Interval& interval, const Sentence& what) {
  if (!interval.note) return {};
  const double value = interval.note->value;
  switch (interval.note->caution) {
    case Caution::spans_both_bounds:
      return "it spans both bounds: the data do not limit this parameter";
    case Caution::begins_at_bound:
      return say("its lower end is the bound {:g}: read it as an upper limit", value);
    case Caution::ends_at_bound:
      return say("its upper end is the bound {:g}: read it as a lower limit", value);
    case Caution::undecided_noise:
      return undecided_words(what, value);
    case Caution::wide_spread:
      return wide_spread_words(what, value);
    case Caution::mixed_sizes:
      return say(
          "take the interval of {} as too narrow: every point averages over spheres of many sizes, "
          "and of such intervals {:.0f} % contained the truth in a simulation where 95 % should",
          what, 100.0 * value);
  }
  return {};
}

std::string recommended_words(const IntervalSet& set) {
  switch (set.because) {
    case RecommendedBecause::noise_stated:
      return "it follows the likelihood where that is not a parabola, stops at the bounds and "
             "allows for the spread of the impacts; in the coverage study it did no worse than the "
             "others";
    case RecommendedBecause::noise_estimated:
      return "it follows the likelihood where that is not a parabola, stops at the bounds and "
             "allows by Student's factor for the small number of points that estimate the noise; "
             "intervals from replicates contain the truth less often where two or three points "
             "near capture decide";
    case RecommendedBecause::no_profile:
      return "the profile is not available: " + missing_words(set[IntervalKind::profile]);
  }
  return "";
}

std::string recommended_words(const CaptureEstimate& capture) {
  if (!capture.because) return "";
  switch (*capture.because) {
    case CaptureBecause::no_delta:
      return missing_words(capture[CaptureIntervalKind::delta]);
    case CaptureBecause::at_bound:
      return "a parameter rests on its bound, which the delta method does not take into account";
    case CaptureBecause::bend:
      return "the noise is stated, and the replicates follow the bend of V* in the parameters, "
             "which the delta method takes as linear";
    case CaptureBecause::no_percentiles:
      return "there are no percentiles: " + missing_words(capture[CaptureIntervalKind::percentile]);
    case CaptureBecause::spread_estimated:
      return "its error allows for the spread of the impacts, which is estimated as well";
    case CaptureBecause::noise_estimated:
      return "it allows for the small number of points that estimate the noise, and is averaged "
             "over the variance functions that they leave open";
  }
  return "";
}

Sentence disagreement_words(const FitResult& fitted, std::size_t slot, const IntervalSet& set) {
  if (!set.disagreement) return {};
  const Disagreement& found = *set.disagreement;
  std::vector<std::string> differing;
  for (const auto& [kind, by] : found.differing) {
    differing.push_back(fmt::format("{} by {:.0f} %", words_of(kind), 100.0 * by));
  }
  std::vector<Sentence> reasons;
  if (Sentence bound = bound_words(found, fitted, slot); !bound.empty()) {
    reasons.push_back(std::move(bound));
  }
  if (found.ridge) {
    reasons.push_back(say("it trades along a ridge against {} (correlation {:.3f})",
                          symbol(fitted.model.slots[found.ridge->partner].label()),
                          found.ridge->correlation));
  }
  if (found.skewed()) reasons.emplace_back(skew_words(found));
  if (found.few_points) {
    reasons.push_back(say(
        "with {} degrees of freedom the noise itself is uncertain, which only the Wald, profile "
        "and studentized intervals allow for (a factor of {:.2f})",
        found.few_points->dof, found.few_points->factor));
  }
  if (reasons.empty()) {
    reasons.emplace_back(
        "no bound, ridge, skew or lack of points explains it; look at the residuals");
  }
  return say("{}: intervals differ from the {} one ({} of its width): {}",
             symbol(fitted.model.slots[slot].label()), words_of(set.recommended),
             fmt::format("{}", fmt::join(differing, ", ")), join(reasons, "; "));
}

Sentence undecided_words(const Sentence& what, double factor) {
  return say(
      "the error of {} differs by a factor of {:.1f} between ways in which the scatter may grow "
      "towards capture, and the points cannot tell which is right, so that its interval may be too "
      "narrow or too wide: state standard deviations, or measure more points",
      what, factor);
}

/// The mechanism that describes several sizes in one point.
static std::string_view mechanism_of_sizes() {
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    if (mechanism.info.mixes_sizes) return mechanism.info.id;
  }
  return "";
}

Sentence wide_spread_words(const Sentence& what, double event_spread) {
  return say(
      "the interval of {} is not to be trusted: from impact to impact the capture velocity "
      "scatters by {:.0f} %, and what is assumed of the survivors is good up to {:.0f} %; if one "
      "point averages over spheres of several sizes, sort them into size classes (recoil pair "
      "--size-edges), or fit their spread (mechanisms = [\"{}\"])",
      what, 100.0 * event_spread, 100.0 * widest_spread, mechanism_of_sizes());
}

std::string scheme_words(const BootstrapResult& bootstrap) {
  std::string text;
  switch (bootstrap.because) {
    case SchemeBecause::asked_for:
      text = "asked for";
      break;
    case SchemeBecause::sd_stated:
      text = "every point states its standard deviation";
      break;
    case SchemeBecause::sd_not_stated:
      text = "no standard deviations are stated, so the scatter need not be equal everywhere";
      break;
    case SchemeBecause::no_residuals:
      text = "no point rebounded, so there are no residuals";
      break;
  }
  text += fmt::format(": {}", what_it_does(bootstrap.scheme));
  constexpr std::size_t few = 10;
  if (bootstrap.scheme == Scheme::cluster && bootstrap.series < few) {
    text += fmt::format("; {} series are few for that: intervals come out too narrow",
                        bootstrap.series);
  }
  return text;
}

std::string failure_message(const FailedReplicates& failures) {
  return failures.undetermined ? "its points do not determine all free parameters"
                               : failures.message;
}

std::string failures_words(const BootstrapResult& bootstrap, const Observations& data) {
  const FailedReplicates& failures = bootstrap.failures;
  if (failures.index.empty()) return "";
  std::vector<std::string> unlike;
  for (const FailedReplicates::Suspect& suspect : failures.suspects) {
    if (!unlike.empty() && !suspect.clearly_unlike) continue;
    unlike.push_back(suspect_words(suspect, bootstrap.scheme, data));
  }
  if (unlike.empty()) unlike.emplace_back("no point stands out");
  return fmt::format("{} of {} refits failed; in them {}. The first is replicate {} (seed {}): {}",
                     failures.index.size(), bootstrap.replicates, fmt::join(unlike, "; "),
                     failures.index.front(), bootstrap.seed, failure_message(failures));
}

std::string held_out_words(const TwoPointComparison& comparison) {
  if (!comparison.nothing_held_out) return "";
  switch (*comparison.nothing_held_out) {
    case NothingHeldOut::single_diameter:
      return "the dataset has a single diameter: nothing is held out";
    case NothingHeldOut::refit_failed:
      return "the full fit of that diameter alone failed: " + comparison.refit_failure;
  }
  return "";
}

std::string chance_words(const BootstrapResult& bootstrap) {
  if (!bootstrap.relative_error) return "";
  return fmt::format(
      "with other random numbers an interval's end would move by at most {:.1f} % of its width "
      "(one standard deviation)",
      100.0 * *bootstrap.relative_error);
}

}  // namespace recoil
