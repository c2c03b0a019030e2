#include "report/words_diagnosis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "data/text.hpp"
#include "document/number.hpp"
#include "document/sentence.hpp"
#include "mechanism/mechanism.hpp"
#include "report/format.hpp"
#include "report/words_verdict.hpp"

namespace recoil {

std::string p_words(double p, int simulated) {
  const double smallest = 1.0 / (simulated + 1.0);
  return p <= smallest * 1.001 ? fmt::format("p < {:.2g}", 2.0 * smallest)
                               : fmt::format("p = {:.2g}", p);
}

std::string condition_words(Condition condition) {
  return words_of(std::string(name_of(condition)));
}

std::string doing_words(const NextExperiment& experiment) {
  const std::string doing =
      experiment.kind == ExperimentKind::condition ? std::string(experiment.doing) : "more impacts";
  return experiment.expensive() ? doing + " (expensive)" : doing;
}

std::string rival_words(const std::string& name) {
  return name == law_error_as_rival ? "an error of the laws" : words_of(name);
}

std::string words_of(StructureQuestion question) {
  using enum StructureQuestion;
  static constexpr Phrase<StructureQuestion> phrases[] = {
      {scatter, "the residuals are larger than the stated deviations"},
      {size, "whole diameters lie above or below the model"},
      {trend, "residuals rise or fall with velocity"},
      {curvature, "residuals bend with velocity"},
      {capture, "the slowest points lie above or below the model"},
      {runs, "neighbouring points miss on the same side"},
      {smooth, "a smooth function of velocity and size describes the residuals"},
      {cause, "the residuals have the shape of a cause in the catalogue"}};
  return phrase_for(phrases, question).words;
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

std::vector<std::string> diagnosis_warnings(const Diagnosis& d) {
  std::vector<std::string> warnings;
  if (simulations_failed(d.structure)) {
    warnings.push_back(fmt::format(
        "{} of {} simulated data sets could not be fitted; the p-values follow from the others",
        d.structure.failed, d.structure.failed + d.structure.simulated));
  }
  if (const ExtendedModel* extended = d.extended(); extended && !extended->fit) {
    warnings.push_back("the fit of the extended model failed: " + extended->failure);
  }
  return warnings;
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

namespace {

std::string cause_of(const NotSeparable& d, const std::string& lead) {
  if (d.law_error) {
    return fmt::format("An error of the laws, or a cause that these data cannot tell from it: {}",
                       cause_words(d.rivals, " or "));
  }
  if (!d.shared_cause.empty()) {
    return fmt::format("{}: {}, by one of several laws ({})", lead, d.shared_cause,
                       cause_words(d.rivals));
  }
  std::vector<std::string> doubtful = d.rivals;
  std::erase_if(doubtful, [&](const std::string& id) {
    return std::ranges::find(d.common, id) != d.common.end();
  });
  if (!d.common.empty() && !doubtful.empty()) {
    return fmt::format("{}: {}, together with {}", lead, cause_words(d.common),
                       cause_words(doubtful, " or "));
  }
  if (d.rivals.size() == 1) {
    return fmt::format("{} may be {}, but these data cannot decide", lead, cause_words(d.rivals));
  }
  return fmt::format("{}, one of several that these data cannot separate: {}", lead,
                     cause_words(d.rivals, " or "));
}

/// The headline if nothing is named although a cause leaves no structure.
std::string doubtful_headline(const CandidateResult& doubtful, const std::string& lead) {
  const std::string name = words_of(doubtful.candidate.name());
  if (doubtful.set_aside != SetAside::chance) {
    return fmt::format("No cause is accepted: {} leaves no structure, but is set aside", name);
  }
  return fmt::format("{} may be {}, but chance gains as much in {:.0f} % of data sets", lead, name,
                     100.0 * doubtful.p_value.value_or(1.0));
}

/// The alternative to errors of the measurement: "the cause may be gas film".
std::string other_than_errors(const Diagnosis& d) {
  if (const auto* errors = d.answer_if<ErrorsTooSmall>()) {
    return "the cause may be " + words_of(errors->cause);
  }
  const CandidateResult* const doubtful = doubtful_cause(d);
  return doubtful == nullptr ? "the cause is not in the catalogue"
                             : "the cause may be " + words_of(doubtful->candidate.name());
}

/// What the cause explains, by the verdict.
std::string lead_words(const Diagnosis& d) {
  const ModelVerdict verdict =
      d.fitted ? judge_model(*d.fitted).verdict : ModelVerdict::does_not_fit;
  switch (verdict) {
    case ModelVerdict::does_not_fit:
      return "Cause of the misfit";
    case ModelVerdict::fits_within_law_error:
      return "Cause of the error of the laws";
    case ModelVerdict::fits:
    case ModelVerdict::fits_with_moved_constants:
    case ModelVerdict::untested:
      break;
  }
  return "Cause of structure in the residuals";
}

}  // namespace

std::string cause_headline(const Diagnosis& d) {
  const std::string lead = lead_words(d);
  switch (d.verdict()) {
    case Verdict::adequate:
      return "";
    case Verdict::cause_named:
      return lead + ": " + cause_words(d.named());
    case Verdict::not_separable:
      return cause_of(std::get<NotSeparable>(d.answer), lead);
    case Verdict::unexplained:
      if (repeats_scatter(d)) return "The points scatter more than their stated errors";
      if (d.answer_if<Resembles>() != nullptr) {
        return "No cause in the catalogue explains the residuals";
      }
      if (series_differ(d)) return "The series differ, and the model has one curve for all of them";
      if (!tests_the_curve(d)) return "The points scatter more than their stated errors";
      if (rival_errors(d).empty()) {
        const CandidateResult* const doubtful = doubtful_cause(d);
        return doubtful == nullptr ? "No cause in the catalogue explains the residuals"
                                   : doubtful_headline(*doubtful, lead);
      }
      return fmt::format(
          "Either {}, or {}",
          d.base.data.noise.sd_stated ? "the errors are larger than stated" : "points share errors",
          other_than_errors(d));
  }
  return "";
}

Sentence headline(const Diagnosis& d) {
  Sentence text = d.fitted ? verdict_sentence(*d.fitted) : Sentence();
  const std::string cause = cause_headline(d);
  if (!cause.empty()) text += say("{}{}.", text.empty() ? "" : " ", cause);
  return text;
}

}  // namespace recoil
