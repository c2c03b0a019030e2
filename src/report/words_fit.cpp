#include "report/words_fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "data/text.hpp"
#include "estimate/input_errors.hpp"
#include "estimate/noise_doubt.hpp"
#include "estimate/reweighting.hpp"
#include "estimate/setting_error.hpp"
#include "impact/adhesion_law.hpp"
#include "report/format.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

using Sentences = std::vector<Sentence>;

/// A difference in -2 ln likelihood, a likelihood ratio of about 7 to 1, from which the choice of a
/// variance function is called clear.
constexpr double clear = 4.0;

// ---- noise -------------------------------------------------------------------------------------

std::string variance_words(const FitResult& fitted) {
  const Noise& noise = fitted.weights.noise;
  const std::string text =
      "estimated from the residuals: " + scale_words(noise.variance, noise.scale);
  if (fitted.data.noise.spec.variance || noise.candidates.empty()) return text;
  std::vector<std::string_view> others;
  for (const Noise::Candidate& candidate : noise.candidates) {
    if (candidate.function != noise.variance) others.push_back(name_of(candidate.function));
  }
  const double margin = choice_margin(noise);
  return text + fmt::format(" ({}, chosen over {} by {:.1f} in -2 ln restricted likelihood{})",
                            name_of(noise.variance), fmt::join(others, " and "), margin,
                            margin < clear ? ", not clearly" : "");
}

std::string unknown_noise_words(const FitResult& fitted) {
  return "unknown: " + unknown_noise_reason(fitted);
}

std::string scatter_words(const FitResult& fitted) {
  switch (fitted.noise_verdict) {
    case NoiseVerdict::unchecked:
      return fitted.weights.noise.known ? "not checked: there are no more points than parameters"
                                        : unknown_noise_words(fitted);
    case NoiseVerdict::estimated:
      return variance_words(fitted);
    case NoiseVerdict::explained:
    case NoiseVerdict::doubtful:
      return noise_name(fitted);
    case NoiseVerdict::exceeded:
      return fitted.noise_scale > 1.0
                 ? fmt::format("{:.3g} times {}", fitted.noise_scale, noise_name(fitted))
                 : noise_name(fitted);
  }
  return "";
}

/// The largest contribution of velocity and diameter errors, in standard deviations of e.
std::string input_words(const FitResult& fitted) {
  double most = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < fitted.data.points.size(); ++i) {
    const Observation& point = fitted.data.points[i];
    const PointWeights& weights = fitted.weights.points[i];
    if (!(weights.input_sd > 0.0) || point.censored) continue;
    ++count;
    const double width = std::max(2.0 * point.restitution, weights.sd) * weights.sd;
    most = std::max(most, weights.input_sd / width);
  }
  if (count == 0) return "";
  return fmt::format(
      "; errors of velocity and diameter add up to {:.2g} standard deviations of e at {}", most,
      counted(count, "point"));
}

std::string setting_words(const FitResult& fitted) {
  const Observations& data = fitted.data;
  const double sd = fitted.weights.noise.setting_sd;
  if (!data.share(SharedBy::setting)) return "";
  const SettingCount count = count_settings(data);
  const std::string source =
      fmt::format("{}, {}, {}", data.noise.setting_sd_estimated ? "estimated" : "stated",
                  counted(count.settings, "setting"), counted(count.points, "point"));
  if (setting_velocity_error().acts(data) && !(sd > 0.0)) {
    return fmt::format("; the points of one setting share its stated error of velocity ({})",
                       source);
  }
  if (data.noise.setting_sd_estimated && spare_settings(data, fitted.model.free_count()) < 1) {
    return fmt::format(
        "; an error that the points of one setting share cannot be estimated from so few settings "
        "({})",
        source);
  }
  return sd > 0.0 ? fmt::format("; the points of one setting share an error of e of {:.2g} ({})",
                                sd, source)
                  : fmt::format("; no shared error of the points of one setting is detected ({})",
                                source);
}

