// Converts an Analysis to fit.json, posterior.csv and log_likelihood.csv.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/files.hpp"
#include "core/program.hpp"
#include "core/units.hpp"
#include "estimate/friction.hpp"
#include "estimate/likelihood.hpp"
#include "estimate/noise_doubt.hpp"
#include "estimate/restitution_summary.hpp"
#include "estimate/reweighting.hpp"
#include "report/format.hpp"
#include "report/result_entries.hpp"
#include "report/result_json.hpp"
#include "report/words_dataset.hpp"
#include "report/words_fit.hpp"
#include "report/words_validity.hpp"
#include "report/words_verdict.hpp"

namespace recoil {
namespace {

std::optional<double> only_if(bool condition, double value) {
  return condition ? std::optional(value) : std::nullopt;
}

/// values[i], or nullopt beyond the end.
std::optional<double> at(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? std::optional(values[i]) : std::nullopt;
}

std::optional<Ends> mc_error(const Interval& interval) {
  if (!interval.available() || !interval.lower_error || !interval.upper_error) return std::nullopt;
  return Ends{*interval.lower_error, *interval.upper_error};
}

/// Why `ends_of` returns nullopt.
std::string why_none(const Interval& interval) {
  return interval.available() ? "a bound is not finite" : missing_words(interval);
}

/// Correlation of two slots from the covariance; 0 if one of them has no variance.
double correlation(const Analysis& analysis, std::size_t a, std::size_t b) {
  const FitResult& fitted = analysis.fitted;
  const std::size_t slots = fitted.model.slots.size();
  if (fitted.covariance.size() != slots * slots) return 0.0;
  const double product = fitted.covariance[a * slots + a] * fitted.covariance[b * slots + b];
  if (!(product > 0.0) || !std::isfinite(product)) return 0.0;
  return std::clamp(fitted.covariance[a * slots + b] / std::sqrt(product), -1.0, 1.0);
}

/// The datasets of a joint fit as one. Its provenance is the weakest of all datasets, the last in
/// the order of the enum.
DatasetEntry joint_entry(const std::vector<Dataset>& datasets) {
  if (datasets.size() == 1) return dataset_entry(datasets.front());
  DatasetEntry joint;
  std::string checksums;
  for (const Dataset& dataset : datasets) {
    joint.id += (joint.id.empty() ? "" : "+") + dataset.id;
    joint.title += (joint.title.empty() ? "" : "; ") + dataset.title;
    joint.points += dataset.points.size();
    joint.sources.insert(joint.sources.end(), dataset.sources.begin(), dataset.sources.end());
    joint.provenance = std::max(joint.provenance, dataset.provenance);
    checksums += dataset.sha256;
  }
  joint.provenance_sentence = provenance_sentence(joint.provenance);
  joint.sha256 = sha256_hex(checksums);
  return joint;
}

std::string all_provenance_sentences(const std::vector<Dataset>& datasets) {
  std::string text;
  for (const auto& [label, sentence] : provenances(datasets)) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : " ", label, sentence);
  }
  return text;
}

/// The number of threads is omitted because no digit of the result depends on it.
FitFile::Options options_of(const Analysis& a) {
  const UncertaintyOptions& options = a.uncertainty.options;
  FitFile::Options out = {
      .adhesion = a.fitted.model.adhesion,
      .adhesion_damping_phase = a.fitted.model.phase,
      .loss = a.spec.loss.empty() ? std::string(hunt_crossley) : a.spec.loss,
      .mechanisms = a.spec.mechanisms,
      .mixed_sizes = averages_over_sizes(a.fitted.model),
      .replicates = options.replicates_auto ? Json("auto") : Json(options.replicates),
      .scheme = options.scheme,
      .level = options.level,
      .seed = options.seed,
      .materials = a.spec.uncertainty.materials != Materials::exact,
      .materials_adjusted = a.fitted.model.adjusts_constants()};
  for (const ParameterSlot& slot : a.fitted.model.slots) {
    if (slot.is_constant()) continue;
    out.parameters.push_back(
        {slot.label(),
         {.initial = slot.initial, .free = slot.free, .bounds = {slot.lower, slot.upper}}});
  }
  return out;
}

FitFile::Model model_of(const Analysis& a) {
  const ImpactModel& model = a.fitted.model;
  FitFile::Model out;
  out.equation = std::string(traits(model.adhesion).equation);
  out.adhesion = model.adhesion;
  out.adhesion_damping_phase = model.phase;
  if (traits(model.adhesion).has_range) out.separation_m = model.separation;
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    const ContactProperties& contact = model.contacts[k];
    const ImpactConditions conditions = reference_conditions(a, k, 1.0);
    const double f0 = conditions.adhesion_force;
    out.contacts.push_back(
        {.dataset = a.datasets[k].id,
         .stiffness_K_Pa = contact.stiffness,
         .stiffness_K_derived_Pa = contact.stiffness_derived,
         .adhesion_energy_J_per_m2 = contact.adhesion_energy,
         .f0_N_per_m = f0,
         .W_of_f0_J_per_m2 = adhesion_energy_for(f0, conditions.diameter / 2.0, contact.stiffness),
         .f0_eq12_N_per_m = contact.adhesion_force_derived,
         .reference_diameter_um = in_um(contact.reference_diameter),
         .particle_density_kg_per_m3 = contact.particle_density,
         .adhesion_velocity_m_per_s = adhesion_velocity(conditions),
         .contradictions = contact.contradictions});
  }
  return out;
}

