#include "report/words_diagnosis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "data/text.hpp"
#include "mechanism/catalogue.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_titles = 3;    // of tests that found something
constexpr std::size_t most_values = 8;    // of parameters
constexpr std::size_t most_expected = 3;  // effects of stated conditions

std::string p_words(double p, int simulated) {
  const double smallest = 1.0 / (simulated + 1.0);
  return p <= smallest * 1.001 ? fmt::format("p < {:.2g}", 2.0 * smallest)
                               : fmt::format("p = {:.2g}", p);
}

std::string diameter_words(double diameter) {
  return diameter < 1e-3 ? fmt::format("{:.3g} um", diameter / units::um)
                         : fmt::format("{:.3g} mm", diameter / 1e-3);
}

std::string title_of(const std::string& id) {
  const Mechanism* mechanism = find_mechanism(id);
  return mechanism == nullptr ? id : fmt::format("{} ({})", id, mechanism->info.title);
}

/// Why a candidate that is set aside is.
std::string because_words(const CandidateResult& c) {
  switch (c.set_aside.value_or(SetAside::not_possible)) {
    case SetAside::description:
      return "a description explains nothing";
    case SetAside::gains_too_little:
      return "it gains less than its parameters cost";
    case SetAside::chance:
      return fmt::format(
          "by chance alone the best of all candidates gains as much in {:.0f} % of data sets",
          100.0 * c.p_value.value_or(1.0));
    case SetAside::not_possible:
      break;
    case SetAside::batch_is_size:
      return "every series has its own diameter and the offsets vary smoothly with it: offsets of "
             "batches cannot be told from an unknown law of size here";
    case SetAside::leaves_structure:
      return fmt::format("it leaves structure behind (p = {:.2g})", c.remaining_p);
    case SetAside::predicts_no_better:
      return "it predicts held-out sizes or targets no better than the base model";
    case SetAside::one_would_do:
      return "one of the two does as well alone";
    case SetAside::one_hardly_takes_part:
      return fmt::format(
          "it leaves structure behind (p = {:.2g}), and one of the two explains no more of the "
          "misfit than an error in the law of the other could",
          c.remaining_p);
    case SetAside::at_the_edge:
      return "a parameter lies at the limit of what is possible";
    case SetAside::far_behind:
      return "it fits far worse than the best two";
  }
  for (const FoundParameter& parameter : c.parameters) {
    if (!parameter.plausible()) return implausible_words(parameter);
  }
  return "";
}

std::string titles_of(const std::vector<std::string>& ids, const char* between = ", ") {
  std::vector<std::string> titles;
  for (const std::string& id : ids) titles.push_back(title_of(id));
  return fmt::format("{}", fmt::join(titles, between));
}