/// The rows whose diameter has one error; as in "the stated error of the diameter is shared by the
/// 20 points of 4.9 um".
std::string batch_words(const FitResult& fitted) {
  std::map<std::size_t, std::pair<double, int>> sizes;  // diameter, points
  for (const Observation& point : fitted.data.points) {
    if (!(point.batch_diameter_sd > 0.0)) continue;
    auto& [diameter, points] = sizes[point.size];
    diameter = point.diameter;
    ++points;
  }
  std::vector<std::string> texts;
  for (const auto& [size, of] : sizes) {
    texts.push_back(
        fmt::format("the {} of {:.3g} um", counted(of.second, "point"), 1e6 * of.first));
  }
  if (texts.empty()) return "";
  return fmt::format("; the stated error of the diameter is shared by {}",
                     fmt::join(texts, " and by "));
}

// ---- warnings ----------------------------------------------------------------------------------

/// Appends the sentences that the list does not contain yet.
void add_new(Sentences& list, const Sentences& more) {
  for (const Sentence& item : more) {
    if (std::ranges::find(list, item) == list.end()) list.push_back(item);
  }
}

Sentence doubt_words(const NoiseDoubt& doubt) {
  const auto number = static_cast<int>(doubt.number);
  switch (doubt.cause) {
    case NoiseDoubt::Cause::sd_of_few:
      return fmt::format(
          "{} fewer than {} impacts: if their restitution_sd were computed from these alone, the "
          "intervals are too narrow; pool the deviations of all points, or let the fit estimate "
          "them ([noise] variance = \"constant\")",
          counted(number, "point averages", "points average"), few_impacts);
    case NoiseDoubt::Cause::unequal_scales:
      return fmt::format(
          "the residuals of one dataset are {:.1f} times those of another, while one scale of the "
          "noise is estimated for all: the intervals may be too narrow; state restitution_sd",
          doubt.number);
    case NoiseDoubt::Cause::setting_velocity:
      return "the points of every setting have one velocity: if they share an error of this "
             "velocity, such as that of a drop height, and not of e, the intervals are too narrow "
             "near capture: state setting_velocity_sd";
    case NoiseDoubt::Cause::few_settings:
      break;
  }
  return fmt::format(
      "the points of one setting may share an error, such as that of a drop height; {} cannot "
      "determine it, and the intervals do not include it: state setting_velocity_sd or setting_sd",
      counted(number, "setting"));
}

/// Warnings about missing, imprecise and ignored standard deviations.
Sentences noise_warnings(const FitResult& fitted) {
  Sentences warnings;
  const StatedNoise& stated = fitted.data.noise;
  if (stated.sd_stated && stated.sd_missing > 0) {
    warnings.emplace_back(counted(stated.sd_missing, "point states", "points state") +
                          " no restitution_sd; single impacts are assumed to scatter there like "
                          "the median of the others");
  } else if (!stated.sd_stated && stated.sd_set_aside > 0) {
    warnings.emplace_back(fmt::format(
        "the restitution_sd of {} is ignored: the fit file requests an estimated variance",
        counted(stated.sd_set_aside, "point")));
  }
  for (const NoiseDoubt& doubt : noise_doubts(fitted)) add_new(warnings, {doubt_words(doubt)});
  return warnings;
}

/// Warnings about parameters that the fit does not determine.
Sentences undetermined_warnings(const FitResult& fitted) {
  if (!fitted.flat.empty()) {
    return {
        say("the points do not depend on {} at the estimate: change its initial value, or fix it "
            "(free = false)",
            joined(fitted.flat, ", ",
                   [&](std::size_t j) { return symbol(fitted.model.slots[j].label()); }))};
  }
  if (!fitted.weights.noise.known) {
    return {Sentence("the noise is " + unknown_noise_words(fitted) +
                     ": no standard errors and no intervals")};
  }
  if (!fitted.covariance.empty()) return {};
  return {"the points do not determine all free parameters (J'J is singular): no standard errors"};
}

