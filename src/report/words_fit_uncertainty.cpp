#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanism/mechanism.hpp"
#include "report/format.hpp"
#include "report/words_fit.hpp"
#include "uncertainty/fit_alternatives.hpp"

namespace recoil {
namespace {

using Sentences = std::vector<Sentence>;

Sentence label_of(const ImpactModel& model, std::size_t slot) {
  return symbol(model.slots[slot].label());
}

// ---- why intervals differ ----------------------------------------------------------------------

Sentence bound_words(const Disagreement& found, const ImpactModel& model, std::size_t slot) {
  if (found.estimate_at_bound) return "the estimate is at its bound";
  if (!found.on_bound) return {};
  const auto& [other, share, correlation] = *found.on_bound;
  if (other == slot) return say("{:.0f} % of the replicates are at a bound", 100.0 * share);
  return say("{:.0f} % of the replicates have {} at its bound (correlation {:.2f})", 100.0 * share,
             label_of(model, other), correlation);
}

std::string skew_words(const Disagreement& found) {
  std::vector<std::string> signs;
  if (found.acceleration) signs.push_back(fmt::format("acceleration {:+.2g}", *found.acceleration));
  if (found.bias) signs.push_back(fmt::format("bias z0 = {:+.2g}", *found.bias));
  if (found.arms) {
    signs.push_back(fmt::format("the profile reaches {:.2g} times as far up as down", *found.arms));
  }
  return fmt::format("skewed distribution ({})", fmt::join(signs, ", "));
}

// ---- cautions ----------------------------------------------------------------------------------

Sentence undecided_words(const Sentence& what, double factor) {
  return say(
      "the error of {} changes by a factor of {:.1f} with the assumed growth of the scatter "
      "towards capture, which the points do not determine: state standard deviations, or measure "
      "more points",
      what, factor);
}

/// The id of the mechanism for points that average over several sizes.
std::string_view mechanism_of_sizes() {
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    if (mechanism.info.mixes_sizes) return mechanism.info.id;
  }
  return "";
}

Sentence wide_spread_words(const Sentence& what, double event_spread) {
  return say(
      "the interval of {} cannot be trusted: the capture velocity scatters by {:.0f} % from impact "
      "to impact, and the treatment of survivors is valid up to {:.0f} %; if a point averages over "
      "several sizes, sort them into size classes (recoil pair --size-edges) or fit their spread "
      "(mechanisms = [\"{}\"])",
      what, 100.0 * event_spread, 100.0 * widest_spread, mechanism_of_sizes());
}

// ---- bootstrap ---------------------------------------------------------------------------------

const char* resampled_words(Scheme scheme) {
  using enum Scheme;
  static constexpr Phrase<Scheme> phrases[] = {
      {parametric, "new noise is drawn about the fitted curve"},
      {residual, "residuals, scaled for leverage and centred, are exchanged among the points"},
      {wild, "each point keeps its residual, scaled for leverage (HC3), with a random sign"},
      {cases, "points are drawn with replacement"},
      {cluster, "whole series are drawn with replacement"},
      {automatic, ""}};
  return phrase_for(phrases, scheme).words;
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

// ---- identifiability ---------------------------------------------------------------------------

/// A relative error in words: "2.1 %", or "a factor of 3" for a large one.
std::string precision_words(double relative_sd) {
  constexpr double largest_percentage = 0.5;
  constexpr double largest_factor = 7.0;  // ln of a factor of 1100
  if (!(relative_sd < largest_factor)) return "nothing at all";
  if (relative_sd < largest_percentage) return fmt::format("{:.2g} %", 100.0 * relative_sd);
  return fmt::format("a factor of {:.2g}", std::exp(relative_sd));
}

/// What is known of a parameter that is not well determined, as the predicate of a sentence.
Sentence hindrance_words(const ParameterIdentifiability& found, const Interval& interval,
                         const ParameterSlot& slot) {
  const auto end = [&](const std::optional<double>& value) {
    return say("{}{}", number(value.value_or(NAN), 2), unit_after_number(slot.parameter->unit));
  };
  const std::string error = precision_words(found.relative_error);
  switch (*found.hindrance) {
    case Hindrance::no_interval:
      return "has no interval: " + missing_words(interval);
    case Hindrance::reaches_upper_bound:
      return interval.lower.value_or(slot.lower) <= slot.lower
                 ? "is not limited by the points"
                 : say("is known only to be above {}", end(interval.lower));
    case Hindrance::reaches_lower_bound:
      return say("is known only to be below {}", end(interval.upper));
    case Hindrance::rests_on_bound:
      return say("is at its bound, and known only to be below {}", end(interval.upper));
    case Hindrance::consistent_with_zero:
      return say("is consistent with zero, and known only to be below {}", end(interval.upper));
    case Hindrance::large_error:
      return say("is known to {}", error);
    case Hindrance::model_rejected:
      return say("is known to {} if the model holds", error);
    case Hindrance::uncertain_error:
      return say("is known to {}, or only to {}, because the noise is estimated", error,
                 precision_words(found.largest_relative_error));
    case Hindrance::undecided_noise:  // parameter_sentences handles this and the next one
    case Hindrance::wide_spread:
      break;
  }
  return {};
}

Sentences parameter_sentences(const FitResult& fitted, const UncertaintyResult& uncertainty) {
  const Identifiability& found = uncertainty.identifiability;
  Sentences sentences, not_trusted;
  if (found.rejected) {
    sentences.emplace_back("the errors hold only if the model does, and it does not fit");
  }
  for (std::size_t j = 0; j < found.parameter.size(); ++j) {
    const ParameterIdentifiability& parameter = found.parameter[j];
    if (!fitted.model.slots[j].free) continue;
    const Sentence label = label_of(fitted.model, j);
    if (!parameter.hindrance) continue;
    if (parameter.hindrance == Hindrance::wide_spread) {
      not_trusted.push_back(label);
    } else if (parameter.hindrance == Hindrance::undecided_noise) {
      sentences.push_back(undecided_words(label, parameter.noise_factor));
    } else {
      const Interval& interval = recommended_interval(uncertainty.intervals[j]);
      sentences.push_back(
          say("{} {}", label, hindrance_words(parameter, interval, fitted.model.slots[j])));
    }
  }
  if (!not_trusted.empty()) {
    sentences.push_back(wide_spread_words(join(not_trusted, " and "), found.event_spread));
  }
  return sentences;
}

/// Strongly correlated parameters, and how well the points determine their combinations.
Sentences correlation_sentences(const FitResult& fitted, const Identifiability& found) {
  Sentences sentences;
  for (const auto& [one, other, correlation] : found.correlated) {
    sentences.push_back(say("{} and {} are strongly correlated ({:.3f}): quote them together",
                            label_of(fitted.model, one), label_of(fitted.model, other),
                            correlation));
  }
  const auto& directions = found.information.directions;
  if (found.correlated.empty() || directions.size() < 2) return sentences;
  sentences.push_back(say(
      "the points determine {} to {}, but {} only to {}",
      direction_words(fitted, directions.front()), precision_words(directions.front().relative_sd),
      direction_words(fitted, directions.back()), precision_words(directions.back().relative_sd)));
  return sentences;
}

/// The slowest impacts relative to the capture velocity, and the benefit of more points there.
Sentences reach_sentences(const FitResult& fitted, const Identifiability& found) {
  Sentences sentences;
  if (found.slowest) {
    sentences.push_back(fmt::format(
        "the slowest impacts are at {:.2g} times the fitted capture velocity", *found.slowest));
  }
  if (!found.more_points || fitted.covariance.empty()) return sentences;
  Sentences gains;
  for (const auto& [slot, now, then] : worthwhile_gains(found.information)) {
    gains.push_back(say("{} to {} instead of {}", label_of(fitted.model, slot),
                        precision_words(then), precision_words(now)));
  }
  if (gains.empty()) return sentences;
  const PlannedPoints& plan = found.information.plans.front();
  sentences.push_back(say("{} more points of {} at {:.3g} m/s would determine {}", plan.points,
                          diameter_sentence(plan.diameter), plan.velocity, join(gains, ", ")));
  return sentences;
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

std::string words_of(IntervalKind kind) {
  return kind == IntervalKind::wald ? "Wald" : kind == IntervalKind::bca ? "BCa" : to_string(kind);
}

std::string missing_words(const Interval& interval) {
  if (interval.available()) return "";
  if (!interval.missing) return "not computed";
  using enum NoInterval;
  static constexpr Phrase<NoInterval> phrases[] = {
      {not_assessed, "no uncertainty was assessed"},
      {fixed, "the parameter is fixed"},
      {nothing_free, "no parameter is free"},
      {no_standard_error, "no standard error (at a bound, or not determined)"},
      {no_ends, "refits on both sides of the estimate failed or ended in worse minima"},
      {no_lower_end, "refits below the estimate failed or ended in worse minima"},
      {no_upper_end, "refits above the estimate failed or ended in worse minima"},
      {end_at_estimate, "an end would be the estimate itself, which is not at a bound"},
      {few_replicates, "fewer usable replicates than the level needs"},
      {few_delete_one_refits, "fewer than three delete-one refits succeeded"},
      {one_sided_replicates, "all replicates are on one side of the estimate"},
      {large_acceleration, "the acceleration is too large for this level"},
      {replicates_without_error,
       "more than a tenth of the replicates are at a bound and have no error"},
      {refits_failed, "withheld, as more than a tenth of the refits failed"},
      {never_rebounds, "spheres of this size never rebound under the fit"},
      {never_captured, "no sphere is captured under the fit"},
      {no_covariance, "the fit has no standard errors"},
      {all_captured, "every point states only that all or none of its impacts were captured"},
      {noise_unknown, "the noise is not known"}};
  return phrase_for(phrases, *interval.missing).words;
}

Sentence note_words(const Interval& interval, const Sentence& what) {
  if (!interval.note) return {};
  const double value = interval.note->value;
  switch (interval.note->caution) {
    case Caution::spans_both_bounds:
      return "the interval spans both bounds: the data do not limit this parameter";
    case Caution::begins_at_bound:
      return say("the interval begins at the bound {:g} and is an upper limit", value);
    case Caution::ends_at_bound:
      return say("the interval ends at the bound {:g} and is a lower limit", value);
    case Caution::undecided_noise:
      return undecided_words(what, value);
    case Caution::wide_spread:
      return wide_spread_words(what, value);
    case Caution::mixed_sizes:
      return say(
          "the interval of {} is too narrow, because every point averages over many sizes: in "
          "simulations {:.0f} % of such 95 % intervals contained the truth",
          what, 100.0 * value);
    case Caution::model_rejected:
      return say(
          "{} follows from a model that does not fit; its interval does not include the error of "
          "the model",
          what);
  }
  return {};
}

std::string short_note(Caution caution) {
  using enum Caution;
  static constexpr Phrase<Caution> phrases[] = {{spans_both_bounds, "not limited by the data"},
                                                {begins_at_bound, "upper limit"},
                                                {ends_at_bound, "lower limit"},
                                                {undecided_noise, ""},
                                                {wide_spread, ""},
                                                {mixed_sizes, ""},
                                                {model_rejected, "the model does not fit"}};
  return phrase_for(phrases, caution).words;
}

std::string recommended_words(const IntervalSet& set) {
  if (set.recommended != IntervalKind::profile) {
    return "there is no profile: " + missing_words(set[IntervalKind::profile]);
  }
  return set.student ? "profile likelihood, with Student's factor because the noise is estimated"
                     : "profile likelihood";
}

std::string recommended_words(const CaptureEstimate& capture) {
  using enum CaptureBecause;
  static constexpr Phrase<CaptureBecause> reasons[] = {
      {no_delta, ""},
      {at_bound, "a parameter is at its bound, which the delta method ignores"},
      {bend, "V* is not linear in the parameters, as the delta method assumes"},
      {no_percentiles, "there are no percentiles: "},
      {spread_estimated, "the error includes that of the estimated spread of the impacts"},
      {laws_averaged, "it is averaged over how wrong the laws may be"},
      {noise_estimated, "the error includes that of the estimated noise"}};
  if (!capture.because) return "";
  std::string words = phrase_for(reasons, *capture.because).words;
  if (capture.because == no_delta) words += missing_words(capture[CaptureIntervalKind::delta]);
  if (capture.because == no_percentiles) {
    words += missing_words(capture[CaptureIntervalKind::percentile]);
  }
  return words;
}

Sentence disagreement_words(const FitResult& fitted, std::size_t slot, const IntervalSet& set) {
  if (!set.disagreement) return {};
  const Disagreement& found = *set.disagreement;
  Sentences reasons;
  if (Sentence bound = bound_words(found, fitted.model, slot); !bound.empty()) {
    reasons.push_back(std::move(bound));
  }
  if (found.ridge) {
    reasons.push_back(say("correlated with {} ({:.3f})",
                          label_of(fitted.model, found.ridge->partner), found.ridge->correlation));
  }
  if (found.skewed()) reasons.emplace_back(skew_words(found));
  if (found.few_points) {
    reasons.push_back(
        say("{} degrees of freedom, which widen Wald, profile and studentized intervals by a "
            "factor of {:.2f}",
            found.few_points->dof, found.few_points->factor));
  }
  if (reasons.empty()) reasons.emplace_back("without an obvious reason");
  return say("{}: the intervals differ from the {} interval ({} of its width): {}",
             label_of(fitted.model, slot), words_of(set.recommended),
             joined(found.differing, ", ",
                    [](const auto& one) {
                      return fmt::format("{} by {:.0f} %", words_of(one.kind), 100.0 * one.by);
                    }),
             join(reasons, "; "));
}

std::string scheme_words(const BootstrapResult& bootstrap) {
  using enum SchemeBecause;
  static constexpr Phrase<SchemeBecause> reasons[] = {
      {asked_for, "requested"},
      {sd_stated, "every point states its standard deviation"},
      {sd_not_stated, "no standard deviations are stated"},
      {no_residuals, "no point rebounded, so there are no residuals"},
      {shared_errors, "points share errors, so that single ones cannot be exchanged"}};
  constexpr std::size_t few = 10;
  const bool too_few = bootstrap.scheme == Scheme::cluster && bootstrap.series < few;
  return fmt::format(
      "{}: {}{}", phrase_for(reasons, bootstrap.because).words, resampled_words(bootstrap.scheme),
      too_few
          ? fmt::format("; {} series are too few, so intervals are too narrow", bootstrap.series)
          : std::string());
}

std::string failure_message(const FailedReplicates& failures) {
  return failures.undetermined ? "its points do not determine all free parameters"
                               : failures.message;
}

std::string failures_words(const BootstrapResult& bootstrap, const Observations& data) {
  const FailedReplicates& failures = bootstrap.failures;
  if (failures.index.empty()) return "";
  std::vector<std::string> suspects;
  for (const FailedReplicates::Suspect& suspect : failures.suspects) {
    if (!suspects.empty() && !suspect.clearly_unlike) continue;
    suspects.push_back(suspect_words(suspect, bootstrap.scheme, data));
  }
  return fmt::format("{} of {} refits failed{}{}. The first is replicate {} (seed {}): {}",
                     failures.index.size(), bootstrap.replicates,
                     suspects.empty() ? "" : "; in them ", fmt::join(suspects, "; "),
                     failures.index.front(), bootstrap.seed, failure_message(failures));
}

std::string held_out_words(const TwoPointComparison& comparison) {
  if (!comparison.nothing_held_out) return "";
  if (!comparison.refit_failure.empty()) {
    return "the full fit of that diameter alone failed: " + comparison.refit_failure;
  }
  return "the dataset has a single diameter, so none is held out";
}

Sentence direction_words(const FitResult& fitted, const InformationDirection& direction) {
  constexpr double negligible = 0.05;
  Sentence product;
  for (std::size_t j = 0; j < direction.exponents.size(); ++j) {
    const double power = direction.exponents[j];
    if (std::abs(power) < negligible) continue;
    if (!product.empty()) product += " ";
    product += label_of(fitted.model, j);
    if (std::abs(power - 1.0) >= 0.005) product += exponent(fmt::format("{:.2f}", power));
  }
  if (direction.meaning) product += say(" ({})", words_of(*direction.meaning));
  return product;
}

Sentence identifiability_words(const FitResult& fitted, const UncertaintyResult& uncertainty) {
  const Identifiability& found = uncertainty.identifiability;
  if (!found.assessed()) return {};
  Sentences sentences = parameter_sentences(fitted, uncertainty);
  if (sentences.empty()) {
    const bool any_free = std::ranges::any_of(fitted.model.slots,
                                              [](const ParameterSlot& slot) { return slot.free; });
    sentences.emplace_back(any_free ? "every free parameter is well determined"
                                    : "no parameter is free");
  }
  for (const Sentences& more :
       {correlation_sentences(fitted, found), reach_sentences(fitted, found)}) {
    sentences.insert(sentences.end(), more.begin(), more.end());
  }
  return join(sentences, "; ") + ".";
}

std::vector<Sentence> uncertainty_warnings(const UncertaintyResult& uncertainty,
                                           const Observations& data) {
  Sentences warnings;
  const BootstrapResult& boot = uncertainty.bootstrap;
  if (boot.failed_often()) {
    warnings.emplace_back(failures_words(boot, data) +
                          (boot.withheld() ? "; intervals from replicates are withheld" : ""));
  }
  const UncertaintyOptions& options = uncertainty.options;
  if (options.replicates_auto && boot.relative_error.value_or(0.0) > options.wanted_error) {
    warnings.push_back(
        fmt::format("after {} replicates the ends of an interval are uncertain by {:.1f} % of its "
                    "width, more than the wanted {:.1f} %",
                    boot.replicates, 100.0 * *boot.relative_error, 100.0 * options.wanted_error));
  }
  Sentences all_sizes;
  std::vector<std::pair<Sentence, Sentences>> remarks;  // every remark with its sizes
  const auto add_once = [](const Sentence& size, Sentences& sizes) {
    if (std::ranges::find(sizes, size) == sizes.end()) sizes.push_back(size);
  };
  for (const CaptureEstimate& capture : uncertainty.capture) {
    const Sentence size = diameter_sentence(capture.diameter);
    add_once(size, all_sizes);
    if (capture.found && !capture.interval.note) continue;
    const Sentence words = capture.found
                               ? note_words(capture.interval, "the capture velocity")
                               : "no capture velocity: " + missing_words(capture.interval);
    auto same =
        std::ranges::find_if(remarks, [&](const auto& remark) { return remark.first == words; });
    if (same == remarks.end()) same = remarks.insert(same, {words, {}});
    add_once(size, same->second);
  }
  for (const auto& [words, sizes] : remarks) {
    const bool every = sizes.size() > 1 && sizes.size() == all_sizes.size();
    warnings.push_back(every ? say("all sizes: {}", words)
                             : say("{d} = {}: {}", join(sizes, ", "), words));
  }
  return warnings;
}

std::string no_posterior_words(const PosteriorResult& posterior) {
  if (posterior.available()) return {};
  switch (*posterior.missing) {
    case NoPosterior::no_start:
      return "no posterior: the model has no solution for most parameters near the estimate";
    case NoPosterior::not_settled:
      return fmt::format("no posterior: the chains have not converged after {} steps",
                         posterior.steps);
    case NoPosterior::few_points:
      return "no posterior: the noise is unknown, and there are no more points than parameters";
  }
  return {};
}

Sentence posterior_check_words(const PosteriorStudy& study, const PosteriorCheck& check) {
  const std::string how =
      fmt::format("(posterior SBC, {} data sets: p = {:.2g})", check.sets, check.p_value);
  const auto names = [&](const auto& named) {
    Sentence words;
    const std::size_t count = named.size();
    for (std::size_t k = 0; k < count; ++k) {
      words += k == 0 ? "" : k + 1 < count ? ", " : " and ";
      words += named[k];
    }
    return words;
  };
  std::vector<Sentence> all, wrong;
  for (const RankedParameter& one : check.parameters) {
    all.push_back(symbol(one.parameter));
    if (!(one.p_value * static_cast<double>(check.parameters.size()) < rejected_posterior))
      continue;
    const std::string what =
        one.ratio_lower > 1.0 || one.ratio_upper < 1.0
            ? fmt::format("its intervals are too {} by a factor of {:.2f}",
                          one.ratio_lower > 1.0 ? "narrow" : "wide",
                          std::max(one.error_ratio, 1.0 / one.error_ratio))
        : std::abs(one.shift) > 2.0 * one.shift_sd
            ? fmt::format("its values are too {} by {:.2f} standard deviations",
                          one.shift > 0.0 ? "low" : "high", std::abs(one.shift))
            : "its shape is wrong";
    wrong.push_back(symbol(one.parameter) + Sentence(" (" + what + ")"));
  }
  const auto open = [&](const std::string& why) {
    return Sentence("I do not know whether this posterior can be believed: " + why + ".");
  };
  switch (check.verdict) {
    case PosteriorVerdict::believed:
      return Sentence("This posterior can be believed for ") + names(all) +
             Sentence(" " + how + ".");
    case PosteriorVerdict::not_believed:
      return Sentence("This posterior cannot be believed for ") + names(wrong) +
             Sentence(" " + how + ".");
    case PosteriorVerdict::unknown:
      break;
  }
  switch (check.because) {
    case NoVerdict::no_posterior:
      return open(study.posterior.available() ? "no parameter moves"
                                              : no_posterior_words(study.posterior));
    case NoVerdict::few_sets:
      return open(
          fmt::format("{} of {} data sets gave a posterior, and a verdict needs 50 and nine "
                      "of ten",
                      check.sets, check.sets + check.failed));
    case NoVerdict::noise_in_doubt:
      return open(
          "the stated errors of the points are in doubt, and simulated points do not have this "
          "doubt");
    case NoVerdict::model_rejected:
      return open("the points reject the model, and simulated points obey it");
    case NoVerdict::none:
    case NoVerdict::open_ranks:
      break;
  }
  return open("chance explains the ranks hardly, and more --datasets decide " + how);
}

std::string no_leave_one_out_words(const PosteriorResult& posterior) {
  if (!posterior.available()) return no_posterior_words(posterior);
  if (posterior.draws.empty()) return "no parameter moves";
  if (posterior.left_out.shared_errors) {
    return "points share an error, and one of them alone has no likelihood";
  }
  return posterior.left_out.unscaled
             ? "the likelihood with Student's t is known only up to a factor"
             : "";
}

Sentence leave_one_out_words(const Analysis& a) {
  const std::optional<PosteriorResult>& found = a.uncertainty.posterior;
  if (!found || !found->available()) return {};
  const std::string why = no_leave_one_out_words(*found);
  if (!why.empty()) return say("Leaving out one point at a time: not possible, as {}.", why);
  const LeaveOneOut& loo = found->left_out;
  Sentence words =
      say("Leaving out one point at a time (PSIS-LOO): expected log predictive density {:.1f} "
          "{+/-} {:.1f}, {:.1f} effective parameters. ",
          loo.elpd, loo.se, loo.p_loo);
  const double limit = largest_pareto_k(found->draws.size());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < loo.points.size(); ++i) {
    if (!(loo.points[i].pareto_k > limit)) continue;
    const Observation& point = a.fitted.data.points[i];
    names.push_back(fmt::format("line {}{} (k = {:.2f})", point.line,
                                a.datasets.size() > 1 ? " of " + a.datasets[point.dataset].id : "",
                                loo.points[i].pareto_k));
  }
  if (names.empty()) return words + say("No point has a Pareto k above {:.2g}.", limit);
  return words + say("For {} this estimate is not reliable (Pareto k above {:.2g}): the posterior "
                     "depends strongly on {}.",
                     fmt::to_string(fmt::join(names, ", ")), limit,
                     std::string(names.size() == 1 ? "this point" : "each of these points"));
}

Sentence capture_name(const Analysis& a, const CaptureEstimate& capture) {
  const std::string where =
      a.datasets.size() > 1 ? ", " + short_name(a.datasets, capture.dataset) : "";
  return say("{V*}({}{})", diameter_sentence(capture.diameter), where);
}

std::string source_words(const BudgetEntry& entry, const ImpactModel& model) {
  return entry.constant ? model.slots[model.first_constant() + *entry.constant].label()
                        : std::string(entry.words);
}

std::vector<Sentence> budget_sentences(const Analysis& a) {
  std::vector<std::pair<std::string, Sentences>> by_source;
  const ImpactModel& model = a.fitted.model;
  if (model.constants.empty()) return {};
  const auto add = [&](const Sentence& quantity, const ErrorBudget& budget) {
    if (!budget.available()) return;
    const BudgetEntry& first = budget.entries.front();
    const std::string source = first.constant
                                   ? "the " + constant_words(model, *first.constant, a.datasets)
                                   : source_words(first, model);
    auto found =
        std::ranges::find_if(by_source, [&](const auto& one) { return one.first == source; });
    if (found == by_source.end()) found = by_source.insert(found, {source, {}});
    found->second.push_back(say("{} ({:.0f} %)", quantity, 100.0 * first.share));
  };
  for (std::size_t j = 0; j < a.uncertainty.budgets.size(); ++j) {
    add(parameter_words(model, j, a.datasets), a.uncertainty.budgets[j]);
  }
  for (std::size_t k = 0; k < a.uncertainty.capture_budgets.size(); ++k) {
    const CaptureEstimate& capture = a.uncertainty.capture[k];
    if (&capture != reference_capture(a, capture.dataset)) continue;
    add(capture_name(a, capture), a.uncertainty.capture_budgets[k]);
  }
  Sentences sentences;
  for (const auto& [source, quantities] : by_source) {
    sentences.push_back(say("largest source of error (share of the variance): {}, for {}", source,
                            join(quantities, ", ")));
  }
  return sentences;
}

Sentence moved_words(const Analysis& a) {
  Sentences moved;
  const ImpactModel& model = a.fitted.model;
  for (std::size_t k = 0; k < model.material_count(); ++k) {
    const double by = a.fitted.constants_moved[k];
    if (std::abs(by) < 1.0) continue;
    moved.push_back(say("{} by {:+.1f}", constant_words(model, k, a.datasets), by));
  }
  if (moved.empty()) return {};
  return say(
      "the fit moves material constants away from their stated values ({} standard deviations): "
      "these may be the true values, or they compensate for an effect that the model lacks",
      join(moved, ", "));
}

}  // namespace recoil
