// Converts the results that only --json prints.
#include <algorithm>
#include <cmath>

#include "core/program.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "report/result_entries.hpp"
#include "report/result_json.hpp"
#include "report/words_dataset.hpp"
#include "report/words_fit.hpp"

namespace recoil {
namespace {

/// A share `part` / `whole` with its 95 % limits (Wilson 1927).
template <class Share>
Share share_of(int part, int whole) {
  Share out;
  out.held = part;
  out.offered = whole;
  if (whole == 0) return out;
  const ShareLimits wilson = share_limits(part, whole);
  out.share = static_cast<double>(part) / whole;
  out.limits = {wilson.lower, wilson.upper};
  return out;
}

CoverageFile::Row row_of(const CoverageRow& row) {
  CoverageFile::Row out = {.parameter = row.parameter,
                           .unit = row.unit,
                           .truth = row.truth,
                           .identifiable = row.identifiable,
                           .actual_error = row.actual_error};
  for (const CoverageCell& cell : row.cells) {
    auto entry = share_of<CoverageFile::Cell>(cell.held, cell.offered);
    entry.where_identifiable =
        share_of<CoverageFile::Share>(cell.held_identifiable, cell.offered_identifiable);
    entry.median_width = cell.median_width;
    out.intervals.emplace_back(cell.interval, entry);
  }
  return out;
}

CoverageFile coverage_file(const FitSpec& spec, const CoverageOptions& options,
                           const std::vector<Dataset>& datasets) {
  CoverageFile out = {.recoil_version = version(),
                      .fit = {.id = spec.id, .sha256 = spec.sha256},
                      .simulated = options.datasets,
                      .level = options.uncertainty.level,
                      .seed = options.uncertainty.seed};
  for (const Dataset& dataset : datasets) {
    out.datasets.push_back({dataset.id, dataset.provenance, dataset.sha256});
  }
  return out;
}

SimulationFile::Energy energy_of(const SimulatedImpact& s) {
  const EnergyBudget& energy = s.impact.energy;
  const double unit = s.scales.energy;
  const bool captured = s.impact.outcome == ImpactOutcome::captured;
  return {.incident = 0.5 * unit,
          .rebound = captured ? 0.0 : energy.kinetic * unit,
          .hertz_damping = energy.hertz_loss * unit,
          .adhesion_damping = energy.adhesion_loss * unit,
          .dashpot = energy.dashpot_loss * unit,
          .jumps = s.jumps * unit,
          .still_bound = captured ? (energy.kinetic + energy.potential) * unit : 0.0};
}

SimulationFile::Contact contact_of(const SimulatedImpact& s) {
  const bool captured = s.impact.outcome == ImpactOutcome::captured;
  const auto if_elastic = [&](double value) {
    return s.yields ? std::nullopt : OrNull<double>(value);
  };
  return {.incident_velocity = s.conditions.velocity,
          .diameter_um = s.diameter / units::um,
          .restitution = captured ? 0.0 : std::sqrt(std::max(s.impact.restitution_squared, 0.0)),
          .outcome = to_string(s.impact.outcome),
          .stiffness_K_Pa = s.conditions.stiffness,
          .f0_N_per_m = s.conditions.adhesion_force,
          .density_kg_per_m3 = s.density,
          .contact_time_s = if_elastic(s.impact.contact_time * s.scales.time),
          .penetration_m = if_elastic(s.impact.penetration_max * s.scales.length),
          .largest_push_N = if_elastic(s.impact.force_compression * s.scales.force),
          .largest_pull_N = s.impact.force_tension * s.scales.force,
          .energy_J = energy_of(s)};
}

SimulationFile::WholeImpact whole_of(const ImpactModel& model, const WholeImpactEnergy& whole) {
  SimulationFile::WholeImpact out = {
      .incident = whole.incident, .contact = whole.contact, .rebound = whole.rebound};
  for (std::size_t k = 0; k < model.chain.size(); ++k) {
    out.mechanisms.push_back({std::string(model.chain[k]->info.id), whole.in[k], whole.out[k]});
  }
  return out;
}

}  // namespace

std::string coverage_json(const CoverageResult& result, const FitSpec& spec,
                          const CoverageOptions& options, const std::vector<Dataset>& datasets) {
  const UncertaintyOptions& uncertainty = options.uncertainty;
  CoverageFile out = coverage_file(spec, options, datasets);
  out.truth = result.truth_origin;
  out.replicates = uncertainty.replicates_auto ? Json("auto") : Json(uncertainty.replicates);
  out.failed = result.failed;
  out.refits_failed = result.refits_failed;
  for (const CoverageRow& row : result.rows) out.rows.push_back(row_of(row));
  return text_of(out);
}

std::string posterior_check_json(const PosteriorStudy& study, const PosteriorCheck& check,
                                 const FitSpec& spec, const CoverageOptions& options) {
  CoverageFile out = coverage_file(spec, options, study.datasets);
  out.truth = TruthOrigin::posterior;
  out.replicates = Json(0);
  out.failed = check.failed;
  CoverageFile::PosteriorSbc found = {.text = plain_text(posterior_check_words(study, check)),
                                      .verdict = check.verdict,
                                      .because = check.because,
                                      .sets = check.sets,
                                      .p_value = check.p_value};
  for (const RankedParameter& one : check.parameters) {
    found.parameters.push_back({one.parameter,
                                {.p_value = one.p_value,
                                 .error_ratio = one.error_ratio,
                                 .error_ratio_limits = Ends{one.ratio_lower, one.ratio_upper},
                                 .shift = one.shift,
                                 .shift_sd = one.shift_sd,
                                 .held = one.held}});
  }
  out.posterior.emplace(std::move(found));
  return text_of(out);
}

DatasetReference dataset_reference(const Dataset& dataset) {
  return {dataset.id, dataset.provenance, provenance_sentence(dataset.provenance), dataset.sha256};
}

std::string simulation_json(const ImpactModel& model, const std::vector<Dataset>& datasets,
                            const SimulatedImpact& s, const std::string& fit,
                            const std::string& values) {
  const double e = s.captured() ? 0.0 : std::sqrt(s.restitution_squared);
  SimulationFile out = {.recoil_version = version(),
                        .fit = fit,
                        .dataset = dataset_reference(datasets[s.asked.dataset]),
                        .values_from = values,
                        .incident_velocity = s.asked.velocity,
                        .diameter_um = s.asked.diameter / units::um,
                        .restitution = e,
                        .restitution_squared = s.restitution_squared,
                        .outcome = s.captured() ? "captured" : "rebound",
                        .rebound_velocity = e * s.asked.velocity,
                        .contact = contact_of(s)};
  for (const ParameterSlot& slot : model.slots) {
    if (slot.is_constant()) continue;
    out.parameters.push_back({slot.label(), {slot.initial, std::string(slot.parameter->unit)}});
  }
  if (s.extended) out.whole_impact_J = whole_of(model, s.whole);
  for (const Validity& one : s.validity) {
    const ValidityEntry check = validity_entry(one);
    out.validity.push_back(
        {check.quantity, check.value, check.limit, check.limit_is, check.exceeded, check.text});
  }
  Named<std::vector<double>> columns;
  for (const HistoryColumn& column : history_columns(s)) {
    columns.emplace_back(column.name, column.values);
  }
  read_json(as_json(columns), out.history);
  return text_of(out, 1);
}

}  // namespace recoil