FitFile::Intervals intervals_entry(const Analysis& a, std::size_t slot, const IntervalSet& set) {
  FitFile::Intervals out;
  out.wald = ends_of(set[IntervalKind::wald]);
  out.profile = ends_of(set[IntervalKind::profile]);
  out.percentile = ends_of(set[IntervalKind::percentile]);
  out.bca = ends_of(set[IntervalKind::bca]);
  out.studentized = ends_of(set[IntervalKind::studentized]);
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    if (!ends_of(set[kind])) out.why.emplace_back(to_string(kind), why_none(set[kind]));
  }
  const Interval& quoted = recommended_interval(set);
  out.recommended.why = quoted.available() ? recommended_words(set) : why_none(quoted);
  if (quoted.available()) out.recommended.interval = set.recommended;
  const std::optional<PosteriorResult>& posterior = a.uncertainty.posterior;
  if (posterior && posterior->available()) {
    out.posterior = ends_of(posterior->parameters[slot].interval);
  }
  if (!out.posterior) {
    out.why.emplace_back("posterior", !posterior
                                          ? "it was not requested ([uncertainty] posterior = true)"
                                      : posterior->available() ? "the parameter is fixed"
                                                               : no_posterior_words(*posterior));
  }
  return out;
}

/// Sets `budget` and the keys that belong to it; does nothing without a budget.
template <class Entry>
void set_budget(Entry& entry, const ErrorBudget& budget, const ImpactModel& model) {
  if (!budget.available()) return;
  std::vector<FitFile::BudgetRow>& rows = entry.budget.emplace();
  for (const BudgetEntry& source : budget.entries) {
    FitFile::BudgetRow& row = rows.emplace_back();
    row.source = source.constant ? source_words(source, model) : std::string(source.source);
    row.sd = source.sd;
    row.share = source.share;
    if (source.lower && source.upper) row.move.emplace(Ends{*source.lower, *source.upper});
  }
  entry.budget_linear = budget.linear;
  entry.budget_sd_without_first_constant.emplace(budget.sd_without_first_constant);
}

/// Sets `entry` for slot s if the fit was averaged over errors of the laws.
void set_laws_exact(OrAbsent<FitFile::LawsExact>& entry, const FitResult& fitted, std::size_t s) {
  const FitResult& exact = with_laws_exact(fitted);
  if (&exact == &fitted || s >= exact.theta.size()) return;
  if (std::ranges::find(exact.flat, s) != exact.flat.end()) return;
  entry.emplace(FitFile::LawsExact{acting_value(exact.model, exact.theta, s),
                                   only_if(exact.std_error[s] > 0.0, exact.std_error[s])});
}

FitFile::Parameter parameter_of(const Analysis& a, std::size_t s) {
  const FitResult& f = a.fitted;
  const ParameterSlot& slot = f.model.slots[s];
  const IntervalSet set = intervals_of(a, s);
  FitFile::Parameter out;
  const bool flat = std::ranges::find(f.flat, s) != f.flat.end();
  out.value = {only_if(!flat, acting_value(f.model, f.theta, s)),
               flat ? "no point depends on it" : "the estimate is not finite"};
  out.unit = slot.parameter->unit;
  out.free = slot.free;
  out.at_bound = s < f.at_bound.size() && f.at_bound[s];
  const bool follows = s < a.uncertainty.budgets.size() && !slot.free;
  const double error = follows ? a.uncertainty.budgets[s].sd : at(f.std_error, s).value_or(NAN);
  out.std_error = {only_if(error > 0.0, error), !slot.free     ? "the parameter is fixed"
                                                : out.at_bound ? "the estimate rests on a bound"
                                                               : "the covariance is not available"};
  out.intervals = intervals_entry(a, s, set);
  out.recommended = out.intervals.recommended;
  out.profile_shape = set[IntervalKind::profile].shape;
  const Sentence label = symbol(slot.label());
  out.intervals_mc_error = {.wald = mc_error(set[IntervalKind::wald]),
                            .profile = mc_error(set[IntervalKind::profile]),
                            .percentile = mc_error(set[IntervalKind::percentile]),
                            .bca = mc_error(set[IntervalKind::bca]),
                            .studentized = mc_error(set[IntervalKind::studentized])};
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    if (!set[kind].note) continue;
    out.intervals_note.emplace_back(to_string(kind), plain_text(note_words(set[kind], label)));
  }
  if (set.disagreement) out.intervals_differ = plain_text(disagreement_words(f, s, set));
  if (const auto& bca = set.bca_constants) out.bca_constants = {bca->bias, bca->acceleration};
  out.bound_share = set.bound_share;
  if (s < a.uncertainty.budgets.size()) set_budget(out, a.uncertainty.budgets[s], f.model);
  if (const auto& exact = a.uncertainty.conditional;
      exact && s < exact->fitted.theta.size() && exact->fitted.model.slots[s].free) {
    out.materials_exact.emplace(FitFile::MaterialsExact{
        .value = exact->fitted.theta[s],
        .std_error = exact->fitted.std_error[s],
        .intervals = {.wald = ends_of(exact->intervals[s][IntervalKind::wald]),
                      .profile = ends_of(exact->intervals[s][IntervalKind::profile])}});
  }
  set_laws_exact(out.laws_exact, f, s);
  return out;
}

