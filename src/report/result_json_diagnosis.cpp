// Converts a Diagnosis to diagnosis.json.
#include <algorithm>

#include "core/units.hpp"
#include "report/result_entries.hpp"
#include "report/result_json.hpp"
#include "report/words_candidate.hpp"
#include "report/words_diagnosis.hpp"

namespace recoil {
namespace {

DiagnosisFile::Misfit misfit_of(const Diagnosis& d) {
  DiagnosisFile::Misfit out = {.p_value = d.structure.p_value,
                               .simulated = d.structure.simulated,
                               .failed = d.structure.failed,
                               .free_form_remaining_p = d.free_form_p};
  for (const StructureTest& test : d.structure.tests) {
    out.tests.push_back({.id = test.question,
                         .asks = words_of(test.question),
                         .statistic = test.statistic,
                         .p_value = test.p_value});
  }
  for (const MisfitCell& cell : d.where) {
    out.where.push_back({.dataset = d.datasets[cell.dataset].id,
                         .diameter_um = in_um(cell.diameter),
                         .incident_velocity = {cell.slowest, cell.fastest},
                         .points = cell.points,
                         .restitution = cell.restitution,
                         .energy_J = cell.energy,
                         .standardised = cell.standardised,
                         .model_is = cell.restitution > 0.0 ? "too low" : "too high"});
  }
  return out;
}

std::optional<DiagnosisFile::Separable> separable(const std::optional<Separation>& found) {
  if (!found) return std::nullopt;
  return DiagnosisFile::Separable{found->rival, found->lambda, found->probability};
}

/// @param most largest number of listed candidates
std::vector<DiagnosisFile::Candidate> candidates_of(const std::vector<CandidateResult>& candidates,
                                                    std::size_t most) {
  std::vector<DiagnosisFile::Candidate> list;
  for (const CandidateResult& c : candidates) {
    if (list.size() == most) break;
    DiagnosisFile::Candidate& out = list.emplace_back();
    out.id = c.candidate.name();
    out.kind = c.kind;
    for (const FoundParameter& p : c.parameters) {
      out.parameters.push_back({p.label,
                                {.value = p.value,
                                 .sd = p.sd > 0.0 ? std::optional(p.sd) : std::nullopt,
                                 .unit = p.unit,
                                 .null_value = p.null_value,
                                 .stated_by = p.stated_by,
                                 .plausible = p.plausible()}});
    }
    out.p_value = c.p_value;
    out.delta_aicc = c.delta_aicc;
    out.remaining_p = c.remaining_p;
    out.remaining_part = c.remaining_part;
    if (c.gain) {
      out.held_out_gain = c.gain->relative;
      out.held_out_log_score = c.gain->log_score;
    }
    out.plausible = c.plausible;
    out.cost_of_possible = c.cost_of_possible;
    if (!c.explains()) out.aside = set_aside_words(c);
    out.separation = separable(c.separation);
    out.separation_allowed = separable(c.separation_allowed);
  }
  return list;
}

std::optional<DiagnosisFile::Gain> gain_of(const Diagnosis& d) {
  const HeldOutGain* const gain = d.gain();
  if (!gain) return std::nullopt;
  DiagnosisFile::Gain out = {.held_out_rmse_base = gain->rmse_base,
                             .held_out_rmse_extended = gain->rmse_extended,
                             .relative = gain->relative,
                             .log_score = gain->log_score};
  if (gain->lower && gain->upper) out.interval = {*gain->lower, *gain->upper};
  for (const HeldOutGain::PerFold& one : gain->folds) {
    out.folds.push_back({.kind = one.fold.kind,
                         .name = fold_words(one.fold, d.datasets),
                         .points = one.fold.points.size(),
                         .rmse_base = one.rmse_base,
                         .rmse_extended = one.rmse_extended,
                         .log_score = one.log_score,
                         .counted = one.counted,
                         .chosen = one.chosen});
  }
  return out;
}

DiagnosisFile::Fit fit_of(const FitResult& fitted, const std::vector<IntervalSet>& intervals) {
  DiagnosisFile::Fit out = {.chi2 = fitted.chi2, .dof = fitted.dof, .rmse = fitted.rmse};
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    if (slot.is_constant()) continue;
    DiagnosisFile::FittedParameter& parameter =
        out.parameters.emplace_back(slot.label(), DiagnosisFile::FittedParameter()).second;
    parameter.value = fitted.theta[j];
    parameter.unit = slot.parameter->unit;
    parameter.free = slot.free;
    parameter.std_error = fitted.std_error[j];
    if (j < intervals.size()) {
      parameter.interval.emplace(ends_of(recommended_interval(intervals[j])));
    }
  }
  return out;
}

std::vector<DiagnosisFile::Experiment> experiments_of(const Diagnosis& d) {
  std::vector<DiagnosisFile::Experiment> list;
  for (const NextExperiment& next : d.next.list) {
    DiagnosisFile::Experiment& out = list.emplace_back();
    out.kind = next.kind;
    if (next.kind == ExperimentKind::condition) {
      out.condition = next.condition;
      out.value = next.value;
      out.doing = std::string(next.doing);
    }
    out.dataset = d.datasets[next.dataset].id;
    out.series = d.datasets[next.dataset].series[next.series];
    out.diameter_um = in_um(next.diameter);
    out.incident_velocity = next.velocity;
    out.events = next.events;
    out.expensive = next.expensive();
    out.separates = {next.one, next.other};
    out.expected_difference = next.difference;
    out.expected_log_odds = next.log_odds;
    out.worst_log_odds = next.worst_log_odds;
  }
  return list;
}

std::vector<DiagnosisFile::Unstated> unstated_of(const Diagnosis& d) {
  const std::vector<UnstatedErrors> rivals = rival_errors(d);
  std::vector<DiagnosisFile::Unstated> list;
  for (const UnstatedErrors& errors : d.unstated) {
    const bool rival = std::ranges::any_of(
        rivals, [&](const UnstatedErrors& other) { return other.source == errors.source; });
    list.push_back({.id = errors.source,
                    .value = errors.value,
                    .delta_aicc = errors.delta_aicc,
                    .remaining_p = errors.remaining_p,
                    .leave_nothing = errors.leave_nothing(),
                    .rival = rival});
  }
  return list;
}

}  // namespace

