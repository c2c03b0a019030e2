#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/statistics.hpp"
#include "core/units.hpp"
#include "data/text.hpp"
#include "diagnosis/law_errors.hpp"
#include "document/sentence.hpp"
#include "mechanism/mechanism.hpp"
#include "report/format.hpp"
#include "report/words_candidate.hpp"
#include "report/words_diagnosis.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_values = 8;    // parameters listed in a sentence
constexpr std::size_t most_titles = 3;    // significant tests in a sentence
constexpr std::size_t most_expected = 3;  // effects of stated conditions
constexpr std::size_t most_impossible = 2;
constexpr double smallest_effect = 0.01;     // reported, in standard deviations of e
const double steps_of_sd = std::sqrt(12.0);  // rounding step over its standard deviation

/// The parameters of a candidate: "C_x = 3 m". Only fitted values or values stated by a condition
/// are listed; many values are summarised by their range.
std::string parameters_words(const CandidateResult& candidate) {
  std::vector<FoundParameter> all = candidate.parameters;
  if (std::ranges::all_of(all, [](const FoundParameter& p) { return p.sd == 0.0; })) {
    std::erase_if(all, [](const FoundParameter& p) { return !p.stated_by; });
    if (!all.empty()) {
      return joined(all, "; ", [](const FoundParameter& p) {
        return fmt::format("{} = {:.3g}{}, as the {} says", p.label, p.value, unit_suffix(p.unit),
                           condition_words(*p.stated_by));
      });
    }
    all = candidate.parameters;
  }
  std::erase_if(all, [&](const FoundParameter& p) {
    const auto& slots = candidate.candidate.model.slots;
    return std::ranges::any_of(
        slots, [&](const ParameterSlot& slot) { return slot.label() == p.label && !slot.free; });
  });
  if (all.size() > most_values) {
    const auto [low, high] = std::ranges::minmax_element(
        all, [](const auto& a, const auto& b) { return a.value < b.value; });
    return fmt::format("{} values from {} = {:.3g} to {} = {:.3g}", all.size(), low->label,
                       low->value, high->label, high->value);
  }
  return joined(all, ", ", [](const FoundParameter& p) {
    return fmt::format("{} = {}{}", p.label, value_words(p), unit_suffix(p.unit));
  });
}

/// Where the misfit of the base model is largest; empty without a misfit.
std::string where_words(const Diagnosis& d) {
  const MisfitCell* const worst = worst_cell(d);
  if (worst == nullptr) return "";
  const std::string slowest = fmt::format("{:.3g}", worst->slowest);
  const std::string fastest = fmt::format("{:.3g}", worst->fastest);
  return fmt::format(
      "The misfit is largest for {} at {} m/s, where the e of the model is too {} by {:.2g}, "
      "{:.2g} standard errors",
      diameter_words(worst->diameter),
      slowest == fastest ? slowest : fmt::format("{} to {}", slowest, fastest),
      worst->restitution > 0.0 ? "low" : "high", std::abs(worst->restitution),
      std::abs(worst->standardised));
}

/// A mechanism with its title: "gas film (gas between the measuring plane and the contact)".
std::string mechanism_title(const std::string& id) {
  const Mechanism* mechanism = find_mechanism(id);
  return mechanism == nullptr ? words_of(id)
                              : fmt::format("{} ({})", words_of(id), mechanism->info.title);
}

std::string mechanism_titles(const std::vector<std::string>& ids, const char* between) {
  return joined(ids, between, mechanism_title);
}

std::string gain_words(const Diagnosis& d) {
  const HeldOutGain* const gain = d.gain();
  if (!gain || gain->folds.empty()) return "";
  if (!gain->any_chosen()) {
    return "Held-out points cannot test the extended model: without them, too few points are left "
           "to require more than the base model.";
  }
  std::string text = fmt::format(
      "The extended model predicts held-out points with an rms error of {:.3g} in e, the base "
      "model with {:.3g}",
      gain->rmse_extended, gain->rmse_base);
  if (gain->relative < 0.0) {
    text += fmt::format(" ({:.0f} % more)", -100.0 * gain->relative);
  } else if (gain->lower && gain->upper) {
    text += fmt::format(" ({:.0f} % less, 95 % interval {:.0f} to {:.0f} %)",
                        100.0 * gain->relative, 100.0 * *gain->lower, 100.0 * *gain->upper);
  }
  return text + ".";
}