Named<FitFile::Constant> constants_of(const Analysis& a) {
  Named<FitFile::Constant> all;
  const ImpactModel& model = a.fitted.model;
  if (a.fitted.theta.size() != model.slots.size()) return all;
  for (std::size_t k = 0; k < model.material_count(); ++k) {
    const UncertainConstant& constant = model.constants[k];
    const std::size_t j = model.first_constant() + k;
    FitFile::Constant& out = all.emplace_back(model.slots[j].label(), FitFile::Constant()).second;
    out.value = a.fitted.theta[j];
    out.unit = model.slots[j].parameter->unit;
    out.meaning = model.slots[j].parameter->meaning;
    out.std_error = at(a.fitted.std_error, j).value_or(0.0);
    out.stated = constant.stated;
    out.stated_sd = constant.sd;
    out.distribution = is_positive(constant.constant) ? "lognormal" : "normal";
    out.moved_sd = a.fitted.constants_moved[k];
    for (const std::size_t d : constant.datasets) out.datasets.push_back(a.datasets[d].id);
    set_laws_exact(out.laws_exact, a.fitted, j);
  }
  return all;
}

/// A matrix over the free parameters with the elements `value(i, j)`; null for parameters without a
/// standard error.
template <class ValueOf>
std::optional<FitFile::Matrix> matrix_of(const FitResult& f, const ValueOf& value) {
  const std::vector<ParameterSlot>& slots = f.model.slots;
  if (f.covariance.size() != slots.size() * slots.size()) return std::nullopt;
  FitFile::Matrix rows;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (!slots[i].free) continue;
    auto& row =
        rows.emplace_back(slots[i].label(), FitFile::Matrix::value_type::second_type()).second;
    for (std::size_t j = 0; j < slots.size(); ++j) {
      if (!slots[j].free) continue;
      const bool known = f.std_error[i] > 0.0 && f.std_error[j] > 0.0;  // neither is at a bound
      row.emplace_back(slots[j].label(), known ? std::optional(value(i, j)) : std::nullopt);
    }
  }
  return rows;
}

std::vector<FitFile::CaptureVelocity> captures_of(const Analysis& a) {
  std::vector<FitFile::CaptureVelocity> list;
  const std::optional<PosteriorResult>& posterior = a.uncertainty.posterior;
  for (std::size_t k = 0; k < a.uncertainty.capture.size(); ++k) {
    const CaptureEstimate& capture = a.uncertainty.capture[k];
    FitFile::CaptureVelocity& out = list.emplace_back();
    out.dataset = a.datasets[capture.dataset].id;
    out.diameter_um = in_um(capture.diameter);
    out.unit = "m/s";
    const bool adheres = !without_adhesion(a, capture.dataset);
    out.value = {
        only_if(capture.found && adheres, capture.value),
        !adheres        ? "without adhesion nothing is captured"
        : capture.above ? fmt::format("all impacts up to {:.4g} m/s were captured", *capture.above)
        : capture.below ? fmt::format("no impact from {:.4g} m/s on was captured", *capture.below)
                        : "no velocity was found at which capture turns into rebound"};
    out.lower_limit = capture.above;
    out.upper_limit = capture.below;
    if (!adheres) {
      out.recommended.why = out.value.why;
      out.why = out.value.why;
      continue;
    }
    out.interval = ends_of(capture.interval);
    out.interval_mc_error = mc_error(capture.interval);
    out.intervals.delta = ends_of(capture[CaptureIntervalKind::delta]);
    out.intervals.percentile = ends_of(capture[CaptureIntervalKind::percentile]);
    out.intervals.studentized = ends_of(capture[CaptureIntervalKind::studentized]);
    if (posterior && posterior->available()) {
      out.intervals.posterior.emplace(ends_of(posterior->capture[k].interval));
    }
    if (capture.because) out.recommended.interval = capture.recommended;
    out.recommended.why = recommended_words(capture);
    if (!out.interval) out.why = why_none(capture.interval);
    if (k < a.uncertainty.capture_budgets.size()) {
      set_budget(out, a.uncertainty.capture_budgets[k], a.fitted.model);
    }
  }
  return list;
}