Sentences bound_warnings(const FitResult& fitted) {
  Sentences warnings;
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    if (!fitted.at_bound[j]) continue;
    const ParameterSlot& slot = fitted.model.slots[j];
    const bool low = fitted.theta[j] <= 0.5 * (slot.lower + slot.upper);
    warnings.push_back(
        say("{} is at its {} bound {:.4g}{}: it has no standard error, and the errors of the other "
            "parameters are conditional on it",
            symbol(slot.label()), low ? "lower" : "upper", low ? slot.lower : slot.upper,
            unit_after_number(slot.parameter->unit)));
  }
  return warnings;
}

Sentences weight_warnings(const FitResult& fitted) {
  Sentences warnings;
  if (!fitted.weights_at_rest) warnings.emplace_back("reweighting did not converge");
  if (fitted.strained_points > 0) {
    warnings.push_back(
        fmt::format("at {} near capture the errors of velocity or diameter are too large for their "
                    "first-order treatment (bias above {:.1g} standard deviations)",
                    counted(fitted.strained_points, "point"), strained_bias));
  }
  if (fitted.unused_counts) {
    const Mechanism* const mechanism = fitted.unused_counts->mechanism;
    warnings.push_back(
        fmt::format("captured counts at {} with rebounds are not used, because {} already "
                    "describe{} how impacts differ",
                    counted(fitted.unused_counts->points, "point"),
                    mechanism == nullptr ? "the stated sizes" : std::string(mechanism->info.id),
                    mechanism == nullptr ? "" : "s"));
  }
  return warnings;
}

Sentences mechanism_warnings(const ImpactModel& model) {
  Sentences warnings;
  for (const Mechanism* mechanism : model.chain) {
    const auto idle = std::ranges::count_if(
        model.surroundings, [&](const Surroundings& at) { return !mechanism->acts_at(at); });
    if (idle == 0) continue;
    warnings.push_back(
        fmt::format("{} has no effect in {} of {} datasets, whose work of adhesion is 0",
                    mechanism->info.id, idle, model.surroundings.size()));
  }
  return warnings;
}

Sentences start_warnings(const FitResult& fitted) {
  Sentences warnings;
  std::set<std::size_t> differing_slots;
  for (const StartSummary& start : fitted.starts) {
    differing_slots.insert(start.differing.begin(), start.differing.end());
  }
  for (const std::size_t j : differing_slots) {
    std::vector<double> ends;
    for (const StartSummary& start : fitted.starts) {
      const auto& differing = start.differing;
      if (start.outcome == StartOutcome::best ||
          std::ranges::find(differing, j) != differing.end()) {
        ends.push_back(start.end[j]);
      }
    }
    const auto [least, most] = std::ranges::minmax_element(ends);
    warnings.push_back(
        say("starts reach the same chi2 at other parameters: {} from {:.4g} to {:.4g}",
            symbol(fitted.model.slots[j].label()), *least, *most));
  }
  const auto add = [&](std::ptrdiff_t count, const char* problem) {
    if (count > 0) {
      warnings.push_back(fmt::format("{} of {} starts {}", count, fitted.starts.size(), problem));
    }
  };
  const auto count = [&](const auto& holds) { return std::ranges::count_if(fitted.starts, holds); };
  const auto unfinished = count([](const auto& s) { return s.ending == DescentEnd::limit; });
  add(unfinished, "reached the iteration limit");
  add(count([](const auto& s) { return s.outcome == StartOutcome::not_converged; }) - unfinished,
      "did not converge");
  add(count([](const auto& s) { return s.outcome == StartOutcome::worse; }),
      "ended in a worse local minimum");
  if (fitted.flat.empty()) {
    add(count([](const auto& s) { return s.outcome == StartOutcome::flat; }),
        "ended where a parameter has no effect");
  }
  return warnings;
}

Sentence point_words(const Observation& point) {
  return say("{e} = {:.4g} at {V} = {:.4g} m/s", point.restitution, point.velocity);
}

}  // namespace

