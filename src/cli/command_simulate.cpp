#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/units.hpp"
#include "document/terminal.hpp"
#include "estimate/predictor.hpp"
#include "impact/sensitivity.hpp"
#include "json/fit_file.hpp"
#include "predict/simulated_impact.hpp"
#include "predict/validity.hpp"
#include "report/result_json.hpp"
#include "report/words_dataset.hpp"
#include "report/words_validity.hpp"

namespace recoil {
namespace {

constexpr std::size_t indent = 2;  // of tables

std::string history_csv(const SimulatedImpact& simulated) {
  const std::vector<HistoryColumn> columns = history_columns(simulated);
  std::string csv;
  for (const HistoryColumn& column : columns) csv += (csv.empty() ? "" : ",") + column.name;
  csv += '\n';
  for (std::size_t row = 0; row < simulated.history.size(); ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      csv += fmt::format("{}{:.6g}", c == 0 ? "" : ",", columns[c].values[row]);
    }
    csv += '\n';
  }
  return csv;
}

/// Over which spheres e averages: "spheres that differ (polydispersity)"; empty if they are alike.
std::string averaged_words(const ImpactModel& model, std::size_t dataset) {
  if (averages_over_sizes(model, dataset)) return "the sizes that the dataset states";
  std::vector<std::string_view> ids;
  for (const Mechanism* mechanism : model.chain) {
    if (mechanism->spreads()) ids.push_back(mechanism->info.id);
  }
  return ids.empty() ? "" : fmt::format("spheres that differ ({})", fmt::join(ids, ", "));
}

/// Prints e as a fit predicts it, and the contribution of every mechanism.
void print_mechanisms(const ImpactModel& model, std::size_t dataset, double diameter,
                      double velocity) {
  const std::vector<double> theta = model.initial();
  const auto square = [&](const std::vector<double>& values) {
    const Prediction at = predict(model, values, dataset, diameter, velocity, false);
    if (!at.usable()) {
      throw ComputationError(
          fmt::format("the impact at V = {:.6g} m/s, d = {:.6g} um with its mechanisms: {}",
                      velocity, diameter / units::um, to_string(at.outcome)));
    }
    return at.restitution_squared;
  };
  const double all = square(theta);
  print_text("restitution: {:.8f}\n", std::sqrt(std::max(all, 0.0)));
  print_text("outcome: {}\n", all > 0.0 ? "rebound" : "captured");
  if (const std::string spheres = averaged_words(model, dataset); !spheres.empty()) {
    print_line(fmt::format(
        "this is the mean of the rebounds over {}; the energies and forces below are those of one "
        "sphere of the stated diameter, {:.6g} um",
        spheres, diameter / units::um));
  }
  if (model.chain.empty()) return;
  print_text("e^2 with mechanisms: {:+.8f}, base model alone: {:+.8f}\n", all,
             square(without_mechanisms(model, theta)));
  Table table;
  table.caption = "change of e^2 when one mechanism is left out, the others kept:";
  table.columns = {{"mechanism"}, {say("{e}^2")}, {"kind", "", true}, {"parameters", "", true}};
  for (const Mechanism* mechanism : model.chain) {
    std::vector<double> without = theta;
    std::vector<Sentence> values;
    for (std::size_t j = 0; j < theta.size(); ++j) {
      const ParameterSlot& slot = model.slots[j];
      if (slot.mechanism() != mechanism) continue;
      without[j] = slot.parameter->null_value;
      values.push_back(say("{} = {:.6g}", symbol(slot.label()), slot.initial) +
                       unit_after_number(slot.parameter->unit));
    }
    table.rows.push_back({Sentence(mechanism->info.id),
                          Number{square(without) - all, signed_fixed(6)},
                          Sentence(to_string(mechanism->info.kind)), join(values, ", ")});
  }
  print_text("{}", terminal_text(table, indent));
}

/// The energy budget of the whole impact with its mechanisms.
Table whole_energy_table(const ImpactModel& model, const WholeImpactEnergy& energy) {
  Table table;
  table.caption =
      say("energy budget of the whole impact, of {:.6g} J incident as measured:", energy.incident);
  table.columns = {{}, {"share", "%"}, {"energy", "J"}};
  double left = energy.incident;
  const auto share = [&](const std::string& name, double taken) {
    left -= taken;
    if (taken == 0.0) return;
    table.rows.push_back({Sentence(name), Number{100.0 * taken / energy.incident, fixed(5)},
                          Number{taken, significant(6)}});
  };
  for (std::size_t k = 0; k < energy.in.size(); ++k) {
    share(std::string(model.chain[k]->info.id) + ", on the way in", energy.in[k]);
  }
  share("the impact of the base model (below)", energy.contact);
  for (std::size_t k = energy.out.size(); k-- > 0;) {
    share(std::string(model.chain[k]->info.id) + ", on the way out", energy.out[k]);
  }
  share(energy.rebound > 0.0 ? "rebound" : "lacking for a rebound", energy.rebound);
  table.rows.push_back({"audit (should be 0)", Number{left / energy.incident, scientific(1)}, {}});
  return table;
}

/// The energy budget of the base model.
/// @param jumps energy that an undamped contact loses by jumping in and out [m V^2]
Table energy_budget(const ImpactGroups& groups, const ImpactScales& scales,
                    const ImpactResult& impact, double jumps) {
  const bool captured = impact.outcome == ImpactOutcome::captured;
  Table table;
  table.caption = say("energy budget, of {:.6g} J incident:", 0.5 * scales.energy);
  table.columns = {{}, {"share", "%"}, {"energy", "J"}};
  const auto share = [&](const Sentence& name, double energy) {
    table.rows.push_back(
        {name, Number{200.0 * energy, fixed(5)}, Number{energy * scales.energy, significant(6)}});
  };
  share("rebound", captured ? 0.0 : impact.energy.kinetic);
  share(say("Hertz damping ({C_H})"), impact.energy.hertz_loss);
  share(say("adhesion damping ({C_A})"), impact.energy.adhesion_loss);
  if (groups.kappa > 0.0) share("dashpot of the mechanisms", impact.energy.dashpot_loss);
  if (jumps > 0.0) share("jumping in and out of contact", jumps);
  if (captured) {
    share("still bound in the contact", impact.energy.kinetic + impact.energy.potential);
  }
  const double audit = impact.energy.audit() - jumps / std::max(impact.energy.largest, 0.5);
  table.rows.push_back({"audit (should be 0)", Number{audit, scientific(1)}, {}});
  return table;
}

/// Prints the impact of the base model, with the conditions at the contact.
void print_impact(const SimulatedImpact& simulated, const Dataset& dataset,
                  const ContactProperties& contact, AdhesionDampingPhase phase) {
  const ImpactResult& impact = simulated.impact;
  const ImpactGroups& groups = simulated.groups;
  const ImpactScales& scales = simulated.scales;
  const ImpactConditions& c = simulated.conditions;
  const double e = std::sqrt(std::max(impact.restitution_squared, 0.0));
  const bool captured = impact.outcome == ImpactOutcome::captured;
  if (simulated.extended) {
    print_text("\n");
    print_line(fmt::format(
        "the impact of the base model at the contact of one sphere, in at {:.6g} m/s{}:",
        c.velocity, captured ? "; captured" : fmt::format(", out at {:.6g} m/s", e * c.velocity)));
  } else {
    print_text("restitution: {:.8f}\n", captured ? 0.0 : e);
    print_text("outcome: {}\n", to_string(impact.outcome));
    print_text("rebound velocity: {:.6g} m/s\n", captured ? 0.0 : e * c.velocity);
  }
  if (simulated.yields) {
    print_line(
        "the contact yields: contact time, largest penetration and push of the impact are not "
        "computed; what follows is the elastic rebound of the flattened contact");
  } else {
    print_text("contact time: {:.6g} ns{}\n", impact.contact_time * scales.time / units::ns,
               captured ? " (until the first outer turning point)" : "");
    print_text("largest penetration: {:.6g} nm\n",
               impact.penetration_max * scales.length / units::nm);
    print_text("largest push: {:.6g} uN\n", impact.force_compression * scales.force * 1e6);
  }
  print_text("largest pull: {:.6g} uN\n", impact.force_tension * scales.force * 1e6);
  print_text("{}", terminal_text(energy_budget(groups, scales, impact, simulated.jumps), indent));
  const std::string adhesion =
      groups.beta > 0.0
          ? fmt::format("V / V_a = {:.6g} (V_a = {:.6g} m/s)", std::pow(groups.beta, -1.25),
                        c.velocity * std::pow(groups.beta, 1.25))
          : "V_a = 0 (no adhesion)";
  print_line(fmt::format("groups: C_H V = {:.6g}, C_A V = {:.6g}, {}", groups.alpha, groups.gamma,
                         adhesion));
  print_line(
      fmt::format("model: K = {:.6g} GPa, f0 = {:.6g} N/m at this diameter, adhesion damping: {}",
                  c.stiffness / units::GPa, c.adhesion_force, to_string(phase)));
  if (captured) {
    print_line(
        "note: adhesion did work on the sphere on its way in, so the shares can exceed 100 %; the "
        "share still bound in the contact is negative");
  }
  for (const std::string& line : contact.contradictions) print_line("note: " + line);
  print_line(fmt::format("dataset: {} ({}): {}", dataset.id, to_string(dataset.provenance),
                         provenance_sentence(dataset.provenance)));
}

/// The change of e in percent for a change of each quantity by one percent.
Table sensitivities(const ImpactConditions& c, const ImpactResult& impact, const Dataset& dataset) {
  Table table;
  if (!(impact.restitution_squared > 0.0)) return table;
  table.caption = "change of e for 1 % more of one quantity, the others held:";
  table.columns = {{}, {say("{e}"), "%"}};
  const ImpactSensitivity s = impact_sensitivity(c, impact);
  const auto line = [&](const Sentence& name, double slope, double value) {
    table.rows.push_back(
        {name, Number{0.5 * slope * value / impact.restitution_squared, signed_fixed(5)}});
  };
  line("incident velocity", s.velocity, c.velocity);
  const bool flat = !dataset.system.surface_diameter;
  if (flat) line(say("diameter ({f0} held)"), s.diameter, c.diameter);
  line(say("{C_H}"), s.hertz_damping, c.hertz_damping);
  line(say("{C_A}"), s.adhesion_damping, c.adhesion_damping);
  line(say("{f0}"), s.adhesion_force, c.adhesion_force);
  line(say("{K}"), s.stiffness, c.stiffness);
  if (flat) line("density", s.density, c.density);
  if (dataset.system.stiffness_K) return table;
  const StiffnessSensitivity k = stiffness_sensitivity(dataset.system);
  const Material& sphere = dataset.system.particle;
  const Material& surface = dataset.system.surface;
  line("Young's modulus, sphere", s.stiffness * k.youngs_particle, sphere.youngs_modulus);
  line("Young's modulus, surface", s.stiffness * k.youngs_surface, surface.youngs_modulus);
  line("Poisson's ratio, sphere", s.stiffness * k.poisson_particle, sphere.poisson_ratio);
  line("Poisson's ratio, surface", s.stiffness * k.poisson_surface, surface.poisson_ratio);
  return table;
}

/// A diameter that is 10 times smaller or larger than all of the data may be in another unit.
void warn_if_far(const Dataset& dataset, double diameter) {
  constexpr double far = 10.0;
  const std::vector<double> measured = distinct_diameters(dataset);
  if (measured.empty()) return;
  if (diameter * far > measured.front() && diameter < measured.back() * far) return;
  print_text(stderr,
             "warning: the spheres of {} measure {:.4g} to {:.4g} um, but this one {:.4g} um\n",
             dataset.id, in_um(measured.front()), in_um(measured.back()), in_um(diameter));
}

void simulate(const GivenOptions& given) {
  const std::string history = given.text("--history");
  const std::string parameters = given.text("--parameters");
  if (!history.empty()) require_writable_folder(std::filesystem::absolute(history).parent_path());
  const std::optional<FitFile> fitted = read_parameters(parameters);
  const FitSpec spec = with_fitted_loss(load_fit(given.text("FIT")), fitted);
  const std::vector<Dataset> datasets = load_datasets(spec);
  ImpactModel model = make_model(spec, datasets);
  if (fitted) take_fitted_values(model, datasets, *fitted, parameters);
  if (!history.empty()) require_free({history});
  const std::size_t d = choose_dataset(datasets, given.text("--dataset"));
  const PointConditions at = {d, given.number("--diameter"), given.number("--velocity")};
  warn_if_far(datasets[d], at.diameter);
  const SimulatedImpact simulated = simulate_at(model, datasets, at);
  if (!history.empty()) write_whole_file(history, history_csv(simulated));
  if (given.has("--json")) {
    print_text("{}", simulation_json(
                         model, datasets, simulated, spec.id,
                         parameters.empty() ? "the initial values of the fit file" : parameters));
    return;
  }
  const ImpactConditions start = conditions_at(model, model.initial(), d, at.diameter, at.velocity);
  print_line("parameters: " +
             (parameters.empty() ? "initial values of the fit file (--parameters takes fitted ones)"
                                 : origin_words(*fitted, parameters)));
  print_text("  C_H = {:.6g} s/m, C_A = {:.6g} s/m\n", start.hertz_damping, start.adhesion_damping);
  if (simulated.extended) {
    print_mechanisms(model, d, at.diameter, at.velocity);
    if (!model.chain.empty()) {
      print_text("{}", terminal_text(whole_energy_table(model, simulated.whole), indent));
    }
  }
  print_impact(simulated, datasets[d], model.contacts[d], model.phase);
  print_text("{}", terminal_text(validity_table(simulated.validity), indent));
  for (const std::string& sentence : exceeded_limits(simulated.validity, {})) {
    print_line("note: " + sentence);
  }
  if (!simulated.extended) {
    print_text(
        "{}",
        terminal_text(sensitivities(simulated.conditions, simulated.impact, datasets[d]), indent));
  }
}

}  // namespace

void add_simulate(Program& program) {
  program.command("simulate", "simulate one impact, with its energy budget and force history", R"(
Uses the initial values of the fit file, or with --parameters the values of a fit.json.

  recoil simulate fits/wall1990-molybdenum.toml --velocity 5.2 --diameter 4.9 --history forces.csv)",
                  simulate);
}

}  // namespace recoil