std::string diagnosis_json(const Diagnosis& d) {
  DiagnosisFile out;
  out.fit = d.spec.id;
  for (const Dataset& dataset : d.datasets) {
    out.datasets.push_back({dataset.id, dataset.provenance, dataset.points.size(), dataset.sha256});
  }
  set_restitution(out, d.datasets, d.base.model);
  out.verdict = d.verdict();
  out.headline = plain_text(headline(d));
  if (d.fitted) out.model_verdict = model_verdict_of(*d.fitted);
  out.text = answer_words(d);
  out.misfit = misfit_of(d);
  for (const OutlyingPoint& point : d.outlying) {
    out.outlying_points.push_back({.dataset = d.datasets[point.dataset].id,
                                   .row = point.line,
                                   .diameter_um = in_um(point.diameter),
                                   .incident_velocity = point.velocity,
                                   .restitution = point.restitution,
                                   .residual = point.residual});
  }
  if (const auto& all = d.for_all) {
    out.with_outlying_points = {all->verdict, all->named, all->rivals, all->resembles};
  }
  out.law_error = d.spec.law_error;
  out.named = d.named();
  out.rivals = d.rivals();
  out.resembles = d.resembles();
  if (const auto& exact = d.if_exact) out.if_exact = {exact->p_value, exact->named, exact->listed};
  if (const auto* adequate = d.answer_if<Adequate>()) {
    if (adequate->materials) out.rivals.emplace_back("materials_within_errors");
  }
  if (const auto* several = d.answer_if<NotSeparable>()) {
    out.in_every_explanation = several->common;
    if (several->law_error) out.rivals.emplace_back(law_error_as_rival);
    if (!several->shared_cause.empty()) out.shared_cause = several->shared_cause;
  }
  out.candidates = candidates_of(d.candidates, d.candidates.size());
  constexpr std::size_t listed_pairs = 20;
  out.pairs = candidates_of(d.pairs, listed_pairs);
  out.gain = gain_of(d);
  const ExtendedModel none;
  const ExtendedModel& extended = d.extended() ? *d.extended() : none;
  out.base = fit_of(d.base, extended.base_intervals);
  if (extended.fit) out.extended = fit_of(*extended.fit, extended.intervals);
  for (const CaptureChange& change : extended.capture) {
    out.capture_velocity.push_back({.dataset = d.datasets[change.dataset].id,
                                    .diameter_um = in_um(change.diameter),
                                    .base = change.base,
                                    .extended = change.extended});
  }
  out.next_experiment = experiments_of(d);
  for (const Inseparable& pair : d.next.inseparable) {
    out.inseparable.push_back({{pair.one, pair.other}, pair.difference});
  }
  for (const ExpectedEffect& effect : d.expected) {
    out.expected_effects.push_back({.id = effect.id,
                                    .dataset = d.datasets[effect.dataset].id,
                                    .condition = effect.condition,
                                    .value = effect.stated,
                                    .diameter_um = in_um(effect.diameter),
                                    .incident_velocity = effect.velocity,
                                    .change = effect.change});
  }
  out.unstated_errors = unstated_of(d);
  if (d.own_design) {
    DiagnosisFile::OwnDesignEntry own;
    for (const Detection& one : d.own_design->detection) {
      own.detection.push_back(
          {one.id, one.strength, one.datasets, one.named, one.listed, one.wrong});
    }
    own.false_alarms = {d.own_design->datasets,
                        static_cast<double>(d.own_design->alarms) / d.own_design->datasets};
    out.own_design = std::move(own);
  }
  out.settings = {.level = d.options.level,
                  .chance = d.options.chance,
                  .apart = d.options.margin,
                  .apart_in_pairs = d.options.margin_in_pairs,
                  .compared = d.structure.simulated,
                  .seed = d.options.seed};
  out.warnings = diagnosis_warnings(d);
  out.remarks = d.remarks;
  return text_of(out, 2);
}

}  // namespace recoil