/// "ambient pressure"
std::string condition_words(Condition condition) {
  std::string words(name_of(condition));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// "3.1", "3.1 +/- 0.2"
std::string value_words(const FoundParameter& p) {
  return p.sd > 0.0 ? fmt::format("{:.3g} +/- {:.2g}", p.value, p.sd)
                    : fmt::format("{:.3g}", p.value);
}

/// "C_x = 3 m" of those that were fitted; of more than `most_values`, as a parameter per series may
/// be, the range.
std::string parameters_words(const CandidateResult& candidate) {
  std::vector<FoundParameter> all = candidate.parameters;
  if (std::all_of(all.begin(), all.end(), [](const FoundParameter& p) { return p.sd == 0.0; })) {
    std::erase_if(all, [](const FoundParameter& p) { return !p.stated_by; });
    std::vector<std::string> words;
    for (const FoundParameter& p : all) {
      words.push_back(fmt::format("{} = {:.3g}{}, as the {} says", p.label, p.value,
                                  unit_suffix(p.unit), condition_words(*p.stated_by)));
    }
    if (!words.empty()) return fmt::format("{}", fmt::join(words, "; "));
    all = candidate.parameters;
  }
  std::erase_if(all, [&](const FoundParameter& p) {
    const auto& slots = candidate.candidate.model.slots;
    return std::any_of(slots.begin(), slots.end(), [&](const ParameterSlot& slot) {
      return slot.label() == p.label && !slot.free;
    });
  });
  if (all.size() > most_values) {
    const auto [low, high] = std::minmax_element(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
    return fmt::format("{} values from {} = {:.3g} to {} = {:.3g}", all.size(), low->label,
                       low->value, high->label, high->value);
  }
  std::vector<std::string> words;
  for (const FoundParameter& p : all) {
    words.push_back(fmt::format("{} = {}{}", p.label, value_words(p), unit_suffix(p.unit)));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string gain_words(const Diagnosis& d) {
  if (!d.gain || d.gain->folds.empty()) return "";
  std::string text = fmt::format(
      " Points that were held out are predicted with an error of {:.3g} in e instead of {:.3g}",
      d.gain->rmse_extended, d.gain->rmse_base);
  if (d.gain->relative < 0.0) {
    text += fmt::format(" ({:.0f} % more: what holds elsewhere does not hold there)",
                        -100.0 * d.gain->relative);
  } else if (d.gain->lower && d.gain->upper) {
    text += fmt::format(" ({:.0f} % less, 95 % interval {:.0f} to {:.0f} %)",
                        100.0 * d.gain->relative, 100.0 * *d.gain->lower, 100.0 * *d.gain->upper);
  }
  return text + ".";
}

/// Those that would have gained as much as the answer, but are not possible.
std::string impossible_words(const Diagnosis& d) {
  std::vector<std::string> words;
  const double answer = d.extended ? d.extended->delta_aicc + d.options.margin : 0.0;
  for (const CandidateResult& c : d.candidates) {
    const auto& said = d.resembles;
    if (std::find(said.begin(), said.end(), c.candidate.name()) != said.end()) continue;
    if (!c.plausible && c.delta_aicc < answer && words.size() < 2) {
      const bool listed =
          std::find(d.rivals.begin(), d.rivals.end(), c.candidate.name()) != d.rivals.end();
      words.push_back(
          listed ? fmt::format("{} is listed though hardly plausible ({})", c.candidate.name(),
                               set_aside_words(c))
                 : fmt::format("{} is set aside because {}", c.candidate.name(), because_words(c)));
    }
  }
  return words.empty() ? "" : fmt::format(" {}.", fmt::join(words, "; "));
}

/// The candidate of one mechanism; null where it was not tried.
const CandidateResult* single_named(const Diagnosis& d, const std::string& id) {
  const auto found =
      std::find_if(d.candidates.begin(), d.candidates.end(), [&](const CandidateResult& c) {
        return c.candidate.added.size() == 1 && c.candidate.added.front() == id;
      });
  return found == d.candidates.end() ? nullptr : &*found;
}

/// What has the shape of the misfit, and why it is not believed all the same.
std::string resembling_words(const Diagnosis& d) {
  std::vector<std::string> words;
  for (const std::string& id : d.resembles) {
    if (const CandidateResult* const c = single_named(d, id)) {
      words.push_back(
          fmt::format("{}: {}; but {}", title_of(id), parameters_words(*c), because_words(*c)));
    }
  }
  return fmt::format(
      "The misfit looks like {}. No plausible cause comes as close, so none is named.",
      fmt::join(words, ", or like "));
}

/// When two causes at once are needed: which one all the answers have in common.
std::string common_words(const Diagnosis& d) {
  if (!d.extended || d.extended->candidate.added.size() < 2) return "";
  std::string text = " It takes two causes at once";
  for (const std::string& id : d.common) text += fmt::format("; {} is one of them in any case", id);
  return text + ".";
}

/// What the conditions of the data say must be there, the largest effect first.
std::string expected_words(const Diagnosis& d) {
  std::string text;
  std::size_t said = 0;
  for (const ExpectedEffect& effect : d.expected) {
    if (said++ == most_expected) break;
    const ConditionInfo& info = info_of(effect.condition);
    text += fmt::format(
        " At the stated {} of {:.4g}{}, {} changes e by {:+.2g} at most ({} at {:.3g} m/s).",
        condition_words(effect.condition), effect.stated, unit_suffix(info.unit),
        title_of(effect.id), effect.change, diameter_words(effect.diameter), effect.velocity);
  }
  return text;
}

/// The change of a condition that would tell most for its effort, where one tells anything.
std::string change_words(const Diagnosis& d) {
  const auto change = std::find_if(
      d.experiments.begin(), d.experiments.end(),
      [](const NextExperiment& next) { return next.kind == ExperimentKind::condition; });
  if (change == d.experiments.end()) return "";
  return fmt::format(
      " Or change the conditions: {}, and measure {} impact{} of {} at {:.3g} m/s. If the cause is "
      "{}, e is {} there by {:.2g} than if it is {}.",
      change->doing, change->events, change->events == 1 ? "" : "s",
      diameter_words(change->diameter), change->velocity, change->one,
      change->difference > 0.0 ? "higher" : "lower", std::abs(change->difference), change->other);
}

std::string next_words(const Diagnosis& d) {
  if (d.next.empty()) return "";
  const std::string taken = d.extended->candidate.name();
  const auto about = std::find_if(d.next.begin(), d.next.end(), [&](const NextMeasurement& next) {
    return next.one == taken || next.other == taken;
  });
  const NextMeasurement& next = about == d.next.end() ? d.next.front() : *about;
  std::string text = fmt::format(
      " To tell {} from {}, measure spheres of {} at {:.3g} m/s, where they differ by {:.2g} in e",
      next.one, next.other, diameter_words(next.diameter), next.velocity,
      std::abs(next.difference));
  text += !next.events        ? "; even a million impacts would not be enough"
          : *next.events == 1 ? "; one impact may be enough"
                              : fmt::format("; about {} impacts are needed", *next.events);
  return text + ".";
}

std::string one_size_words(const Diagnosis& d) {
  return has_one_size(d.base.data)
             ? " One diameter cannot show how the effect depends on size, which is what tells one "
               "cause from another: none is named."
             : "";
}

/// An adequate model that nothing could have shown wrong.
std::string evidence_words(const Diagnosis& d) {
  const Evidence evidence = evidence_for(d);
  if (!evidence.hardly_any()) return "";
  return fmt::format(
      " With {} points that rebounded and {} free parameters hardly any misfit could have been "
      "seen: this is no evidence for the model.",
      evidence.rebounds, evidence.free);
}

std::string dominant_point_words(const Diagnosis& d) {
  const std::optional<std::size_t> worst = dominant_point(d);
  if (!worst) return "";
  const Observation& point = d.base.data.points[*worst];
  return fmt::format(
      " Most of the misfit is one point, of {} at {:.3g} m/s (e = {:.3g}): look at that first.",
      diameter_words(point.diameter), point.velocity, point.restitution);
}

std::string closest_words(const Diagnosis& d) {
  const CandidateResult* const closest = closest_cause(d);
  if (closest == nullptr) return "";
  return fmt::format(
      " The closest is {}, which explains {:.0f} % of the misfit: it may be the cause, with a law "
      "other than the catalogue's, or one of two causes; but what it leaves is more than noise "
      "({}), so it is not named.",
      title_of(closest->candidate.name()), 100.0 * (1.0 - closest->remaining_part),
      p_words(closest->remaining_p, quick_samples));
}

std::string found_words(const Diagnosis& d) {
  std::vector<std::string> found;
  for (const StructureTest& test : d.structure.tests) {
    if (test.p_value > 0.01) continue;
    if (found.size() == most_titles) {
      found.emplace_back("and more");
      break;
    }
    const bool one_size = test.question == StructureQuestion::size && has_one_size(d.base.data);
    found.push_back(one_size ? "the points as a whole lie above or below the model"
                             : words_of(test.question));
  }
  return found.empty() ? "" : fmt::format(": {}", fmt::join(found, ", "));
}

std::string errors_words(const UnstatedErrors& errors) {
  if (errors.source == ErrorSource::shared_setting) {
    return fmt::format(
        "an error of {:.2g} in e that all points of one setting of the apparatus have in common "
        "leaves nothing systematic (p = {:.2g}): repeating one setting does not average it out",
        errors.value, errors.remaining_p);
  }
  return errors.source == ErrorSource::velocity_errors
             ? fmt::format(
                   "velocities uncertain by {:.2g} % each (velocity_relative_sd = {:.2g} "
                   "under [noise]) leave nothing systematic (p = {:.2g})",
                   100.0 * errors.value, errors.value, errors.remaining_p)
             : fmt::format(
                   "standard deviations {:.2g} times as large leave nothing systematic "
                   "(p = {:.2g})",
                   errors.value, errors.remaining_p);
}

std::string rival_errors_words(const Diagnosis& d) {
  const std::vector<UnstatedErrors> rivals = rival_errors(d);
  if (rivals.empty()) return "";
  std::vector<std::string> words;
  for (const UnstatedErrors& errors : rivals) words.push_back(errors_words(errors));
  const double behind = d.extended ? rivals.front().delta_aicc - d.extended->delta_aicc : 0.0;
  return fmt::format(
      " Unstated errors would explain the misfit {}: {}.",
      !d.extended ? "without any cause"
      : behind > d.options.margin
          ? fmt::format("too, though less well (AICc larger by {:.0f} than with two causes)",
                        behind)
          : "as well",
      fmt::join(words, "; "));
}

std::string verdict_words(const AnswerForAll& answer) {
  const std::string verdict = to_string(answer.verdict);
  const std::vector<std::string>& ids = !answer.named.empty()    ? answer.named
                                        : !answer.rivals.empty() ? answer.rivals
                                                                 : answer.resembles;
  return ids.empty() ? verdict : fmt::format("{} ({})", verdict, fmt::join(ids, ", "));
}

/// What knowing how velocities were measured would exclude.
std::string method_words(const Diagnosis& d) {
  const bool unknown =
      std::any_of(d.datasets.begin(), d.datasets.end(),
                  [](const Dataset& dataset) { return dataset.system.method == Method::unknown; });
  std::vector<std::string> words;
  for (const auto* ids : {&d.named, &d.rivals, &d.resembles}) {
    for (const std::string& id : *ids) {
      const Mechanism* const mechanism = find_mechanism(id);
      if (mechanism == nullptr || mechanism->info.methods.empty()) continue;
      std::vector<std::string_view> methods;
      for (const Method method : mechanism->info.methods) methods.push_back(name_of(method));
      words.push_back(fmt::format("{} only with {}", id, fmt::join(methods, " or ")));
    }
  }
  if (!unknown || words.empty()) return "";
  return fmt::format(
      " The dataset does not say how velocities were measured (recoil.method), which would decide "
      "some of these: {}.",
      fmt::join(words, ", "));
}

/// Which points were set aside, and what the answer would be with them; empty where none were.
std::string outlying_words(const Diagnosis& d) {
  if (d.outlying.empty()) return "";
  std::vector<std::string> rows;
  for (const OutlyingPoint& point : d.outlying) {
    rows.push_back(fmt::format(
        "line {}{} ({} at {:.3g} m/s, e = {:.3g}: {:+.1f} standard deviations)", point.line,
        d.datasets.size() > 1 ? " of " + d.datasets[point.dataset].id : "",
        diameter_words(point.diameter), point.velocity, point.restitution, point.residual));
  }
  return fmt::format(
      " {} so far from what the others predict that {} set aside: {}. With {} the answer would be "
      "{}.",
      rows.size() == 1 ? "One point lies" : fmt::format("{} points lie", rows.size()),
      rows.size() == 1 ? "it was" : "they were", fmt::join(rows, "; "),
      rows.size() == 1 ? "it" : "them", verdict_words(*d.for_all));
}

std::string unexplained_words(const Diagnosis& d) {
  if (!d.structure.smooth) {
    return " The misfit has no shape in velocity and size: the points scatter more than their "
           "stated standard deviations, which are then too small.";
  }
  if (d.free_form_p <= 0.01) {
    return " A smooth function of velocity and size does not describe the misfit either.";
  }
  return rival_errors(d).empty()
             ? " A smooth function of velocity and size describes the misfit: there is an effect "
               "that this program does not know, or one that acts on some of the points only."
             : " A smooth function of velocity and size describes the misfit as well, as it would "
               "describe an effect that this program does not know.";
}

}  // namespace

std::string words_of(StructureQuestion question) {
  switch (question) {
    case StructureQuestion::scatter:
      return "the residuals are larger than the stated deviations";
    case StructureQuestion::size:
      return "whole diameters lie above or below the model";
    case StructureQuestion::trend:
      return "residuals rise or fall with velocity";
    case StructureQuestion::curvature:
      return "residuals bend with velocity";
    case StructureQuestion::capture:
      return "the model has the wrong curvature near capture";
    case StructureQuestion::runs:
      return "neighbouring points miss on the same side";
    case StructureQuestion::smooth:
      return "a smooth function of velocity and size describes the residuals";
  }
  return "";
}

std::string fold_words(const Fold& fold, const std::vector<Dataset>& datasets) {
  switch (fold.kind) {
    case FoldKind::size: {
      return fold.lower < fold.upper
                 ? fmt::format("{} to {}", diameter_words(fold.lower), diameter_words(fold.upper))
                 : diameter_words(fold.lower);
    }
    case FoldKind::velocity:
      return fmt::format("{:.3g} to {:.3g} m/s", fold.lower, fold.upper);
    case FoldKind::target:
      return datasets[fold.dataset].id;
  }
  return "";
}

std::string implausible_words(const FoundParameter& parameter) {
  if (!parameter.implausible) return "";
  switch (*parameter.implausible) {
    case Implausible::outside_range:
      return fmt::format("{} = {}{} lies outside {:.3g} to {:.3g}: {}", parameter.label,
                         value_words(parameter), unit_suffix(parameter.unit), parameter.lower,
                         parameter.upper, parameter.range_why);
    case Implausible::beyond_limit: {
      const bool above = parameter.quantity > parameter.limit->upper;
      return fmt::format("{} = {}{}: the {} would be {:.2g}, but is at {} {:g}: {}",
                         parameter.label, value_words(parameter), unit_suffix(parameter.unit),
                         parameter.limit->quantity, parameter.quantity, above ? "most" : "least",
                         above ? parameter.limit->upper : parameter.limit->lower,
                         parameter.limit->why);
    }
  }
  return "";
}

std::string set_aside_words(const CandidateResult& c) {
  if (c.set_aside == SetAside::not_possible) return "not possible: " + because_words(c);
  return c.explains() ? "" : because_words(c);
}

std::string short_set_aside_words(const CandidateResult& c) {
  return c.set_aside == SetAside::not_possible ? "not possible" : set_aside_words(c);
}

std::vector<std::string> diagnosis_warnings(const Diagnosis& d) {
  std::vector<std::string> warnings;
  if (simulations_failed(d.structure)) {
    warnings.push_back(fmt::format(
        "{} of {} simulated data sets could not be fitted: the p-values rest on the others",
        d.structure.failed, d.structure.failed + d.structure.simulated));
  }
  if (!d.extended_failure.empty()) {
    warnings.push_back("the extended model has no usable fit of its own: " + d.extended_failure);
  }
  return warnings;
}

std::string where_words(const Diagnosis& d) {
  const MisfitCell* const worst = worst_cell(d);
  if (worst == nullptr) return "";
  return fmt::format(
      "The model is furthest off for {} at {:.3g} to {:.3g} m/s, where it is too {} by {:.2g} in e "
      "({:.2g} standard errors) and by {:.2g} J in the energy of the rebound",
      diameter_words(worst->diameter), worst->slowest, worst->fastest,
      worst->restitution > 0.0 ? "low" : "high", std::abs(worst->restitution),
      std::abs(worst->standardised), std::abs(worst->energy));
}

namespace {

/// That the errors of the materials make the model adequate, and which of them; empty when not.
std::string materials_words(const Diagnosis& d) {
  if (!d.materials) return "";
  std::string moved;
  for (std::size_t k = 0; k < d.base.constants_moved.size(); ++k) {
    const double by = d.base.constants_moved[k];
    constexpr double worth_a_word = 0.5;  // standard deviations
    if (std::abs(by) < worth_a_word) continue;
    moved += fmt::format("{}{} by {:+.1f}", moved.empty() ? ": " : ", ",
                         d.base.model.slots[d.base.model.first_constant() + k].label(), by);
  }
  return fmt::format(
      " It does so within the errors of the material constants{}{}; with exact constants structure "
      "would be left (p = {:.2g}).",
      moved, moved.empty() ? "" : " standard deviations", d.materials->p_value_exact);
}

}  // namespace

std::string answer_words(const Diagnosis& d) {
  const std::string p = p_words(d.structure.p_value, d.structure.simulated);
  if (d.verdict == Verdict::adequate) {
    return fmt::format(
               "The model describes these points: nothing systematic is left in its residuals ({}: "
               "the share of data sets simulated with the model that look as systematic).",
               p) +
           evidence_words(d) + materials_words(d) + expected_words(d) + outlying_words(d);
  }
  std::string text =
      fmt::format("The fitted model leaves structure in its residuals ({}){}. ", p, found_words(d));
  const std::string where = where_words(d);
  if (!where.empty()) text += where + ". ";
  switch (d.verdict) {
    case Verdict::cause_named:
      text += fmt::format("Of all mechanisms in the catalogue, only {} it: {}.",
                          d.named.size() == 1
                              ? title_of(d.named.front()) + " explains"
                              : fmt::format("{} together explain", titles_of(d.named, " and ")),
                          parameters_words(*d.extended));
      text += gain_words(d);
      break;
    case Verdict::not_separable:
      text +=
          d.rivals.size() == 1
              ? fmt::format("Of all mechanisms in the catalogue, only {} would explain it.",
                            titles_of(d.rivals))
          : d.shared_cause.empty()
              ? fmt::format("These data cannot tell which of these causes it is: {}.",
                            titles_of(d.rivals))
              : fmt::format("The cause is {}; which of its laws holds, these data cannot tell: {}.",
                            d.shared_cause, titles_of(d.rivals));
      text += common_words(d) + one_size_words(d);
      text += fmt::format(" The extended model takes {}: {}.", d.extended->candidate.name(),
                          parameters_words(*d.extended));
      text += gain_words(d) + next_words(d) + change_words(d);
      break;
    case Verdict::unexplained:
      text += !d.resembles.empty() ? resembling_words(d)
              : d.outdone.empty()  ? "Nothing in the catalogue explains it, alone or two at a time."
                                   : fmt::format(
                                         "{} would explain it, but so would unstated errors, which "
                                          "assume less: no cause is named.",
                                         d.outdone);
      text += dominant_point_words(d);
      if (d.resembles.empty()) text += closest_words(d) + unexplained_words(d);
      break;
    case Verdict::adequate:
      break;
  }
  return text + expected_words(d) + rival_errors_words(d) + impossible_words(d) + method_words(d) +
         outlying_words(d);
}

}  // namespace recoil