/// f.rmse; without a value if all points are captured, because e is then not known.
OrReason<double> rmse_of(const FitResult& f) {
  const bool known =
      std::ranges::any_of(f.data.points, [](const Observation& point) { return !point.censored; });
  return {only_if(known, f.rmse), "no e is known"};
}

FitFile::Goodness goodness_of(const FitResult& f) {
  const bool stated = f.data.noise.sd_stated;
  const FitResult& exact = with_laws_exact(f);
  return {.chi2 = {exact.chi2, "the sum of squares is not finite"},
          .dof = exact.dof,
          .p_value = {judge_model(f).p_value,
                      stated ? "no degrees of freedom are left"
                             : "no standard deviations are stated: the noise is estimated from the "
                               "fit"},
          .minus_two_log_likelihood =
              {stated ? minus_two_log_likelihood(f) : std::nullopt,
               stated ? "captures have no likelihood under Student's t"
                      : "no standard deviations are stated: every fit estimates its own"},
          .rmse = rmse_of(f),
          .noise_scale = {f.noise_scale, "the noise could not be estimated"},
          .noise_text = noise_words(f)};
}

}  // namespace

FitFile::ModelVerdictFound model_verdict_of(const FitResult& f) {
  const ModelJudgement judged = judge_model(f);
  FitFile::ModelVerdictFound out{judged.verdict, plain_text(verdict_sentence(f)), {}};
  out.law_error = law_error_found(judged.laws);
  return out;
}

