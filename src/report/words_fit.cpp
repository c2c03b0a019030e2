#include "report/words_fit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/words_noise.hpp"

namespace recoil {
namespace {

void add_about_data(const Observations& data, std::vector<Sentence>& warnings) {
  if (data.sd_stated) return;
  if (data.sd_set_aside > 0) {
    warnings.push_back(fmt::format(
        "the standard deviations that {} points state (restitution_sd) are set aside: {}",
        data.sd_set_aside,
        data.spec.variance ? "the fit asks for an estimated variance function"
                           : fmt::format("{} others state none, and two kinds of weights would not "
                                         "be comparable",
                                         data.sd_missing)));
  }
  warnings.emplace_back(
      "the noise is estimated from the residuals: the fit cannot be tested against it");
}

void add_about_starts(const FitResult& fitted, std::vector<Sentence>& warnings) {
  for (const StartSummary& start : fitted.starts) {
    for (const std::size_t j : start.differing) {
      warnings.push_back(
          say("tie: another start ends with the same chi2 at {} = {:.4g} instead of {:.4g}",
              symbol(fitted.model.slots[j].label()), start.end[j], fitted.best_start().end[j]));
    }
  }
  const auto count = [&](StartOutcome outcome) {
    return std::count_if(fitted.starts.begin(), fitted.starts.end(),
                         [&](const StartSummary& start) { return start.outcome == outcome; });
  };
  const auto unfinished =
      std::count_if(fitted.starts.begin(), fitted.starts.end(),
                    [](const StartSummary& start) { return start.ending == DescentEnd::limit; });
  if (unfinished > 0) {
    warnings.push_back(
        fmt::format("{} of {} starts were still under way when their iterations ran out",
                    unfinished, fitted.starts.size()));
  }
  if (const auto failed = count(StartOutcome::not_converged) - unfinished; failed > 0) {
    warnings.push_back(
        fmt::format("{} of {} starts did not converge", failed, fitted.starts.size()));
  }
  if (const auto flat = count(StartOutcome::flat); flat > 0 && fitted.flat.empty()) {
    warnings.push_back(
        fmt::format("{} of {} starts ended where the points do not depend on one of the parameters",
                    flat, fitted.starts.size()));
  }
  if (const auto worse = count(StartOutcome::worse); worse > 0) {
    warnings.push_back(
        fmt::format("{} of {} starts ended in a worse local minimum", worse, fitted.starts.size()));
  }
}

void add_about_bounds(const FitResult& fitted, std::vector<Sentence>& warnings) {
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    if (!fitted.at_bound[j]) continue;
    const ParameterSlot& slot = fitted.model.slots[j];
    const bool low = fitted.theta[j] <= 0.5 * (slot.lower + slot.upper);
    warnings.push_back(
        say("{} rests on its {} bound {:.4g} {}: it has no symmetric error, and the errors of the "
            "others are conditional on it",
            symbol(slot.label()), low ? "lower" : "upper", low ? slot.lower : slot.upper,
            unit(slot.parameter->unit)));
  }
}

void add_about_idle_mechanisms(const ImpactModel& model, std::vector<Sentence>& warnings) {
  for (const Mechanism* mechanism : model.chain) {
    const auto idle =
        std::count_if(model.surroundings.begin(), model.surroundings.end(),
                      [&](const Surroundings& at) { return !mechanism->acts_at(at); });
    if (idle == 0) continue;
    warnings.push_back(fmt::format(
        "{} does nothing in {} of {} datasets, whose work of adhesion is 0 (it is a multiple of "
        "it): {}",
        mechanism->info.id, idle, model.surroundings.size(),
        static_cast<std::size_t>(idle) == model.surroundings.size()
            ? "leave it out, or state adhesion_energy"
            : "its parameter rests on the others"));
  }
}

}  // namespace

std::vector<Sentence> fit_warnings(const FitResult& fitted) {
  std::vector<Sentence> warnings;
  add_about_data(fitted.data, warnings);
  add_about_idle_mechanisms(fitted.model, warnings);
  if (fitted.unused_counts) {
    warnings.push_back(
        fmt::format("{} how the impacts of a point differ: the counts of captured spheres at {} "
                    "points with rebounds are not used in addition",
                    fitted.unused_counts->mechanism == nullptr
                        ? std::string("the stated sizes say")
                        : fmt::format("{} says", fitted.unused_counts->mechanism->info.id),
                    fitted.unused_counts->points));
  }
  if (!fitted.usable) return warnings;
  if (!fitted.weights_at_rest) {
    warnings.emplace_back(
        "the weights of the points had not settled in the last round of reweighting: the estimate "
        "depends on where they stopped");
  }
  if (fitted.noise_verdict == NoiseVerdict::exceeded) warnings.push_back(widened_words(fitted));
  if (fitted.strained_points > 0) {
    warnings.push_back(fmt::format(
        "at {} points the curve bends so much over the errors of velocity or diameter that their "
        "effective variance (first order) is biased by more than {:.1g} standard deviations: close "
        "to capture these errors are too large for that approximation",
        fitted.strained_points, strained_bias));
  }
  if (!fitted.flat.empty()) {
    std::vector<Sentence> names;
    for (const std::size_t j : fitted.flat) names.push_back(symbol(fitted.model.slots[j].label()));
    warnings.push_back(
        say("the fit ended where the points do not depend on {}: such a value means nothing, and "
            "there are no standard errors; begin elsewhere (initial) or do not fit it (free = "
            "false)",
            join(names, ", ")));
  } else if (fitted.covariance.empty()) {
    warnings.emplace_back(
        "the points do not determine all free parameters (J'J is singular): no standard errors");
  }
  add_about_starts(fitted, warnings);
  add_about_bounds(fitted, warnings);
  return warnings;
}

}  // namespace recoil