Sentence equation_words(AdhesionLaw law) { return say(traits(law).description); }

std::string unknown_noise_reason(const FitResult& fitted) {
  return fmt::format(
      "no standard deviation is stated, and {}",
      fitted.dof > 0 ? "the readings do not scatter" : "there are no more points than parameters");
}

Sentence loss_words(const Analysis& a) {
  if (a.losses.empty()) return {};
  const auto loss_name = [](const std::string& id) {
    return id == hunt_crossley ? "Hunt-Crossley" : id;
  };
  constexpr double as_good = 2.0;  // Burnham & Anderson 2002, section 2.6
  std::vector<std::string> equals;
  std::vector<std::string> others;
  for (const LossFit& law : a.losses) {
    if (&law == &a.losses.front()) continue;
    others.push_back(fmt::format("{} +{:.1f}", loss_name(law.id), law.delta_aicc));
    if (law.delta_aicc < as_good) equals.push_back(loss_name(law.id));
  }
  std::string text = fmt::format("Law of loss: {}", loss_name(a.spec.loss));
  if (!others.empty()) text += fmt::format(" (AICc of the others: {})", fmt::join(others, ", "));
  if (!equals.empty()) {
    text += fmt::format("; the points cannot distinguish it from {}", fmt::join(equals, ", "));
  }
  if (a.fitted.noise_verdict == NoiseVerdict::exceeded) {
    text += "; as no law fits, quote the mean e";
  }
  return Sentence(text + ".");
}

Sentence with_its_size(const FitResult& fitted, const Sentence& f0) {
  const double size = fitted.model.contacts.front().reference_diameter;
  const bool measured = std::ranges::any_of(fitted.data.points, [&](const Observation& point) {
    return std::abs(point.diameter / size - 1.0) < 1e-3;
  });
  return measured ? f0 : say("{} at {}", f0, diameter_sentence(size));
}

std::string noise_name(const FitResult& fitted) {
  const auto counts = [](const Observation& point) { return point.censored; };
  return std::ranges::all_of(fitted.data.points, counts) ? "the noise of the counts"
                                                         : "the stated noise";
}

std::string noise_words(const FitResult& fitted) {
  if (!fitted.usable) return "";
  std::string text = scatter_words(fitted) + input_words(fitted);
  if (const double spread = fitted.weights.noise.event_spread; spread > 0.0) {
    text += fmt::format("; the capture velocity scatters by {:.1f} % from impact to impact",
                        100.0 * spread);
  }
  if (const StatedNoise& stated = fitted.data.noise; stated.sd_rounded > 0) {
    text += fmt::format(
        "; e is rounded to {:g}, which adds an error of {:.2g} to the smaller standard deviations "
        "stated for {}",
        stated.rounding_sd * std::sqrt(12.0), stated.rounding_sd,
        counted(stated.sd_rounded, "point"));
  }
  if (const Noise& noise = fitted.weights.noise; noise.pooled_dof > 0) {
    text += fmt::format("; the stated deviations of few impacts are pooled: {}",
                        scale_words(noise.variance, noise.scale));
  }
  text += batch_words(fitted) + setting_words(fitted);
  if (const auto& student = fitted.data.noise.student) {
    text += fmt::format("; Student's t residuals with {:g} degrees of freedom", student->dof);
  }
  return text;
}

std::string scale_words(VarianceFunction function, double scale) {
  using enum VarianceFunction;
  static constexpr Phrase<VarianceFunction> patterns[] = {
      {stated, "sd(e) as stated"},
      {constant, "sd(e) = {:.3g}"},
      {proportional, "sd(e) = {:.3g} e"},
      {capture, "sd(e^2) = {:.3g}"},
      {steep, "sd(e) = {:.3g} exp(2 (V* / V)^2)"}};
  return fmt::format(fmt::runtime(phrase_for(patterns, function).words), scale);
}