namespace {

FitFile::Noise noise_of(const FitResult& f) {
  const Observations& data = f.data;
  const Noise& noise = f.weights.noise;
  const auto count_with = [&](double InputErrors::*error) {
    return static_cast<int>(std::ranges::count_if(
        data.points, [&](const Observation& point) { return point.*error > 0.0; }));
  };
  FitFile::Noise out;
  out.variance = noise.variance;
  out.chosen = !noise.candidates.empty();
  out.scale = {only_if(noise.known && noise.variance != VarianceFunction::stated, noise.scale),
               noise.known ? "the standard deviations are stated" : noise_words(f)};
  if (noise.known) out.scale_text = scale_words(noise.variance, noise.scale);
  for (const Noise::Candidate& candidate : noise.candidates) {
    out.candidates.push_back({.variance = candidate.function,
                              .scale = candidate.scale,
                              .criterion = candidate.criterion,
                              .handicap = penalty_of(candidate.function)});
  }
  out.margin = {noise.candidates.size() > 1 ? std::optional(choice_margin(noise)) : std::nullopt,
                "nothing was chosen"};
  out.points_with_velocity_errors = count_with(&InputErrors::velocity_sd);
  out.points_with_diameter_errors =
      count_with(&InputErrors::diameter_sd) + count_with(&InputErrors::batch_diameter_sd);
  out.event_spread = {only_if(noise.event_spread > 0.0, noise.event_spread),
                      "no point has both rebounds and captures"};
  out.setting_sd = {only_if(data.share(SharedBy::setting), noise.setting_sd),
                    "the points of one setting are assumed to share no error"};
  out.setting_sd_estimated = data.noise.setting_sd_estimated;
  const std::optional<StudentNoise>& student = data.noise.student;
  out.residuals = student ? "student" : "normal";
  out.student_dof = {student ? std::optional(student->dof) : std::nullopt, "normal residuals"};
  out.efficiency = student ? student->efficiency() : 1.0;
  out.text = noise_words(f);
  return out;
}

FitFile::Identifiable identifiability_of(const Analysis& a) {
  const Identifiability& found = a.uncertainty.identifiability;
  const std::vector<ParameterSlot>& slots = a.fitted.model.slots;
  const auto by_parameter = [&](const std::vector<double>& values) {
    Named<std::optional<double>> out;
    for (std::size_t s = 0; s < values.size() && s < slots.size(); ++s) {
      if (slots[s].free && values[s] != 0.0) out.emplace_back(slots[s].label(), values[s]);
    }
    return out;
  };
  FitFile::Identifiable out;
  if (found.assessed()) out.verdict = found.verdict;
  out.text = plain_text(identifiability_words(a.fitted, a.uncertainty));
  for (std::size_t s = 0; s < found.parameter.size() && s < slots.size(); ++s) {
    if (!slots[s].free) continue;
    out.parameters.emplace_back(slots[s].label(), found.parameter[s].identifiable);
  }
  for (const InformationDirection& direction : found.information.directions) {
    out.information.directions.push_back(
        {.exponents = by_parameter(direction.exponents),
         .relative_sd = direction.relative_sd,
         .words = plain_text(direction_words(a.fitted, direction))});
  }
  out.information.relative_sd = by_parameter(found.information.relative_sd);
  out.information.condition = found.information.condition;
  constexpr std::size_t most_plans = 3;
  for (const PlannedPoints& plan : found.information.plans) {
    if (out.information.more_points.size() == most_plans) break;
    out.information.more_points.push_back({.dataset = a.datasets[plan.dataset].id,
                                           .diameter_um = in_um(plan.diameter),
                                           .incident_velocity = plan.velocity,
                                           .points = plan.points,
                                           .relative_sd = by_parameter(plan.relative_sd)});
  }
  return out;
}

FitFile::Bootstrap bootstrap_of(const Analysis& a) {
  const BootstrapResult& bootstrap = a.uncertainty.bootstrap;
  FitFile::Bootstrap out = {.scheme = bootstrap.scheme,
                            .scheme_why = scheme_words(bootstrap),
                            .replicates = bootstrap.replicates,
                            .failed = bootstrap.failed,
                            .mc_error_of_width = bootstrap.relative_error,
                            .seed = bootstrap.seed,
                            .usable = bootstrap.theta.size(),
                            .two_point_replicates = bootstrap.two_point_replicates};
  for (std::size_t k = 0; k < a.datasets.size() && k < bootstrap.two_point_failed.size(); ++k) {
    out.two_point_failed.emplace_back(a.datasets[k].id, bootstrap.two_point_failed[k]);
  }
  const FailedReplicates& failed = bootstrap.failures;
  if (failed.index.empty()) return out;
  constexpr std::size_t most_listed = 100;  // failed replicates
  out.failures = FitFile::Failures{};
  FitFile::Failures& failures = *out.failures;
  failures.text = failures_words(bootstrap, a.fitted.data);
  failures.replicates = failed.index;
  failures.replicates.resize(std::min(failed.index.size(), most_listed));
  failures.message = failure_message(failed);
  for (const FailedReplicates::Suspect& suspect : failed.suspects) {
    const Observation& point = a.fitted.data.points[suspect.point];
    failures.suspects.push_back({.point = suspect.point + 1,
                                 .incident_velocity = point.velocity,
                                 .diameter_um = in_um(point.diameter),
                                 .disturbance_when_failed = suspect.failed,
                                 .disturbance_otherwise = suspect.usual});
  }
  return out;
}

std::optional<FitFile::Posterior> posterior_of(const Analysis& a) {
  if (!a.uncertainty.posterior) return std::nullopt;
  const PosteriorResult& found = *a.uncertainty.posterior;
  FitFile::Posterior out = {.steps = found.steps,
                            .chains = found.chains,
                            .acceptance = found.acceptance,
                            .draws = found.draws.size()};
  if (!found.available()) out.missing = no_posterior_words(found);
  out.loo.why = no_leave_one_out_words(found);
  if (out.loo.why.empty()) {
    const LeaveOneOut& loo = found.left_out;
    out.loo.value = {.elpd = loo.elpd,
                     .se = loo.se,
                     .p_loo = loo.p_loo,
                     .largest_pareto_k = largest_pareto_k(found.draws.size()),
                     .mcse = loo.mcse};
    for (const LeftOutPoint& point : loo.points) {
      out.loo.value->elpd_of_points.push_back(point.elpd);
      out.loo.value->pareto_k.push_back(point.pareto_k);
      out.loo.value->r_eff.push_back(point.r_eff);
    }
  }
  for (std::size_t j = 0; j < found.parameters.size(); ++j) {
    const PosteriorMarginal& marginal = found.parameters[j];
    if (!a.fitted.model.slots[j].moves()) continue;
    out.parameters.push_back({a.fitted.model.slots[j].label(),
                              {.mean = marginal.mean,
                               .sd = marginal.sd,
                               .r_hat = marginal.check.r_hat,
                               .effective_draws = marginal.check.bulk,
                               .effective_tail_draws = marginal.check.tail}});
  }
  return out;
}

std::string held_out_why(const TwoPointComparison& comparison) {
  return comparison.nothing_held_out ? held_out_words(comparison)
                                     : "no other diameter was predicted";
}

FitFile::TwoPoint two_point_entry(const Analysis& a, const TwoPointComparison& comparison) {
  const TwoPointResult& two = comparison.result;
  const ImpactModel& model = a.fitted.model;
  const bool answered = two.status != TwoPointStatus::too_few_points;
  const auto point_at = [&](std::size_t index) -> std::optional<FitFile::PaperPoint> {
    if (!answered || index >= a.fitted.data.points.size()) return std::nullopt;
    const Observation& point = a.fitted.data.points[index];
    return FitFile::PaperPoint{point.velocity, point.restitution, in_um(point.diameter)};
  };
  FitFile::TwoPoint out;
  out.status = two.status;
  out.text = plain_text(two_point_words(a.fitted, comparison.dataset, two));
  out.iterations = two.iterations;
  out.diameter_um = in_um(two.diameter);
  out.low_point = point_at(two.low_point);
  out.high_point = point_at(two.high_point);
  for (const std::size_t s :
       {model.slot_C_H[comparison.dataset], model.slot_C_A[comparison.dataset]}) {
    out.parameters.push_back(
        {model.slots[s].label(),
         {.value = {at(two.theta, s), out.text},
          .unit = std::string(model.slots[s].parameter->unit),
          .spread = {at(comparison.spread, s), "no replicate has an answer"}}});
  }
  out.rmse = {only_if(answered, comparison.rmse), out.text};
  out.held_out_rmse = {comparison.held_out_rmse, held_out_why(comparison)};
  out.failed = comparison.failed;
  return out;
}

FitFile::Full full_entry(const Analysis& a, const TwoPointComparison& comparison) {
  const ImpactModel& model = a.fitted.model;
  FitFile::Full out;
  out.rmse = {comparison.full_rmse, "no point rebounded"};
  out.held_out_rmse = {comparison.full_held_out_rmse, held_out_why(comparison)};
  auto& spread = out.spread.emplace();
  for (const std::size_t s :
       {model.slot_C_H[comparison.dataset], model.slot_C_A[comparison.dataset]}) {
    spread.emplace_back(model.slots[s].label(), at(comparison.full_spread, s));
  }
  return out;
}

OrReason<double> compared_error(const ImpactModel& model, const ComparisonRow& row,
                                std::size_t slot) {
  if (!row.failure.empty()) return {std::nullopt, row.failure};
  if (row.standard_errors.empty()) {
    return {std::nullopt, row.row == CalibrationKind::two_point
                              ? "two points leave nothing to estimate an error from"
                          : row.noise_known ? "the covariance is singular"
                                            : "the noise is unknown"};
  }
  const double error = row.standard_errors[slot];
  return {only_if(error > 0.0, error),
          model.slots[slot].free ? "the estimate rests on a bound" : "the parameter is fixed"};
}

FitFile::CalibrationRow compared_entry(const Analysis& a, const TwoPointComparison& comparison,
                                       const ComparisonRow& row) {
  const ImpactModel& model = a.fitted.model;
  const std::size_t d = comparison.dataset;
  FitFile::CalibrationRow out;
  out.dataset = a.datasets[d].id;
  out.id = row.row;
  out.headline = row.headline;
  const std::optional<double> f0 =
      row.theta.empty() ? std::nullopt : std::optional(adhesion_force_under(model, row.theta, d));
  out.f0 = {f0, row.failure};
  out.C_H = {at(row.theta, model.slot_C_H[d]), row.failure};
  out.C_A = {at(row.theta, model.slot_C_A[d]), row.failure};
  out.C_H_standard_error = compared_error(model, row, model.slot_C_H[d]);
  out.C_A_standard_error = compared_error(model, row, model.slot_C_A[d]);
  out.rmse = {row.rmse, row.failure};
  out.held_out_rmse = {row.held_out_rmse,
                       row.failure.empty() ? held_out_why(comparison) : row.failure};
  return out;
}

/// Sets the keys of the two-point comparison. Keys without a dataset refer to the first dataset.
void set_two_point(FitFile& out, const Analysis& a) {
  for (const TwoPointComparison& comparison : a.uncertainty.two_point) {
    const std::string& id = a.datasets[comparison.dataset].id;
    out.two_point_by_dataset.emplace_back(id, two_point_entry(a, comparison));
    out.full_by_dataset.emplace_back(id, full_entry(a, comparison));
    for (const ComparisonRow& row : comparison.rows) {
      out.comparison.push_back(compared_entry(a, comparison, row));
    }
  }
  if (out.two_point_by_dataset.empty()) {
    out.two_point.why = "the comparison was not made";
    out.full.rmse = rmse_of(a.fitted);
    out.full.held_out_rmse.why = out.two_point.why;
  } else {
    out.two_point.value = out.two_point_by_dataset.front().second;
    out.full = out.full_by_dataset.front().second;
  }
}

std::vector<FitFile::CurvePoint> curve_of(const Analysis& a) {
  std::vector<FitFile::CurvePoint> rows;
  for (const RestitutionCurve& curve : a.uncertainty.curves) {
    for (std::size_t i = 0; i < curve.velocity.size() && i < curve.restitution.size(); ++i) {
      const Ends band = {at(curve.lower, i).value_or(NAN), at(curve.upper, i).value_or(NAN)};
      const bool banded = std::isfinite(band[0]) && std::isfinite(band[1]);
      rows.push_back({.dataset = a.datasets[curve.dataset].id,
                      .series = curve.series,
                      .diameter_um = in_um(curve.diameter),
                      .incident_velocity = curve.velocity[i],
                      .restitution = curve.restitution[i],
                      .band = banded ? std::optional(band) : std::nullopt,
                      .two_point = at(curve.two_point, i)});
    }
  }
  return rows;
}

std::vector<FitFile::Residual> residuals_of(const Analysis& a) {
  const FitResult& f = a.fitted;
  std::vector<const ImpactPoint*> stated;
  for (const Dataset& dataset : a.datasets) {
    for (const ImpactPoint& point : dataset.points) stated.push_back(&point);
  }
  std::vector<FitFile::Residual> rows;
  for (std::size_t i = 0; i < f.data.points.size(); ++i) {
    const Observation& point = f.data.points[i];
    const PointWeights& own = f.weights.points[i];
    const Dataset& dataset = a.datasets[point.dataset];
    const bool in_series = point.series < dataset.series.size();
    rows.push_back({.dataset = dataset.id,
                    .series = in_series ? dataset.series[point.series] : "",
                    .diameter_um = in_um(point.diameter),
                    .incident_velocity = point.velocity,
                    .incidence_angle_deg = in_degrees(stated.at(i)->incidence_angle),
                    .restitution = only_if(!point.counts_only(), point.restitution),
                    .restitution_sd = stated.at(i)->restitution_sd,
                    .sd_used = own.sd,
                    .sd_of_e2_from_inputs = own.input_sd,
                    .captured = point.rebounds() == 0,
                    .captured_count = point.captured,
                    .events = point.events,
                    .predicted = at(f.prediction, i),
                    .weighted_residual = at(f.residuals, i),
                    .leverage = at(f.leverage, i)});
  }
  return rows;
}

std::vector<FrictionEntry> friction_entries(const std::vector<Dataset>& datasets) {
  std::vector<FrictionEntry> entries;
  for (const Dataset& dataset : datasets) {
    const std::optional<Friction> found = fit_friction(dataset);
    if (!found) continue;
    const std::string rolling = found->least ? "all points may roll" : "";
    entries.push_back(
        {.dataset = dataset.id,
         .mu = {found->mu, rolling},
         .interval = {found->interval, found->least ? rolling : "one point shows no scatter"},
         .lower_limit = found->least,
         .points = found->points,
         .sliding = found->sliding});
  }
  return entries;
}

}  // namespace