/// The candidate that adds only this mechanism; null if it was not tried.
const CandidateResult* single_named(const Diagnosis& d, const std::string& id) {
  const auto found = std::ranges::find_if(d.candidates, [&](const CandidateResult& c) {
    return c.candidate.added.size() == 1 && c.candidate.added.front() == id;
  });
  return found == d.candidates.end() ? nullptr : &*found;
}

/// Why no experiment in reach separates the causes, and what may.
std::string inseparable_words(const Diagnosis& d) {
  if (has_one_size(d.base.data)) {
    return "Measure spheres of other diameters: causes differ in how their effect depends on size.";
  }
  if (d.next.inseparable.empty()) return "";
  const Inseparable& pair = d.next.inseparable.front();
  return fmt::format(
      "No impacts of these spheres on this surface would separate {} from {}: their e differs by "
      "at "
      "most {:.1g}, less than the errors of their parameters and laws. Measure another pair of "
      "materials, or use another instrument.",
      rival_words(pair.one), rival_words(pair.other), pair.difference);
}

/// The best experiment to separate the causes, or why there is none.
std::string experiment_words(const Diagnosis& d) {
  if (d.next.list.empty()) return inseparable_words(d);
  const NextExperiment& next = d.next.list.front();
  const std::string impacts = fmt::format("{} of {} at {:.3g} m/s", counted(next.events, "impact"),
                                          diameter_words(next.diameter), next.velocity);
  const std::string difference =
      fmt::format("with {}, e is {} there by {:.2g} than with {}{}", rival_words(next.one),
                  next.difference > 0.0 ? "higher" : "lower", std::abs(next.difference),
                  rival_words(next.other), next.expensive() ? "; that is expensive" : "");
  if (next.kind == ExperimentKind::condition) {
    return fmt::format("To decide, {} and measure {}: {}.", next.doing, impacts, difference);
  }
  return fmt::format("To decide, measure {}: {}.", impacts, difference);
}

std::string dominant_point_words(const Diagnosis& d) {
  const std::optional<std::size_t> worst = dominant_point(d);
  if (!worst) return "";
  const Observation& point = d.base.data.points[*worst];
  return fmt::format(
      "Most of the misfit comes from one point, in line {}, of {} at {:.3g} m/s (e = {:.3g}): "
      "check it first.",
      point.line, diameter_words(point.diameter), point.velocity, point.restitution);
}

std::string errors_words(const UnstatedErrors& errors) {
  const std::string p = fmt::format("(p = {:.2g})", errors.remaining_p);
  switch (errors.source) {
    case UnstatedSource::shared_setting:
      return fmt::format(
          "with an error of {:.2g} in e that all points of one setting share, no structure remains "
          "{}; repeats of one setting do not average it out, and setting_sd = {:.2g} under [noise] "
          "includes it in the fit",
          errors.value, p, errors.value);
    case UnstatedSource::velocity_errors:
      return fmt::format(
          "with an error of {:.2g} % in each velocity (velocity_relative_sd = {:.2g} under "
          "[noise]), no structure remains {}",
          100.0 * errors.value, errors.value, p);
    case UnstatedSource::height_readings:
      return fmt::format(
          "with an error of {:.2g} mm in each height (a step of {:.2g} mm), no structure remains "
          "{}; include it in restitution_sd",
          errors.value / units::mm, steps_of_sd * errors.value / units::mm, p);
    case UnstatedSource::time_readings:
      return fmt::format(
          "with an error of {:.2g} ms in each time (a step of {:.2g} ms), no structure remains {}; "
          "include it in restitution_sd",
          errors.value / units::ms, steps_of_sd * errors.value / units::ms, p);
    case UnstatedSource::larger_deviations:
      break;
  }
  return fmt::format("with standard deviations {:.2g} times as large, no structure remains {}",
                     errors.value, p);
}

