#include "report/words_diagnosis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "data/text.hpp"
#include "document/sentence.hpp"
#include "mechanism/mechanism.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_values = 8;  // of parameters

/// "3.1", "3.1 +/- 0.2"
std::string value_words(const FoundParameter& p) {
  return p.sd > 0.0 ? fmt::format("{:.3g} +/- {:.2g}", p.value, p.sd)
                    : fmt::format("{:.3g}", p.value);
}

}  // namespace

std::string p_words(double p, int simulated) {
  const double smallest = 1.0 / (simulated + 1.0);
  return p <= smallest * 1.001 ? fmt::format("p < {:.2g}", 2.0 * smallest)
                               : fmt::format("p = {:.2g}", p);
}

std::string condition_words(Condition condition) {
  return words_of(std::string(name_of(condition)));
}

std::string doing_words(const NextExperiment& experiment) {
  return experiment.kind == ExperimentKind::condition ? std::string(experiment.doing)
                                                      : "more impacts";
}

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
    case SetAside::within_a_step:
      return "the readings lie on steps of a height, and rounding to a step passes for an error of "
             "up to half of it";
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
    if (parameter.plausible()) continue;
    const std::string words = implausible_words(parameter);
    if (!(c.cost_of_possible > 0.0)) return words;
    return fmt::format("{}; with a possible value it fits worse by {:.0f} in AICc", words,
                       c.cost_of_possible);
  }
  return "";
}

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

std::string cause_words(const std::vector<std::string>& ids, const char* between) {
  constexpr std::size_t most = 5;
  std::vector<std::string> words;
  for (const std::string& id : ids) {
    if (words.size() < most) words.push_back(words_of(id));
  }
  const std::size_t more = ids.size() - words.size();
  return fmt::format("{}{}", fmt::join(words, between),
                     more > 0 ? fmt::format(" and {} more", more) : std::string());
}

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
  if (c.explains() || !c.set_aside) return "";
  switch (*c.set_aside) {
    case SetAside::description:
      return "a description";
    case SetAside::gains_too_little:
      return "gains too little";
    case SetAside::chance:
      return "gains no more than chance";
    case SetAside::not_possible:
      return "not possible";
    case SetAside::batch_is_size:
      return "may be a law of size";
    case SetAside::within_a_step:
      return "may be rounding";
    case SetAside::leaves_structure:
      return fmt::format("leaves structure (p = {:.2g})", c.remaining_p);
    case SetAside::predicts_no_better:
      return "predicts no better";
    case SetAside::one_would_do:
      return "one would do";
    case SetAside::one_hardly_takes_part:
      return "one hardly takes part";
    case SetAside::at_the_edge:
      return "at the limit of the possible";
    case SetAside::far_behind:
      return "far behind";
  }
  return "";
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
      "The model is furthest off for {} at {:.3g} to {:.3g} m/s, where e is too {} by {:.2g}, "
      "{:.2g} "
      "standard errors",
      diameter_words(worst->diameter), worst->slowest, worst->fastest,
      worst->restitution > 0.0 ? "low" : "high", std::abs(worst->restitution),
      std::abs(worst->standardised));
}

}  // namespace recoil