std::optional<Ends> ends_of(const Interval& interval) {
  if (!interval.available() || !std::isfinite(*interval.lower) || !std::isfinite(*interval.upper)) {
    return std::nullopt;
  }
  return Ends{*interval.lower, *interval.upper};
}

OrNull<LawErrorFound> law_error_found(const std::optional<LawErrorEstimate>& laws) {
  if (!laws) return std::nullopt;
  return LawErrorFound{laws->seen(), laws->exact_weight, laws->median, laws->lower, laws->upper};
}

DatasetEntry dataset_entry(const Dataset& dataset) {
  return {.id = dataset.id,
          .title = dataset.title,
          .provenance = dataset.provenance,
          .provenance_sentence = provenance_sentence(dataset.provenance),
          .points = dataset.points.size(),
          .sha256 = dataset.sha256,
          .sources = dataset.sources};
}

ValidityEntry validity_entry(const Validity& check) {
  ValidityEntry out;
  out.quantity = check.quantity;
  out.value = check.value;
  out.limit = check.limit;
  out.limit_is = check.limit_is_least() ? "least" : "largest";
  out.exceeded = check.exceeded();
  out.diameter_um = in_um(check.diameter);
  out.incident_velocity = check.velocity;
  out.text = validity_sentence(check);
  return out;
}

