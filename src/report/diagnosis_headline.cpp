#include "report/diagnosis_headline.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/diagnosis_result.hpp"
#include "document/number.hpp"
#include "report/format.hpp"
#include "report/words_diagnosis.hpp"

namespace recoil {
namespace {

std::string headline_of_several(const Diagnosis& d) {
  if (!d.shared_cause.empty()) {
    return fmt::format("What the model misses: {}, by one of several laws ({})", d.shared_cause,
                       cause_words(d.rivals));
  }
  std::vector<std::string> doubtful = d.rivals;
  std::erase_if(doubtful, [&](const std::string& id) {
    return std::find(d.common.begin(), d.common.end(), id) != d.common.end();
  });
  if (!d.common.empty() && !doubtful.empty()) {
    return fmt::format("What the model misses: {}, together with {}", cause_words(d.common),
                       cause_words(doubtful, " or "));
  }
  if (d.rivals.size() == 1) {
    return fmt::format("The model misses something that could be {}, but these data cannot tell",
                       cause_words(d.rivals));
  }
  return "The model misses something, and these data cannot tell what: " + cause_words(d.rivals);
}

}  // namespace

std::string headline(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::adequate:
      if (!tests_the_curve(d)) return "These points cannot test the model";
      return d.base.noise_verdict == NoiseVerdict::exceeded && d.spec.law_error > 0.0
                 ? fmt::format("The model describes these points, if its laws may be wrong by {}",
                               percent(d.spec.law_error))
                 : "The model describes these points";
    case Verdict::cause_named:
      return "What the model misses: " + cause_words(d.named);
    case Verdict::not_separable:
      return headline_of_several(d);
    case Verdict::unexplained:
      if (!d.resembles.empty()) {
        return fmt::format("The misfit has the shape of {}, which cannot be its cause",
                           cause_words(d.resembles, " or "));
      }
      if (series_differ(d)) return "The series differ, and the model has one curve for all of them";
      if (!tests_the_curve(d)) return "The points scatter more than their stated errors";
      return rival_errors(d).empty()
                 ? "The model misses something that nothing in the catalogue explains"
                 : "Either the errors are larger than stated, or the model misses something that "
                   "nothing in the catalogue explains";
  }
  return "";
}

}  // namespace recoil
