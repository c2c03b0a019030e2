#include "report/json_diagnosis.hpp"

#include <algorithm>

#include "core/units.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "report/answer_words.hpp"
#include "report/diagnosis_headline.hpp"
#include "report/json_target.hpp"
#include "report/json_values.hpp"
#include "report/words_diagnosis.hpp"

namespace recoil {
namespace {

Json optional_number(const std::optional<double>& value) {
  return value ? number_or_null(*value) : Json(nullptr);
}

Json structure_json(const Structure& structure) {
  Json tests = Json::array();
  for (const StructureTest& test : structure.tests) {
    tests.push_back({{"id", to_string(test.question)},
                     {"asks", words_of(test.question)},
                     {"statistic", number_or_null(test.statistic)},
                     {"p_value", test.p_value}});
  }
  return {{"p_value", structure.p_value},
          {"simulated", structure.simulated},
          {"failed", structure.failed},
          {"tests", tests}};
}

Json cell_json(const Diagnosis& d, const MisfitCell& cell) {
  return {{"dataset", d.datasets[cell.dataset].id},
          {"diameter_um", cell.diameter / units::um},
          {"incident_velocity", {cell.slowest, cell.fastest}},
          {"points", cell.points},
          {"restitution", number_or_null(cell.restitution)},
          {"energy_J", number_or_null(cell.energy)},
          {"standardised", number_or_null(cell.standardised)},
          {"model_is", cell.restitution > 0.0 ? "too low" : "too high"}};
}

Json parameters_json(const CandidateResult& candidate) {
  Json parameters = Json::object();
  for (const FoundParameter& p : candidate.parameters) {
    parameters[p.label] = {
        {"value", number_or_null(p.value)},
        {"sd", p.sd > 0.0 ? number_or_null(p.sd) : Json(nullptr)},
        {"unit", p.unit},
        {"null_value", p.null_value},
        {"stated_by", p.stated_by ? Json(to_string(*p.stated_by)) : Json(nullptr)},
        {"plausible", p.plausible()}};
  }
  return parameters;
}

Json candidate_json(const CandidateResult& c) {
  Json out = {{"id", c.candidate.name()},
              {"kind", to_string(c.kind)},
              {"parameters", parameters_json(c)},
              {"p_value", optional_number(c.p_value)},
              {"delta_aicc", number_or_null(c.delta_aicc)},
              {"remaining_p", c.remaining_p},
              {"remaining_part", c.remaining_part},
              {"held_out_gain", c.gain ? number_or_null(c.gain->relative) : Json(nullptr)},
              {"held_out_log_score", c.gain ? number_or_null(c.gain->log_score) : Json(nullptr)},
              {"plausible", c.plausible},
              {"cost_of_possible", c.cost_of_possible}};
  out["aside"] = c.explains() ? Json(nullptr) : Json(set_aside_words(c));
  return out;
}

Json candidates_json(const std::vector<CandidateResult>& candidates, std::size_t most) {
  Json out = Json::array();
  for (const CandidateResult& c : candidates) {
    if (out.size() < most) out.push_back(candidate_json(c));
  }
  return out;
}

Json gain_json(const Diagnosis& d) {
  if (!d.gain) return nullptr;
  Json folds = Json::array();
  for (const HeldOutGain::PerFold& fold : d.gain->folds) {
    folds.push_back({{"kind", to_string(fold.fold.kind)},
                     {"name", fold_words(fold.fold, d.datasets)},
                     {"points", fold.fold.points.size()},
                     {"rmse_base", number_or_null(fold.rmse_base)},
                     {"rmse_extended", number_or_null(fold.rmse_extended)},
                     {"log_score", number_or_null(fold.log_score)},
                     {"counted", fold.counted},
                     {"chosen", fold.chosen}});
  }
  Json interval = nullptr;
  if (d.gain->lower && d.gain->upper) interval = {*d.gain->lower, *d.gain->upper};
  return {{"held_out_rmse_base", number_or_null(d.gain->rmse_base)},
          {"held_out_rmse_extended", number_or_null(d.gain->rmse_extended)},
          {"relative", number_or_null(d.gain->relative)},
          {"interval", interval},
          {"log_score", number_or_null(d.gain->log_score)},
          {"folds", folds}};
}

Json fit_json(const FitResult& fitted, const std::vector<IntervalSet>& intervals) {
  Json parameters = Json::object();
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    if (slot.is_constant()) continue;
    parameters[slot.label()] = {{"value", number_or_null(fitted.theta[j])},
                                {"unit", slot.parameter->unit},
                                {"free", slot.free},
                                {"std_error", number_or_null(fitted.std_error[j])}};
    if (j < intervals.size()) {
      parameters[slot.label()]["interval"] = interval_json(recommended_interval(intervals[j]));
    }
  }
  return {{"parameters", parameters},
          {"chi2", number_or_null(fitted.chi2)},
          {"dof", fitted.dof},
          {"rmse", number_or_null(fitted.rmse)}};
}

Json next_json(const Diagnosis& d) {
  Json out = Json::array();
  for (const NextMeasurement& next : d.next) {
    out.push_back({{"dataset", d.datasets[next.dataset].id},
                   {"incident_velocity", next.velocity},
                   {"diameter_um", next.diameter / units::um},
                   {"separates", {next.one, next.other}},
                   {"expected_difference", number_or_null(next.difference)},
                   {"event_sd", number_or_null(next.event_sd)},
                   {"events", next.events ? Json(*next.events) : Json(nullptr)}});
  }
  return out;
}

Json experiments_json(const Diagnosis& d) {
  Json out = Json::array();
  for (const NextExperiment& next : d.experiments) {
    Json entry = {{"kind", to_string(next.kind)}};
    if (next.kind == ExperimentKind::condition) {
      entry["condition"] = to_string(next.condition);
      entry["value"] = next.value;
      entry["doing"] = next.doing;
    }
    if (next.kind == ExperimentKind::target) add_target(entry, next.material, next.places);
    entry["dataset"] = d.datasets[next.dataset].id;
    entry["series"] = d.datasets[next.dataset].series[next.series];
    entry["diameter_um"] = next.diameter / units::um;
    entry["incident_velocity"] = next.velocity;
    entry["events"] = next.events;
    entry["separates"] = {next.one, next.other};
    entry["expected_difference"] = number_or_null(next.difference);
    entry["expected_log_odds"] = number_or_null(next.log_odds);
    out.push_back(std::move(entry));
  }
  return out;
}

Json expected_json(const Diagnosis& d) {
  Json out = Json::array();
  for (const ExpectedEffect& effect : d.expected) {
    out.push_back({{"id", effect.id},
                   {"dataset", d.datasets[effect.dataset].id},
                   {"condition", to_string(effect.condition)},
                   {"value", effect.stated},
                   {"diameter_um", effect.diameter / units::um},
                   {"incident_velocity", effect.velocity},
                   {"change", number_or_null(effect.change)}});
  }
  return out;
}

/// Each with whether it would do in place of the answer, or beside it.
Json unstated_json(const Diagnosis& d) {
  const std::vector<UnstatedErrors> rivals = rival_errors(d);
  Json out = Json::array();
  for (const UnstatedErrors& errors : d.unstated) {
    const bool rival = std::any_of(rivals.begin(), rivals.end(), [&](const UnstatedErrors& other) {
      return other.source == errors.source;
    });
    out.push_back({{"id", to_string(errors.source)},
                   {"value", errors.value},
                   {"delta_aicc", errors.delta_aicc},
                   {"remaining_p", errors.remaining_p},
                   {"leave_nothing", errors.leave_nothing()},
                   {"rival", rival}});
  }
  return out;
}

/// `row` is the line in the dataset's file of points.
Json outlying_json(const Diagnosis& d) {
  Json out = Json::array();
  for (const OutlyingPoint& point : d.outlying) {
    out.push_back({{"dataset", d.datasets[point.dataset].id},
                   {"row", point.line},
                   {"diameter_um", point.diameter / units::um},
                   {"incident_velocity", point.velocity},
                   {"restitution", point.restitution},
                   {"residual", number_or_null(point.residual)}});
  }
  return out;
}

Json capture_json(const Diagnosis& d) {
  Json out = Json::array();
  for (const CaptureChange& change : d.capture) {
    out.push_back({{"dataset", d.datasets[change.dataset].id},
                   {"diameter_um", change.diameter / units::um},
                   {"base", optional_number(change.base)},
                   {"extended", optional_number(change.extended)}});
  }
  return out;
}

}  // namespace