RestitutionEntries restitution_entries(const std::vector<Dataset>& datasets,
                                       const ImpactModel& model) {
  const RestitutionSummary summary = summarise_restitution(datasets, adheres_anywhere(model));
  const auto series_of = [&](const RestitutionMean& mean) {
    return datasets[mean.dataset].series[mean.series];
  };
  RestitutionEntries out;
  for (const RestitutionMean& mean : summary.means) {
    RestitutionMeanEntry& entry = out.means.emplace_back();
    entry.dataset = datasets[mean.dataset].id;
    entry.series = series_of(mean);
    if (!mean.setting.empty()) entry.setting = mean.setting;
    entry.diameter_um = in_um(mean.diameter);
    entry.incident_velocity = mean.velocity;
    entry.value = mean.value;
    entry.interval = {mean.interval, mean.why};
    entry.points = mean.points;
    entry.launches = mean.launches;
  }
  for (const RestitutionRange& range : summary.ranges) {
    out.ranges.push_back({datasets[range.dataset].id,
                          in_um(range.diameter),
                          {range.slowest.velocity, range.slowest.value},
                          {range.fastest.velocity, range.fastest.value}});
  }
  const TestedEffect& slope = summary.velocity;
  out.velocity = {{slope.value, slope.why}, slope.interval, slope.p_value, summary.without_error};
  const TestedEffect& differ = summary.series;
  out.series = {{differ.p_value, differ.why}, {}, differ.value, differ.interval};
  if (differ.value) {
    const auto& [one, other] = summary.most_different;
    out.series.most_different = {series_of(summary.means[one]), series_of(summary.means[other])};
  }
  return out;
}

