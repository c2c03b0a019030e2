#include <algorithm>
#include <cmath>

#include "core/json.hpp"
#include "core/program.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "report/result_json.hpp"
#include "report/words_dataset.hpp"

namespace recoil {

Json result_head() { return {{"format_version", format_version}, {"recoil_version", version()}}; }

namespace {

/// A share `part` / `whole` with its 95 % limits (Wilson 1927).
Json share_json(int part, int whole) {
  Json limits = nullptr;
  if (whole > 0) {
    const ShareLimits wilson = share_limits(part, whole);
    limits = {wilson.lower, wilson.upper};
  }
  return {{"held", part},
          {"offered", whole},
          {"share", whole > 0 ? Json(static_cast<double>(part) / whole) : Json(nullptr)},
          {"limits", limits}};
}

Json row_json(const CoverageRow& row) {
  Json intervals = Json::object();
  for (const CoverageCell& cell : row.cells) {
    Json entry = share_json(cell.held, cell.offered);
    entry["where_identifiable"] = share_json(cell.held_identifiable, cell.offered_identifiable);
    entry["median_width"] = number_or_null(cell.median_width);
    intervals[cell.interval] = std::move(entry);
  }
  Json out = as_json(row);
  out.erase("cells");
  out["intervals"] = std::move(intervals);
  return out;
}

}  // namespace

std::string coverage_json(const CoverageResult& result, const FitSpec& spec,
                          const CoverageOptions& options, const std::vector<Dataset>& datasets) {
  Json out = result_head();
  out["fit"] = {{"id", spec.id}, {"sha256", spec.sha256}};
  out["datasets"] = Json::array();
  for (const Dataset& dataset : datasets) {
    out["datasets"].push_back({{"id", dataset.id},
                               {"provenance", to_string(dataset.provenance)},
                               {"sha256", dataset.sha256}});
  }
  out["simulated"] = result.datasets;
  out["truth"] = to_string(result.truth_origin);
  out["level"] = options.uncertainty.level;
  out["replicates"] =
      options.uncertainty.replicates_auto ? Json("auto") : Json(options.uncertainty.replicates);
  out["seed"] = options.uncertainty.seed;
  out["failed"] = result.failed;
  out["refits_failed"] = result.refits_failed;
  out["rows"] = Json::array();
  for (const CoverageRow& row : result.rows) out["rows"].push_back(row_json(row));
  return json_text(out);
}

namespace {

Json energy_json(const SimulatedImpact& s) {
  const bool captured = s.impact.outcome == ImpactOutcome::captured;
  const auto joule = [&](double energy) { return number_or_null(energy * s.scales.energy); };
  return {
      {"incident", joule(0.5)},
      {"rebound", joule(captured ? 0.0 : s.impact.energy.kinetic)},
      {"hertz_damping", joule(s.impact.energy.hertz_loss)},
      {"adhesion_damping", joule(s.impact.energy.adhesion_loss)},
      {"dashpot", joule(s.impact.energy.dashpot_loss)},
      {"jumps", joule(s.jumps)},
      {"still_bound", joule(captured ? s.impact.energy.kinetic + s.impact.energy.potential : 0.0)}};
}

Json contact_json(const SimulatedImpact& s) {
  const bool captured = s.impact.outcome == ImpactOutcome::captured;
  const double e = std::sqrt(std::max(s.impact.restitution_squared, 0.0));
  const auto if_elastic = [&](double value) { return s.yields ? Json() : number_or_null(value); };
  return {{"incident_velocity", s.conditions.velocity},
          {"diameter_um", s.diameter / units::um},
          {"restitution", captured ? Json(0.0) : number_or_null(e)},
          {"outcome", to_string(s.impact.outcome)},
          {"stiffness_K_Pa", number_or_null(s.conditions.stiffness)},
          {"f0_N_per_m", number_or_null(s.conditions.adhesion_force)},
          {"density_kg_per_m3", number_or_null(s.density)},
          {"contact_time_s", if_elastic(s.impact.contact_time * s.scales.time)},
          {"penetration_m", if_elastic(s.impact.penetration_max * s.scales.length)},
          {"largest_push_N", if_elastic(s.impact.force_compression * s.scales.force)},
          {"largest_pull_N", number_or_null(s.impact.force_tension * s.scales.force)},
          {"energy_J", energy_json(s)}};
}

}  // namespace

Json dataset_json(const Dataset& dataset) {
  return {{"id", dataset.id},
          {"provenance", to_string(dataset.provenance)},
          {"provenance_sentence", provenance_sentence(dataset.provenance)},
          {"sha256", dataset.sha256}};
}

std::string simulation_json(const ImpactModel& model, const std::vector<Dataset>& datasets,
                            const SimulatedImpact& s, const std::string& fit,
                            const std::string& values) {
  const Dataset& dataset = datasets[s.asked.dataset];
  Json out = result_head();
  out["fit"] = fit;
  out["dataset"] = dataset_json(dataset);
  out["values_from"] = values;
  out["parameters"] = Json::object();
  for (const ParameterSlot& slot : model.slots) {
    if (slot.is_constant()) continue;
    out["parameters"][slot.label()] = {{"value", number_or_null(slot.initial)},
                                       {"unit", slot.parameter->unit}};
  }
  out["incident_velocity"] = s.asked.velocity;
  out["diameter_um"] = s.asked.diameter / units::um;
  const double e = s.captured() ? 0.0 : std::sqrt(s.restitution_squared);
  out["restitution"] = number_or_null(e);
  out["restitution_squared"] = number_or_null(s.restitution_squared);
  out["outcome"] = s.captured() ? "captured" : "rebound";
  out["rebound_velocity"] = number_or_null(e * s.asked.velocity);
  if (s.extended) {
    Json mechanisms = Json::array();
    for (std::size_t k = 0; k < model.chain.size(); ++k) {
      mechanisms.push_back({{"id", std::string(model.chain[k]->info.id)},
                            {"on_the_way_in", number_or_null(s.whole.in[k])},
                            {"on_the_way_out", number_or_null(s.whole.out[k])}});
    }
    out["whole_impact_J"] = {{"incident", number_or_null(s.whole.incident)},
                             {"mechanisms", mechanisms},
                             {"contact", number_or_null(s.whole.contact)},
                             {"rebound", number_or_null(s.whole.rebound)}};
  }
  out["contact"] = contact_json(s);
  out["validity"] = Json::array();
  for (const Validity& one : s.validity) out["validity"].push_back(as_json(validity_entry(one)));
  Json history = Json::object();
  for (const HistoryColumn& column : history_columns(s)) {
    history[column.name] = as_json(column.values);
  }
  out["history"] = history;
  return json_text(out, 1);
}

}  // namespace recoil
