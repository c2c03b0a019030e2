#include "report/words_candidate.hpp"

#include <fmt/format.h>

#include "data/text.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

/// Why a candidate is set aside, for a table and for a sentence. {} is the p-value of the remaining
/// structure.
struct SetAsideReason {
  SetAside value;
  const char* brief;
  const char* full;
};

const SetAsideReason& reason_of(SetAside why) {
  using enum SetAside;
  static constexpr SetAsideReason reasons[] = {
      {description, "a description", "it is a description, not a cause"},
      {gains_too_little, "gains too little", "it gains less than its parameters cost"},
      {chance, "gains no more than chance", ""},
      {not_possible, "not possible", ""},
      {batch_is_size, "may be an effect of size",
       "every series has its own diameter and the offsets vary smoothly with it, so batch offsets "
       "and an unknown effect of size look alike"},
      {within_a_step, "may be rounding",
       "the heights were rounded to a step, and rounding looks like an error of up to half a step"},
      {leaves_structure, "leaves structure (p = {:.2g})",
       "structure remains in the residuals (p = {:.2g})"},
      {predicts_no_better, "predicts no better",
       "it predicts held-out sizes or targets no better than the base model"},
      {one_suffices, "one is enough", "one of the two explains the misfit as well alone"},
      {second_adds_little, "one contributes too little",
       "structure remains in the residuals (p = {:.2g}), and one of the two explains no more of "
       "the misfit than an error in the law of the other could"},
      {at_limit, "parameter at its limit", "a parameter lies at the limit of what is possible"},
      {far_behind, "far behind", "at a first look, other pairs fit better"}};
  return phrase_for(reasons, why);
}

}  // namespace

std::string value_words(const FoundParameter& p) {
  return p.sd > 0.0 ? fmt::format("{:.3g} +/- {:.2g}", p.value, p.sd)
                    : fmt::format("{:.3g}", p.value);
}

std::string implausible_words(const FoundParameter& parameter) {
  if (parameter.plausible()) return "";
  const std::string value = fmt::format("{} = {}{}", parameter.label, value_words(parameter),
                                        unit_suffix(parameter.unit));
  if (parameter.limit == nullptr) {
    return fmt::format("{} lies outside {:.3g} to {:.3g}: {}", value, parameter.lower,
                       parameter.upper, parameter.range_why);
  }
  const PlausibleLimit& limit = *parameter.limit;
  const bool above = parameter.quantity > limit.upper;
  return fmt::format("{}: the {} would be {:.2g}, but is at {} {:g}: {}", value, limit.quantity,
                     parameter.quantity, above ? "most" : "least",
                     above ? limit.upper : limit.lower, limit.why);
}

std::string because_words(const CandidateResult& c) {
  const SetAside why = c.set_aside.value_or(SetAside::not_possible);
  if (why == SetAside::chance) {
    return fmt::format(
        "by chance alone the best of all candidates gains as much in {:.0f} % of data sets",
        100.0 * c.p_value.value_or(1.0));
  }
  if (why != SetAside::not_possible) {
    return fmt::format(fmt::runtime(reason_of(why).full), c.remaining_p);
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

std::string set_aside_words(const CandidateResult& c) {
  if (c.set_aside == SetAside::not_possible) return "not possible: " + because_words(c);
  return c.explains() ? "" : because_words(c);
}

std::string short_set_aside_words(const CandidateResult& c) {
  if (c.explains() || !c.set_aside) return "";
  return fmt::format(fmt::runtime(reason_of(*c.set_aside).brief), c.remaining_p);
}

}  // namespace recoil