Sentence two_point_words(const FitResult& fitted, std::size_t dataset,
                         const TwoPointResult& result) {
  if (result.status == TwoPointStatus::too_few_points) {
    return "the diameter has fewer than two velocities with rebounds";
  }
  const ImpactModel& model = fitted.model;
  const Sentence low = point_words(fitted.data.points[result.low_point]);
  const Sentence high = point_words(fitted.data.points[result.high_point]);
  const double C_H = result.theta[model.slot_C_H[dataset]];
  const double C_A = result.theta[model.slot_C_A[dataset]];
  switch (result.status) {
    case TwoPointStatus::no_hertz_damping:
      return say(
          "no {C_H} >= 0 gives {}: with the {C_A} of the slowest point, {:.4g} s/m, adhesion "
          "already loses more there",
          high, C_A);
    case TwoPointStatus::no_adhesion_damping:
      return say("no {C_A} in [0, {:.4g}] s/m gives {} with {C_H} = {:.4g} s/m",
                 model.slots[model.slot_C_A[dataset]].upper, low, C_H);
    case TwoPointStatus::converged:
      return say("from {} and {}", low, high);
    case TwoPointStatus::not_converging:
      return say("{C_H} and {C_A} still change after {} iterations on {} and {}", result.iterations,
                 low, high);
    case TwoPointStatus::too_few_points:
      break;
  }
  return {};
}

Sentence noise_warning(const FitResult& fitted) {
  return fmt::format(
      "the residuals are {:.3g} times larger than {} ({}): errors and intervals are widened by "
      "this factor, but no widening can correct for a wrong model",
      fitted.noise_scale, noise_name(fitted), p_words(fitted.p_value));
}

std::vector<Sentence> fit_warnings(const FitResult& fitted) {
  Sentences warnings = noise_warnings(fitted);
  if (fitted.usable) {
    add_new(warnings, undetermined_warnings(fitted));
    add_new(warnings, bound_warnings(fitted));
    if (fitted.noise_scale > 1.0 && fitted.noise_verdict == NoiseVerdict::exceeded) {
      warnings.push_back(noise_warning(fitted));
    }
    add_new(warnings, start_warnings(fitted));
  }
  add_new(warnings, weight_warnings(fitted));
  add_new(warnings, mechanism_warnings(fitted.model));
  return warnings;
}

std::vector<Sentence> all_warnings(const Analysis& a) {
  Sentences warnings = fit_warnings(a.fitted);
  add_new(warnings, uncertainty_warnings(a.uncertainty, a.fitted.data));
  for (std::size_t s = 0; s < a.uncertainty.intervals.size(); ++s) {
    const IntervalSet& set = a.uncertainty.intervals[s];
    const Interval& interval = recommended_interval(set);
    const Sentence name = symbol(a.fitted.model.slots[s].label());
    if (interval.available() && lacks_ends(set[IntervalKind::profile])) {
      warnings.push_back(say("{} has a {} interval, because {}", name, words_of(set.recommended),
                             recommended_words(set)));
    }
    if (!interval.note || !short_note(interval.note->caution).empty()) continue;
    add_new(warnings, {say("{}: {}", name, note_words(interval, name))});
  }
  for (const Dataset& dataset : a.datasets) {
    for (const DatasetWarning& warning : dataset.warnings) {
      add_new(warnings, {warning_sentence(warning)});
    }
  }
  for (const TwoPointComparison& comparison : a.uncertainty.two_point) {
    if (comparison.result.status == TwoPointStatus::converged) continue;
    add_new(warnings, {say("two points on {}: {}", a.datasets[comparison.dataset].id,
                           two_point_words(a.fitted, comparison.dataset, comparison.result))});
  }
  const auto& contacts = a.fitted.model.contacts;
  for (std::size_t k = 0; k < contacts.size() && k < a.datasets.size(); ++k) {
    for (const std::string& sentence : contacts[k].contradictions) {
      warnings.push_back(say("{}: {}", code(a.datasets[k].id), sentence));
    }
  }
  return warnings;
}

}  // namespace recoil