std::string fit_json(const Analysis& a) {
  const FitResult& f = a.fitted;
  FitFile out;
  out.recoil_version = version();
  out.fit = {a.spec.id, a.spec.sha256};
  out.provenance_sentence = all_provenance_sentences(a.datasets);
  out.dataset = joint_entry(a.datasets);
  for (const Dataset& dataset : a.datasets) out.datasets.push_back(dataset_entry(dataset));
  set_restitution(out, a.datasets, f.model);
  out.friction = friction_entries(a.datasets);
  for (const LossFit& law : a.losses) out.loss_laws.push_back({law.id, law.delta_aicc});
  out.options = options_of(a);
  out.model = model_of(a);
  for (std::size_t s = 0; s < f.model.slots.size(); ++s) {
    if (f.model.slots[s].is_constant()) continue;
    out.parameters.emplace_back(f.model.slots[s].label(), parameter_of(a, s));
  }
  out.constants = constants_of(a);
  const std::size_t slots = f.model.slots.size();
  out.covariance =
      matrix_of(f, [&](std::size_t i, std::size_t j) { return f.covariance[i * slots + j]; });
  out.correlation = matrix_of(
      f, [&](std::size_t i, std::size_t j) { return i == j ? 1.0 : correlation(a, i, j); });
  out.derived.capture_velocity = captures_of(a);
  long handovers = f.handovers;
  for (const TwoPointComparison& comparison : a.uncertainty.two_point) {
    handovers += comparison.handovers;
  }
  out.solver = {f.model.solver.kind, handovers, f.ending, f.strategy};
  out.model_verdict = model_verdict_of(f);
  out.goodness = goodness_of(f);
  out.noise = noise_of(f);
  out.identifiability = identifiability_of(a);
  for (const Validity& check : a.validity) {
    ValidityEntry& entry = out.validity.emplace_back(validity_entry(check));
    entry.dataset = a.datasets[check.dataset].id;
  }
  out.bootstrap = bootstrap_of(a);
  FitFile::OwnDesign own;
  for (const OwnCoverage& row : a.own_design) {
    own.coverage.push_back({row.quantity, row.method, row.share(), row.datasets});
  }
  out.own_design = {own.coverage.empty() ? std::nullopt : std::optional(std::move(own)),
                    noise_doubts(f).empty()
                        ? "it was not counted"
                        : "the noise is in doubt (see warnings), and simulated data do not have "
                          "this doubt"};
  out.posterior = posterior_of(a);
  set_two_point(out, a);
  for (const StartSummary& start : f.starts) {
    out.starts.push_back({.start = {start.start.begin(), start.start.end()},
                          .end = {start.end.begin(), start.end.end()},
                          .chi2 = start.chi2,
                          .converged = start.converged(),
                          .ended = start.ending,
                          .message = start.message});
  }
  out.warnings = plain_texts(all_warnings(a));
  out.curve = curve_of(a);
  out.residuals = residuals_of(a);
  return text_of(out, 1);
}

std::string posterior_csv(const Analysis& a) {
  const std::optional<PosteriorResult>& found = a.uncertainty.posterior;
  std::string text;
  if (!found || !found->available()) return text;
  text += "chain,draw";
  std::vector<std::size_t> moving;
  for (std::size_t j = 0; j < a.fitted.model.slots.size(); ++j) {
    if (!a.fitted.model.slots[j].moves()) continue;
    text += fmt::format(",\"{}\"", a.fitted.model.slots[j].label());
    moving.push_back(j);
  }
  for (const CaptureEstimate& at : a.uncertainty.capture) {
    text += fmt::format(",\"V*({:.4g} um{})\"", at.diameter / units::um,
                        a.datasets.size() > 1 ? ", " + a.datasets[at.dataset].id : "");
  }
  text += found->scale.empty() ? "" : ",noise_scale";
  text += ",log_likelihood,log_prior\n";
  for (std::size_t k = 0; k < found->draws.size(); ++k) {
    text += fmt::format("{},{}", k / found->length + 1, k % found->length + 1);
    for (const std::size_t j : moving) text += fmt::format(",{:.9g}", found->draws[k][j]);
    for (const double v : found->capture_draws[k]) {
      text += std::isfinite(v) ? fmt::format(",{:.9g}", v) : ",";
    }
    if (!found->scale.empty()) text += fmt::format(",{:.9g}", found->scale[k]);
    text += fmt::format(",{:.9g},{:.9g}\n", found->log_likelihood[k], found->log_prior[k]);
  }
  return text;
}

std::string log_likelihood_csv(const Analysis& a) {
  const std::optional<PosteriorResult>& found = a.uncertainty.posterior;
  std::string text;
  if (!found || found->pointwise.empty()) return text;
  text += "chain,draw";
  for (std::size_t i = 0; i < found->pointwise.size(); ++i) text += fmt::format(",{}", i + 1);
  text += "\n";
  for (std::size_t k = 0; k < found->draws.size(); ++k) {
    text += fmt::format("{},{}", k / found->length + 1, k % found->length + 1);
    for (const std::vector<double>& point : found->pointwise) {
      text += fmt::format(",{:.8g}", point[k]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace recoil
