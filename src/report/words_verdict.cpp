#include "report/words_verdict.hpp"

#include <fmt/format.h>

#include <cmath>

#include "data/text.hpp"
#include "report/format.hpp"
#include "report/words_fit.hpp"

namespace recoil {

std::string law_error_range(const LawErrorEstimate& laws) {
  return laws.seen() ? fmt::format("{:.2g} [{:.2g}, {:.2g}] %", 100.0 * laws.median,
                                   100.0 * laws.lower, 100.0 * laws.upper)
                     : fmt::format("below {:.2g} %", 100.0 * laws.upper);
}

namespace {

/// "f0 is 6.4 N/m, and the materials give 9.5 N/m", or by how much a constant moved.
Sentence moved_constant_words(const FitResult& fitted, std::size_t constant) {
  const ImpactModel& model = fitted.model;
  for (std::size_t d = 0; d < model.contacts.size(); ++d) {
    if (!follows_materials(model, d)) continue;
    const ParameterSlot& slot = model.slots[model.slot_adhesion[d]];
    const bool is_f0 = slot.parameter->role == ParameterRole::adhesion_force;
    const Sentence name = symbol(slot.label());
    return say("{} is {:.3g} {}, and the stated materials give {:.3g} {}",
               is_f0 ? with_its_size(fitted, name) : name,
               adhesion_value_under(model, fitted.theta, d), unit(slot.parameter->unit),
               derived_adhesion(model, d), unit(slot.parameter->unit));
  }
  return say("{} is {:+.1f} standard deviations from its stated value",
             model.slots[model.first_constant() + constant].label(),
             fitted.constants_moved[constant]);
}

Sentence untested_words(const FitResult& f, const ModelJudgement& judged) {
  if (!f.weights.noise.known) {
    return say("The fit cannot be tested: its noise is not known ({}).", unknown_noise_reason(f));
  }
  if (f.dof <= 0) return "The fit cannot be tested: there are no more points than parameters.";
  if (f.data.noise.sd_stated && tests_the_curve(f)) {
    return "The fit cannot be tested: chi-square is not known.";
  }
  if (f.data.noise.sd_stated) {
    return say(
        "The points cannot test the model: there are no more pairs of velocity and size than free "
        "parameters. They scatter no more than stated ({}).",
        p_words(*judged.p_value));
  }
  if (judged.laws) {
    return say(
        "The points state no standard deviations, so that they can only show an error of the laws "
        "that is smooth.");
  }
  return say(
      "The rms residual of {e} is {}; without stated standard deviations the fit cannot be tested.",
      number(f.rmse, 2));
}

Sentence rejected_words(const FitResult& f, const ModelJudgement& judged) {
  const std::string p = p_words(f.p_value);
  const Sentence laws =
      judged.laws && judged.laws->seen()
          ? say(", even with laws wrong by {} of the loss", law_error_range(*judged.laws))
          : Sentence();
  if (f.noise_verdict == NoiseVerdict::exceeded && f.noise_scale == 1.0) {
    return say(
        "The model does not fit{}: its constants or laws would be off by more than their errors "
        "({}).",
        laws, p);
  }
  if (f.noise_verdict == NoiseVerdict::exceeded) {
    return say(
        "The model does not fit{}: the residuals are {} times {} ({}), and all intervals are "
        "widened by this factor.",
        laws, number(f.noise_scale, 3), noise_name(f), p);
  }
  return say("The model does not fit{}: chi-square is {} on {} degrees of freedom ({}).", laws,
             number(f.chi2, 4), f.dof, p);
}

}  // namespace

Sentence law_error_words(const ModelJudgement& judged) {
  if (!judged.laws) return {};
  if (judged.laws->seen()) {
    return say("The laws are wrong by {} of the loss.", law_error_range(*judged.laws));
  }
  return say("No error of the laws is seen: {} of the loss.", law_error_range(*judged.laws));
}

Sentence verdict_sentence(const FitResult& fitted) {
  const ModelJudgement judged = judge_model(fitted);
  const std::string p = judged.p_value ? p_words(*judged.p_value) : "";
  Sentence text;
  switch (judged.verdict) {
    case ModelVerdict::fits:
      text = *judged.p_value > 0.99
                 ? say("The model fits; the points scatter less than stated ({}).", p)
                 : say("The model {} ({}).", *judged.p_value < 0.05 ? "barely fits" : "fits", p);
      break;
    case ModelVerdict::fits_with_moved_constants:
      text = say("The model fits ({}) within the errors of the materials: {}.", p,
                 moved_constant_words(fitted, *judged.moved));
      break;
    case ModelVerdict::fits_within_law_error:
      text = say("The model fits if its laws are wrong by {} of the loss{}.",
                 law_error_range(*judged.laws),
                 p.empty() ? "" : "; with exact laws it does not (" + p + ")");
      break;
    case ModelVerdict::does_not_fit:
      text = rejected_words(fitted, judged);
      break;
    case ModelVerdict::untested:
      text = untested_words(fitted, judged);
      break;
  }
  const bool said =
      judged.verdict == ModelVerdict::fits_within_law_error ||
      (judged.verdict == ModelVerdict::does_not_fit && judged.laws && judged.laws->seen());
  if (judged.laws && !said) text += say(" {}", law_error_words(judged));
  return text;
}

}  // namespace recoil