std::string rival_errors_words(const Diagnosis& d) {
  const std::vector<UnstatedErrors> rivals = rival_errors(d);
  if (rivals.empty()) return "";
  const ExtendedModel* const extended = d.extended();
  const double behind = extended ? rivals.front().delta_aicc - extended->cause.delta_aicc : 0.0;
  return fmt::format(
      "Unstated errors would explain the misfit {}: {}.",
      !extended ? "without any cause"
      : behind > d.options.margin
          ? fmt::format("less well (AICc larger by {:.0f} than with two causes)", behind)
          : "as well",
      joined(rivals, "; ", errors_words));
}

/// The structure in the residuals.
std::string structure_words(const Diagnosis& d) {
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
  return fmt::format("{}", fmt::join(found, ", "));
}

/// A warning about a damping of the base model at its upper bound.
std::string bound_words(const Diagnosis& d) {
  const std::vector<std::size_t> held = held_back_dampings(d.base);
  if (held.empty()) return "";
  const ParameterSlot& slot = d.base.model.slots[held.front()];
  return fmt::format(
      "{} is at its upper bound of {:.3g}{}: widen the bounds before you interpret the misfit.",
      slot.label(), slot.upper, unit_suffix(slot.parameter->unit));
}

/// Why the points cannot test the model; empty if they can.
std::string untested_words(const Diagnosis& d) {
  if (!d.base.weights.noise.known) {
    return "The noise is neither stated nor known from the points, so nothing can be tested.";
  }
  if (tests_the_curve(d)) return "";
  if (evidence_for(d).rebounds == 0) return "No sphere rebounded, so e is unknown.";
  std::set<std::pair<double, double>> places;
  for (const Observation& point : d.base.data.points) {
    places.insert({point.velocity, point.diameter});
  }
  return places.size() == 1 ? "One velocity: the dependence of e on V is unknown."
                            : fmt::format(
                                  "{} pairs of velocity and size determine {} free parameters and "
                                  "cannot also test the curve.",
                                  places.size(), evidence_for(d).free);
}

/// The misfit, or that there is none.
std::string misfit_words(const Diagnosis& d) {
  if (d.structure.tests.empty()) return "";
  const std::string p = p_words(d.structure.p_value, d.structure.simulated);
  if (d.answer_if<Adequate>()) {
    if (!tests_the_curve(d)) {
      return fmt::format("The points scatter about the curve no more than stated ({}).", p);
    }
    if (d.structure.p_value > d.options.level) {
      return fmt::format(
          "The residuals show no structure ({}: the share of data sets simulated with the model "
          "that show as much).",
          p);
    }
  }
  const std::string where = where_words(d);
  if (!where.empty()) return fmt::format("{} ({}).", where, p);
  const std::string found = structure_words(d);
  return fmt::format("The fitted model leaves structure in its residuals ({}){}{}.", p,
                     found.empty() ? "" : ": ", found);
}

/// What the data can decide about several possible causes.
std::string several_words(const Diagnosis& d, const NotSeparable& several) {
  std::string text;
  if (several.law_error) {
    text = fmt::format(
        "An error of the losses of more than {:.0f} % explains this as well as any of them does.",
        100.0 * least_law_error);
  }
  if (has_one_size(d.base.data)) {
    return text + (text.empty() ? "" : " ") +
           "With one diameter, the effect of size is unknown, and causes differ mainly in their "
           "effect of size.";
  }
  if (several.law_error) return text;
  if (!several.shared_cause.empty()) return "These data cannot decide which of its laws holds.";
  const Candidate& best = several.extended.cause.candidate;
  if (!several.alone.empty()) {
    return fmt::format(
        "With two causes together ({}) no structure remains, but one alone ({}) comes so close "
        "that it is as likely if the error of its law is larger than assumed.",
        words_of(best.name()),
        joined(several.alone, ", ", [](const std::string& id) { return words_of(id); }));
  }
  if (best.added.size() > 1) {
    return several.common.empty()
               ? "Two causes are needed together, and these data cannot decide which."
               : "Two causes are needed together.";
  }
  return "A cause that is not listed is possible, too.";
}