std::string diagnosis_json(const Diagnosis& d) {
  Json out;
  out["format_version"] = format_version;
  out["fit"] = d.spec.id;
  Json datasets = Json::array();
  for (const Dataset& dataset : d.datasets) {
    datasets.push_back({{"id", dataset.id},
                        {"provenance", to_string(dataset.provenance)},
                        {"points", dataset.points.size()},
                        {"sha256", dataset.sha256}});
  }
  out["datasets"] = datasets;
  out["verdict"] = to_string(d.verdict);
  out["headline"] = headline(d);
  out["text"] = answer_words(d);
  out["misfit"] = structure_json(d.structure);
  out["misfit"]["where"] = Json::array();
  for (const MisfitCell& cell : d.where) out["misfit"]["where"].push_back(cell_json(d, cell));
  out["misfit"]["free_form_remaining_p"] = d.free_form_p;
  out["outlying_points"] = outlying_json(d);
  out["with_outlying_points"] = d.for_all ? Json{{"verdict", to_string(d.for_all->verdict)},
                                                 {"named", d.for_all->named},
                                                 {"rivals", d.for_all->rivals},
                                                 {"resembles", d.for_all->resembles}}
                                          : Json(nullptr);
  out["law_error"] = d.spec.law_error;
  out["named"] = d.named;
  std::vector<std::string> rivals = d.rivals;
  if (d.materials) rivals.emplace_back("materials_within_errors");
  out["rivals"] = rivals;
  out["resembles"] = d.resembles;
  out["in_every_explanation"] = d.common;
  out["shared_cause"] = d.shared_cause.empty() ? Json(nullptr) : Json(d.shared_cause);
  out["candidates"] = candidates_json(d.candidates, d.candidates.size());
  constexpr std::size_t most_pairs = 20;
  out["pairs"] = candidates_json(d.pairs, most_pairs);
  out["gain"] = gain_json(d);
  out["base"] = fit_json(d.base, d.base_intervals);
  out["extended"] =
      d.extended_fit ? fit_json(*d.extended_fit, d.extended_intervals) : Json(nullptr);
  out["capture_velocity"] = capture_json(d);
  out["next_measurement"] = next_json(d);
  out["next_experiment"] = experiments_json(d);
  out["expected_effects"] = expected_json(d);
  out["unstated_errors"] = unstated_json(d);
  out["settings"] = {
      {"level", d.options.level},       {"chance", d.options.chance},
      {"apart", d.options.margin},      {"apart_in_pairs", d.options.margin_in_pairs},
      {"compared", d.options.compared}, {"seed", d.options.seed}};
  out["warnings"] = diagnosis_warnings(d);
  out["remarks"] = d.remarks;
  return out.dump(2) + "\n";
}

}  // namespace recoil
