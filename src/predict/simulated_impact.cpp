#include "predict/simulated_impact.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/units.hpp"
#include "estimate/predictor.hpp"
#include "impact/impact.hpp"

namespace recoil {
namespace {

/// The energy that an impact loses without any damping, by its jumps [m V^2].
double lost_by_jumps(ImpactGroups groups, ImpactOptions options) {
  if (!traits(options.adhesion).jumps) return 0.0;
  groups.alpha = groups.gamma = groups.kappa = 0.0;
  options.budget = options.gradient = false;
  const ImpactResult undamped = simulate_impact(groups, options);
  return undamped.usable() ? std::max(0.0, 0.5 * (1.0 - undamped.restitution_squared)) : 0.0;
}

[[noreturn]] void refuse_impact(const PointConditions& at, const std::string& mechanisms,
                                ImpactOutcome outcome) {
  throw ComputationError(fmt::format("the impact at V = {:.6g} m/s, d = {:.6g} um{}: {}",
                                     at.velocity, at.diameter / units::um, mechanisms,
                                     to_string(outcome)));
}

}  // namespace

SimulatedImpact simulate_at(const ImpactModel& model, const std::vector<Dataset>& datasets,
                            const PointConditions& at) {
  SimulatedImpact out;
  out.asked = at;
  const std::vector<double> theta = model.initial();
  out.conditions = conditions_at(model, theta, at.dataset, at.diameter, at.velocity);
  out.diameter = at.diameter;
  out.density = materials_under(model, theta, at.dataset).density;
  out.groups = impact_groups(out.conditions);
  out.scales = impact_scales(out.conditions);
  ImpactOptions options = model.impact_options(true);
  options.budget = true;
  out.extended = !model.chain.empty() || averages_over_sizes(model, at.dataset);
  if (out.extended) {
    const Prediction measured = predict(model, theta, at.dataset, at.diameter, at.velocity, false);
    if (!measured.usable()) refuse_impact(at, " with its mechanisms", measured.outcome);
    out.restitution_squared = measured.restitution_squared;
    const ContactView view = contact_view(model, theta, at);
    out.groups = view.groups;
    out.scales = view.scales;
    options.dashpot = view.dashpot;
    options.never_pulls = view.never_pulls;
    out.conditions.velocity = view.encounter.velocity;
    out.diameter = value_of(view.encounter.diameter);
    out.conditions.adhesion_force = view.encounter.adhesion_force;
    out.yields = view.encounter.flow_pressure > 0.0;
  }
  out.impact = simulate_impact(out.groups, options, &out.history);
  if (!out.impact.usable()) refuse_impact(at, "", out.impact.outcome);
  if (out.yields) out.history.clear();
  if (out.extended) out.whole = whole_impact_energy(model, theta, at, out.impact);
  if (!out.extended) out.restitution_squared = out.impact.restitution_squared;
  out.jumps = lost_by_jumps(out.groups, options);
  out.validity = impact_validity(model, datasets[at.dataset].system, theta, at);
  return out;
}

std::vector<HistoryColumn> history_columns(const SimulatedImpact& s) {
  constexpr double uN = 1e-6;
  std::vector<HistoryColumn> columns;
  const auto add = [&](const char* name, double ImpactMoment::*value, double scale) {
    HistoryColumn column = {name, {}};
    for (const ImpactMoment& m : s.history) column.values.push_back(m.*value * scale);
    columns.push_back(std::move(column));
  };
  add("time_ns", &ImpactMoment::time, s.scales.time / units::ns);
  add("penetration_nm", &ImpactMoment::penetration, s.scales.length / units::nm);
  add("approach_velocity_m_s", &ImpactMoment::approach, s.scales.velocity);
  add("hertz_force_uN", &ImpactMoment::hertz, s.scales.force / uN);
  add("hertz_damping_force_uN", &ImpactMoment::hertz_damping, s.scales.force / uN);
  add("adhesion_force_uN", &ImpactMoment::adhesion, s.scales.force / uN);
  add("adhesion_damping_force_uN", &ImpactMoment::adhesion_damping, s.scales.force / uN);
  if (s.groups.kappa > 0.0) {
    add("dashpot_force_uN", &ImpactMoment::dashpot, s.scales.force / uN);
  }
  return columns;
}

}  // namespace recoil