/// The causes that the misfit resembles, and why each is not possible.
std::string resembling_words(const Diagnosis& d, const Resembles& shown) {
  const std::string causes = joined(shown.causes, " or ", [&](const std::string& id) {
    const CandidateResult* const cause = single_named(d, id);
    const std::string title = mechanism_title(id);
    return cause == nullptr ? title : fmt::format("{} ({})", title, because_words(*cause));
  });
  return fmt::format(
      "The misfit resembles {}, which cannot be its cause; no plausible cause comes as close.",
      causes);
}

/// The cause that leaves no structure, and why it is not named; empty without one.
std::string doubtful_words(const Diagnosis& d) {
  const CandidateResult* const doubtful = doubtful_cause(d);
  if (doubtful == nullptr) return "";
  return fmt::format(
      "The closest cause is {}, which leaves no structure in the residuals ({}), but is set aside: "
      "{}.",
      mechanism_title(doubtful->candidate.name()), p_words(doubtful->remaining_p, quick_samples),
      doubtful->set_aside ? because_words(*doubtful) : "a cause that is not possible fits better");
}

/// Why no cause is named.
std::string unexplained_words(const Diagnosis& d) {
  if (const auto* shown = d.answer_if<Resembles>()) return resembling_words(d, *shown);
  const std::string doubtful = doubtful_words(d);
  if (series_differ(d)) {
    return doubtful.empty()
               ? "No cause in the catalogue explains the difference: fit each series separately, "
                 "or state the condition in which they differ."
               : doubtful +
                     " Fit each series separately, or state the condition in which they "
                     "differ.";
  }
  if (const auto* errors = d.answer_if<ErrorsTooSmall>()) {
    return fmt::format(
        "A possible cause is {}, but unstated errors explain the misfit as well and assume less, "
        "so no cause is named.",
        words_of(errors->cause));
  }
  if (!rival_errors(d).empty()) return rival_errors_words(d);
  if (dominant_point(d)) return dominant_point_words(d);
  if (!doubtful.empty()) return doubtful;
  if (const CandidateResult* const closest = closest_cause(d)) {
    return fmt::format(
        "No cause in the catalogue explains it. The closest is {}, which explains {:.0f} % of the "
        "misfit and leaves structure in the residuals ({}).",
        mechanism_title(closest->candidate.name()), 100.0 * (1.0 - closest->remaining_part),
        p_words(closest->remaining_p, quick_samples));
  }
  if (!tests_the_curve(d)) return "The points scatter more than their stated standard deviations.";
  if (!d.structure.smooth && !d.base.data.noise.sd_stated) {
    return "No cause in the catalogue explains it, alone or in pairs. No standard deviations are "
           "stated, and errors that points share could leave the same structure.";
  }
  if (!d.structure.smooth) {
    return "No cause in the catalogue explains it, and it has no pattern in velocity and size: the "
           "points scatter more than their stated standard deviations.";
  }
  return "No cause in the catalogue explains it, alone or in pairs.";
}

/// What to do if no cause is named.
std::string advice_words(const Diagnosis& d) {
  if (series_differ(d) || dominant_point(d)) return "";  // unexplained_words gives advice
  if (!rival_errors(d).empty() || !d.structure.smooth) {
    return "State the errors of the measurement (restitution_sd, velocity_sd, setting) and repeat "
           "the diagnosis.";
  }
  if (const CandidateResult* const doubtful = doubtful_cause(d)) {
    return doubtful->set_aside == SetAside::chance ? "More points would decide." : "";
  }
  if (d.free_form_p <= 0.01) {
    return "Check the rows themselves: a smooth function of velocity and size does not describe "
           "the misfit either.";
  }
  return "A smooth function of velocity and size describes it. It may come from an effect outside "
         "the catalogue, from a law that differs from the catalogue's, or from an effect on some "
         "of the points only.";
}

/// A warning that few points could detect a misfit of an adequate model.
std::string evidence_words(const Diagnosis& d) {
  if (!tests_the_curve(d)) return "";  // untested_words says this
  const Evidence evidence = evidence_for(d);
  if (!evidence.hardly_any()) return "";
  return fmt::format(
      "With {} rebounds and {} free parameters, hardly any misfit could be detected: this is no "
      "evidence for the model.",
      evidence.rebounds, evidence.free);
}

/// How the errors of the material constants make the model adequate; empty if they are not needed.
std::string materials_words(const Diagnosis& d, const Adequate& answer) {
  if (!answer.materials) return "";
  std::string moved;
  for (std::size_t k = 0; k < d.base.constants_moved.size(); ++k) {
    const double by = d.base.constants_moved[k];
    constexpr double least_move = 0.5;  // standard deviations
    if (std::abs(by) < least_move) continue;
    moved += fmt::format("{}{} by {:+.1f}", moved.empty() ? ": " : ", ",
                         d.base.model.slots[d.base.model.first_constant() + k].label(), by);
  }
  return fmt::format(
      "The material constants moved within their errors{}{}; with exact constants structure would "
      "remain (p = {:.2g}).",
      moved, moved.empty() ? "" : " standard deviations", answer.materials->p_value_exact);
}

/// The structure that would remain if the laws were exact; empty if none would.
std::string if_exact_words(const Diagnosis& d) {
  if (!d.if_exact || d.if_exact->p_value > d.options.level) return "";
  if (!d.if_exact->named.empty()) {
    return fmt::format("If the laws were exact, the cause would be {}.",
                       mechanism_titles(d.if_exact->named, " and "));
  }
  if (!d.answer_if<Adequate>()) return "";
  if (d.structure.p_value <= d.options.level) {
    return "A smooth error of the laws explains this better than any cause in the catalogue.";
  }
  const std::vector<std::string>& ids = d.if_exact->listed;
  return fmt::format("If the laws were exact, structure would remain ({}){}.",
                     p_words(d.if_exact->p_value, quick_samples),
                     ids.empty() ? ", unlike any cause in the catalogue"
                                 : ", most similar to " + cause_words(ids, " or "));
}

/// The odds for the best cause against an error of the laws; empty without a cause.
std::string odds_words(const Diagnosis& d) {
  const ExtendedModel* const extended = d.extended();
  if (extended == nullptr || !(extended->cause.delta_aicc < 0.0)) return "";
  constexpr double most = 1e6;
  const double odds = std::exp(-0.5 * extended->cause.delta_aicc);
  return fmt::format("The odds for {} against an error of the laws alone are {} to 1.",
                     words_of(extended->cause.candidate.name()),
                     odds > most ? "more than a million" : fmt::format("{:.2g}", odds));
}

/// How well these points can tell the cause from its nearest rival; empty without a single cause.
std::string separation_words(const Diagnosis& d) {
  std::vector<std::string> ids = d.named().empty() ? d.rivals() : d.named();
  if (ids.empty() && d.if_exact) ids = d.if_exact->named;
  if (ids.empty()) return "";
  const auto cause = std::ranges::find(d.candidates, ids.front(),
                                       [](const CandidateResult& c) { return c.candidate.name(); });
  if (cause == d.candidates.end() || !cause->separation || !cause->separation_allowed) return "";
  const auto& [exact, allowed] = std::pair(*cause->separation, *cause->separation_allowed);
  const std::string other =
      allowed.rival == exact.rival ? "" : fmt::format(" (then {})", words_of(allowed.rival));
  return fmt::format(
      "These points can separate {} from its nearest rival, {}, with probability {:.2f} if the "
      "laws are exact, {:.2f} if they err by 10 %{}.",
      words_of(ids.front()), words_of(exact.rival), exact.probability, allowed.probability, other);
}

/// The error rates of the diagnosis for this design: one sentence for each cause and one for false
/// alarms.
std::vector<std::string> rates_words(const Diagnosis& d) {
  std::vector<std::string> words;
  if (!d.own_design) return words;
  const auto share = [](int part, int whole) {
    return fmt::format("{:.0f} %", 100.0 * part / whole);
  };
  for (const Detection& one : d.own_design->detection) {
    words.push_back(fmt::format(
        "With these {} points recoil would have named {} in {} of cases where it {}, listed it "
        "among others in {}, and named something else in {} ({} simulated data sets).",
        d.base.data.points.size(), words_of(one.id), share(one.named, one.datasets),
        one.strength == 1.0 ? std::string("acts as found")
                            : fmt::format("has {:.2g} of the effect found", one.strength),
        share(one.listed, one.datasets), share(one.wrong, one.datasets), one.datasets));
  }
  words.push_back(
      fmt::format("Where nothing acts beside the model it would have seen something in {} of cases "
                  "({} simulated data sets).",
                  share(d.own_design->alarms, d.own_design->datasets), d.own_design->datasets));
  return words;
}

/// The median standard deviation of e.
double typical_error(const Diagnosis& d) {
  std::vector<double> errors;
  for (const PointWeights& own : d.base.weights.points) errors.push_back(own.sd);
  return median(std::move(errors));
}

/// The effects of the stated conditions, the largest first.
std::vector<std::string> expected_words(const Diagnosis& d) {
  std::vector<std::string> words;
  for (const ExpectedEffect& effect : d.expected) {
    if (words.size() == most_expected) break;
    if (std::abs(effect.change) < smallest_effect * typical_error(d)) break;
    words.push_back(fmt::format(
        "At the stated {} of {:.4g}{}, {} changes e by {:+.2g} at most ({} at {:.3g} m/s).",
        condition_words(effect.condition), effect.stated,
        unit_suffix(info_of(effect.condition).unit), mechanism_title(effect.id), effect.change,
        diameter_words(effect.diameter), effect.velocity));
  }
  return words;
}

/// Candidates that gain as much as the answer but are not possible.
std::vector<std::string> impossible_words(const Diagnosis& d) {
  std::vector<std::string> words;
  const ExtendedModel* const extended = d.extended();
  const double answer = extended ? extended->cause.delta_aicc + d.options.margin : 0.0;
  const std::vector<std::string> rivals = d.rivals();
  const std::vector<std::string> resembles = d.resembles();
  for (const CandidateResult& c : d.candidates) {
    const bool in_answer = std::ranges::find(resembles, c.candidate.name()) != resembles.end();
    if (in_answer || c.plausible || c.delta_aicc >= answer) continue;
    if (words.size() == most_impossible) break;
    const bool listed = std::ranges::find(rivals, c.candidate.name()) != rivals.end();
    words.push_back(
        plain_text(as_sentence(listed ? say("{} is listed though hardly plausible ({})",
                                            words_of(c.candidate.name()), set_aside_words(c))
                                      : say("{} is set aside because {}",
                                            words_of(c.candidate.name()), because_words(c)))));
  }
  return words;
}

std::string verdict_words(const AnswerForAll& answer) {
  const std::string verdict = to_string(answer.verdict);
  const std::vector<std::string>& ids = !answer.named.empty()    ? answer.named
                                        : !answer.rivals.empty() ? answer.rivals
                                                                 : answer.resembles;
  return ids.empty() ? verdict : fmt::format("{} ({})", verdict, fmt::join(ids, ", "));
}

/// The causes that a stated method of velocity measurement would exclude.
std::string method_words(const Diagnosis& d) {
  const bool unknown = std::ranges::any_of(
      d.datasets, [](const Dataset& dataset) { return dataset.system.method == Method::unknown; });
  std::vector<std::string> words;
  for (const std::string& id : d.causes()) {
    const Mechanism* const mechanism = find_mechanism(id);
    if (mechanism == nullptr || mechanism->info.methods.empty()) continue;
    words.push_back(fmt::format(
        "{} only with {}", words_of(id),
        joined(mechanism->info.methods, " or ", [](Method m) { return words_of(to_string(m)); })));
  }
  if (!unknown || words.empty()) return "";
  return fmt::format(
      "The dataset does not state how velocities were measured, which would exclude some causes: "
      "{}.",
      fmt::join(words, ", "));
}

/// The outlying points, and the verdict with them; empty if there are none.
std::string outlying_words(const Diagnosis& d) {
  if (d.outlying.empty()) return "";
  const std::string rows = joined(d.outlying, "; ", [&](const OutlyingPoint& point) {
    return fmt::format(
        "line {}{} ({} at {:.3g} m/s, e = {:.3g}: {:+.1f} standard deviations)", point.line,
        d.datasets.size() > 1 ? " of " + d.datasets[point.dataset].id : "",
        diameter_words(point.diameter), point.velocity, point.restitution, point.residual);
  });
  const bool one = d.outlying.size() == 1;
  return fmt::format(
      "{} so far from the prediction of the others that {} set aside: {}. With {} the verdict "
      "would be {}.",
      one ? "One point lies" : fmt::format("{} points lie", d.outlying.size()),
      one ? "it was" : "they were", rows, one ? "it" : "them", verdict_words(*d.for_all));
}

}  // namespace

std::vector<std::string> answer_sentences(const Diagnosis& d) {
  std::vector<std::string> sentences = {outlying_words(d), bound_words(d), misfit_words(d),
                                        untested_words(d)};
  if (const auto* adequate = d.answer_if<Adequate>()) {
    sentences.push_back(evidence_words(d));
    sentences.push_back(materials_words(d, *adequate));
  } else if (d.answer_if<CauseNamed>()) {
    const std::vector<std::string> named = d.named();
    sentences.push_back(fmt::format("Of all mechanisms in the catalogue, only {} {}.",
                                    mechanism_titles(named, " and "),
                                    named.size() == 1 ? "explains it" : "together explain it"));
    sentences.push_back(gain_words(d));
  } else if (const auto* several = d.answer_if<NotSeparable>()) {
    sentences.push_back(several_words(d, *several));
  } else {
    sentences.push_back(unexplained_words(d));
    sentences.push_back(advice_words(d));
  }
  sentences.push_back(if_exact_words(d));
  if (d.answer_if<NotSeparable>() || !d.next.list.empty()) {
    sentences.push_back(experiment_words(d));
  }
  std::erase(sentences, "");
  const std::vector<std::string> rates = rates_words(d);
  sentences.insert(sentences.end(), rates.begin(), rates.end());
  return sentences;
}

std::vector<std::string> answer_notes(const Diagnosis& d) {
  std::vector<std::string> notes;
  const auto add = [&](const std::vector<std::string>& more) {
    notes.insert(notes.end(), more.begin(), more.end());
  };
  if (const ExtendedModel* const extended = d.extended()) {
    notes.push_back(fmt::format("The extended model adds {}: {}.",
                                words_of(extended->cause.candidate.name()),
                                parameters_words(extended->cause)));
    if (!d.answer_if<CauseNamed>()) notes.push_back(gain_words(d));
  }
  notes.push_back(odds_words(d));
  notes.push_back(separation_words(d));
  if (!d.answer_if<Unexplained>()) notes.push_back(rival_errors_words(d));
  const bool shown = !d.answer_if<Adequate>() && !where_words(d).empty();
  if (const std::string found = structure_words(d); shown && !found.empty()) {
    notes.push_back(fmt::format("Structure in the residuals: {}.", found));
  }
  add(expected_words(d));
  if (!d.answer_if<Adequate>()) {
    add(impossible_words(d));
    notes.push_back(method_words(d));
  }
  std::erase(notes, "");
  return notes;
}

std::string answer_words(const Diagnosis& d) {
  std::vector<std::string> all = answer_sentences(d);
  for (std::string& note : answer_notes(d)) all.push_back(std::move(note));
  return fmt::format("{}", fmt::join(all, " "));
}

}  // namespace recoil
