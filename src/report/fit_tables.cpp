#include "report/fit_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/program.hpp"
#include "core/units.hpp"
#include "report/format.hpp"
#include "report/words_intervals.hpp"
#include "report/words_noise.hpp"

namespace recoil {
namespace {

Sentence ending_words(const StartSummary& start) {
  switch (start.ending) {
    case DescentEnd::minimum:
      return "converged";
    case DescentEnd::valley:
      return "converged, along a line of equal values";
    case DescentEnd::flat:
      return "a parameter has no effect there";
    case DescentEnd::limit:
      return "its iterations ran out";
    case DescentEnd::no_answer:
      break;
  }
  return "failed: " + start.message;
}

constexpr double least_correlation = 0.1;
constexpr std::size_t most_residuals = 1000;  // in the table, so that the page stays about 1 MB

bool rests_on_bound(const FitResult& fitted, std::size_t s) {
  return s < fitted.at_bound.size() && fitted.at_bound[s];
}

Cell number_at(const std::vector<double>& values, std::size_t i, const Notation& notation) {
  return i < values.size() ? Cell(Number{values[i], notation}) : Cell();
}

Cell optional_cell(const std::optional<double>& value, const Notation& notation = {}) {
  return cell_if(number_if(value, notation));
}

Cell count_cell(std::size_t count) { return Number{static_cast<double>(count), fixed(0)}; }

std::string level_of(const Analysis& a) { return percent(a.uncertainty.options.level); }

std::size_t free_parameters(const FitResult& fitted) {
  const auto& slots = fitted.model.slots;
  return static_cast<std::size_t>(std::count_if(
      slots.begin(), slots.end(), [](const ParameterSlot& slot) { return slot.free; }));
}

Sentence solver_words(const FitResult& f) {
  if (f.model.solver.kind == Solver::reference) return "reference (CVODES)";
  return say("fast; {} impacts of the fit were handed over to the reference solver", f.handovers);
}

Cell p_value_cell(const Analysis& a) {
  if (!a.fitted.data.sd_stated) {
    return Sentence("not defined (no standard deviations are stated)");
  }
  if (a.fitted.dof <= 0) return Sentence("not defined (no degrees of freedom left)");
  return Number{a.fitted.p_value, probability()};
}

/// f0 of eq. 12 at the reference diameter [N/m]: two values where the K that is used is not that of
/// the elastic constants.
Sentence eq_12_words(const ContactProperties& contact) {
  if (!contradicts(contact.stiffness, contact.stiffness_derived)) {
    return number(contact.adhesion_force_derived);
  }
  return say("{} with this {K}, {} with that of eq. 6", number(contact.adhesion_force_derived),
             number(contact.adhesion_force_materials));
}

/// The row of a parameter that is not fitted; an adhesion that follows the materials moves with
/// their constants.
std::vector<Cell> fixed_row(const Analysis& a, std::size_t s) {
  const FitResult& f = a.fitted;
  const ParameterSlot& slot = f.model.slots[s];
  const Sentence name = symbol(slot.label());
  if (followed_in(f.model, s)) {
    const double error = s < a.uncertainty.budgets.size() ? a.uncertainty.budgets[s].sd : 0.0;
    return {name,
            Number{acting_value(f.model, f.theta, s), significant(4), error},
            {},
            unit(slot.parameter->unit),
            {},
            "follows the materials",
            Number{f.theta[s]}};
  }
  return {name, Number{f.theta[s]}, {}, unit(slot.parameter->unit), {}, "fixed"};
}

}  // namespace

Sentence labelled(const ParameterSlot& slot) {
  return symbol(slot.label()) + " [" + unit(slot.parameter->unit) + "]";
}

/// Points less variables, and why it may be fewer.
Cell degrees_of_freedom_cell(const FitResult& f) {
  const int silent =
      static_cast<int>(f.data.points.size()) - static_cast<int>(free_parameters(f)) - f.dof;
  if (!f.data.sd_stated || f.data.spec.student || silent <= 0) {
    return Number{static_cast<double>(std::max(0, f.dof)), fixed(0)};
  }
  return say("{}; captured points that the model captures too, {}, cannot scatter and do not count",
             std::max(0, f.dof), silent);
}

std::string_view strategy_words(Strategy strategy) {
  switch (strategy) {
    case Strategy::trust_region:
      return "trust region within bounds (Ceres)";
    case Strategy::box_descent:
      return "Levenberg-Marquardt within bounds";
    case Strategy::gauss_newton:
      return "Gauss-Newton";
  }
  return "";
}

Table statistics_table(const Analysis& a) {
  const FitResult& f = a.fitted;
  return items(
      {{"method", say("{} in {e}^2, {}",
                      f.data.spec.student ? "Student's t likelihood" : "weighted least squares",
                      strategy_words(f.strategy))},
       {"solver", solver_words(f)},
       {"data points", count_cell(f.data.points.size())},
       {"variables", count_cell(free_parameters(f))},
       {"chi-square", Number{f.chi2, significant(6)}},
       {"degrees of freedom", degrees_of_freedom_cell(f)},
       {"reduced chi-square", f.dof > 0 ? Cell(Number{f.chi2 / f.dof, significant(5)})
                                        : Cell("not defined (no degrees of freedom left)")},
       {"p-value", p_value_cell(a)},
       {say("rms of {e}"), Number{f.rmse}},
       {"noise", Sentence(noise_words(f))}});
}

Table parameters_table(const Analysis& a) {
  const FitResult& f = a.fitted;
  Table table;
  table.columns = {{"parameter"},
                   {say("estimate {+/-} standard error")},
                   {"error", "%"},
                   {"unit", "", true},
                   {level_of(a) + " interval"},
                   {"kind", "", true},
                   {"start"}};
  for (std::size_t s = 0; s < f.model.slots.size(); ++s) {
    const ParameterSlot& slot = f.model.slots[s];
    if (slot.is_constant()) continue;
    if (!slot.free) {
      table.rows.push_back(fixed_row(a, s));
      continue;
    }
    const double error =
        s < f.std_error.size() && std::isfinite(f.std_error[s]) ? f.std_error[s] : 0.0;
    const bool relative = error > 0.0 && f.theta[s] != 0.0;
    const IntervalSet set = intervals_of(a, s);
    const Interval interval = recommended_interval(set);
    table.rows.push_back(
        {symbol(slot.label()), Number{f.theta[s], significant(4), error},
         relative ? Cell(Number{100.0 * error / std::abs(f.theta[s]), significant(3)}) : Cell(),
         unit(slot.parameter->unit), interval_cell(interval),
         interval.available() ? Cell(Sentence(words_of(set.recommended))) : Cell(),
         Number{slot.initial}});
  }
  return table;
}

List parameter_remarks(const Analysis& a) {
  const FitResult& f = a.fitted;
  List remarks;
  for (std::size_t s = 0; s < f.model.slots.size(); ++s) {
    const ParameterSlot& slot = f.model.slots[s];
    if (!slot.free) continue;
    const Sentence name = symbol(slot.label());
    const IntervalSet set = intervals_of(a, s);
    const Interval interval = recommended_interval(set);
    if (rests_on_bound(f, s)) {
      remarks.entries.push_back(
          say("{} rests on a bound of [{}, {}].", name, number(slot.lower), number(slot.upper)));
    } else if (s >= f.std_error.size() || !(f.std_error[s] > 0.0)) {
      remarks.entries.push_back(say("{} has no standard error.", name));
    }
    if (!interval.available()) {
      remarks.entries.push_back(
          as_sentence(say("{} has no interval: {}", name, missing_words(interval))));
    }
    if (interval.note) {
      remarks.entries.push_back(as_sentence(say("{}: {}", name, note_words(interval, name))));
    }
  }
  return remarks;
}

Table intervals_table(const Analysis& a) {
  Table table;
  table.caption = say("Every {} interval; a dash where there is none", level_of(a));
  table.columns = {{"parameter"}};
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    table.columns.push_back({words_of(kind)});
  }
  for (std::size_t s = 0; s < a.fitted.model.slots.size(); ++s) {
    const ParameterSlot& slot = a.fitted.model.slots[s];
    if (!slot.free) continue;
    std::vector<Cell> row = {labelled(slot)};
    const IntervalSet set = intervals_of(a, s);
    for (const IntervalKind kind : values_of<IntervalKind>()) {
      row.push_back(interval_cell(set[kind]));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

List missing_intervals(const Analysis& a) {
  List reasons;
  for (std::size_t s = 0; s < a.fitted.model.slots.size(); ++s) {
    const ParameterSlot& slot = a.fitted.model.slots[s];
    if (!slot.free) continue;
    const IntervalSet set = intervals_of(a, s);
    for (const IntervalKind kind : values_of<IntervalKind>()) {
      if (set[kind].available()) continue;
      reasons.entries.push_back(
          say("{}, {}: {}", symbol(slot.label()), words_of(kind), missing_words(set[kind])));
    }
  }
  return reasons;
}

Table correlations_table(const Analysis& a) {
  struct Pair {
    std::size_t one, other;
    double value;
  };
  const auto& slots = a.fitted.model.slots;
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = i + 1; j < slots.size(); ++j) {
      const double value = correlation(a, i, j);
      if (std::abs(value) >= least_correlation) pairs.push_back({i, j, value});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    return std::abs(x.value) > std::abs(y.value);
  });
  Table table;
  table.caption = say("Correlations above {:g} in magnitude", least_correlation);
  table.columns = {{"of"}, {"and", "", true}, {"correlation"}};
  for (const Pair& pair : pairs) {
    table.rows.push_back({symbol(slots[pair.one].label()), symbol(slots[pair.other].label()),
                          Number{pair.value, signed_fixed(4)}});
  }
  return table;
}

Table capture_table(const Analysis& a) {
  const SizeUnit unit = size_unit(a.datasets);
  Table table;
  table.columns = {{"dataset"},
                   {say("{d}"), unit.name},
                   {say("{V*}"), "m/s"},
                   {level_of(a) + " interval"},
                   {"remark", "", true}};
  for (const CaptureEstimate& capture : a.uncertainty.capture) {
    const Cell id = Sentence(a.datasets[capture.dataset].id);
    const Cell diameter = Sentence(size_text(capture.diameter, unit));
    if (without_adhesion(a, capture.dataset)) {
      table.rows.push_back({id, diameter, no_capture_words});
      continue;
    }
    table.rows.push_back(
        {id, diameter, capture.found ? Cell(Number{capture.value, padded(4)}) : Cell("none found"),
         interval_cell(capture.interval),
         capture.interval.available() ? Cell()
                                      : Cell("no interval: " + missing_words(capture.interval))});
  }
  return table;
}

Table two_point_table(const Analysis& a, const TwoPointComparison& comparison) {
  const FitResult& f = a.fitted;
  const TwoPointResult& two = comparison.result;
  const bool answered = two.status != TwoPointStatus::too_few_points;
  const auto point = [&](std::size_t i) -> Sentence {
    if (!answered || i >= f.data.points.size()) return "none";
    const auto& at = f.data.points[i];
    return say("{e} = {} at {} m/s", number(at.restitution), number(at.velocity));
  };
  Table table;
  table.caption = say(
      "{}, two points calibrated at {d} = {} {um}: {} and {}", a.datasets[comparison.dataset].id,
      size_text(two.diameter, size_unit(a.datasets)), point(two.high_point), point(two.low_point));
  table.columns = {{}, {"two points"}, {"all points"}};
  for (const std::size_t s :
       {f.model.slot_C_H[comparison.dataset], f.model.slot_C_A[comparison.dataset]}) {
    const ParameterSlot& slot = f.model.slots[s];
    table.rows.push_back({labelled(slot), number_at(two.theta, s, significant(4)),
                          number_at(f.theta, s, significant(4))});
    table.rows.push_back({symbol(slot.parameter->name) + ", spread under resampling",
                          number_at(comparison.spread, s, significant(2)),
                          number_at(comparison.full_spread, s, significant(2))});
  }
  table.rows.push_back({say("rms of {e}, all points"),
                        answered ? Cell(Number{comparison.rmse}) : Cell("none"),
                        Number{comparison.full_rmse}});
  table.rows.push_back({say("rms of {e}, held-out diameters"),
                        optional_cell(comparison.held_out_rmse),
                        optional_cell(comparison.full_held_out_rmse)});
  table.rows.push_back(
      {"replicates without an answer",
       say("{} of {}", comparison.failed, a.uncertainty.bootstrap.two_point_replicates)});
  return table;
}

Table bootstrap_table(const Analysis& a) {
  const BootstrapResult& bootstrap = a.uncertainty.bootstrap;
  if (bootstrap.replicates == 0) return {};
  return items({{"scheme", Sentence(to_string(bootstrap.scheme))},
                {"replicates", say("{}", bootstrap.replicates)},
                {"failed refits", say("{}", bootstrap.failed)},
                {"seed", Sentence(fmt::format("{}", bootstrap.seed))}});
}

Table materials_table(const Analysis& a, std::size_t k) {
  const Dataset& dataset = a.datasets[k];
  const ContactProperties& contact = a.fitted.model.contacts[k];
  const Material& p = dataset.system.particle;
  const Material& s = dataset.system.surface;
  const auto energy = [](double value, bool stated) {
    return say("{} ({})", number(value), stated ? "stated" : "Gilman");
  };
  Table table;
  table.caption = say("{}: the two bodies", dataset.id);
  table.columns = {{}, {"particle"}, {"surface"}};
  table.rows = {
      {"material", Sentence(p.name), Sentence(s.name)},
      {say("density [{kg/m3}]"), Number{p.density, significant(5)},
       s.density > 0.0 ? Cell(Number{s.density, significant(5)}) : Cell()},
      {"Young's modulus [GPa]", Number{p.youngs_modulus / units::GPa},
       Number{s.youngs_modulus / units::GPa}},
      {"Poisson ratio", Number{p.poisson_ratio}, Number{s.poisson_ratio}},
      {say("surface energy [{J/m2}]"), energy(contact.gamma_particle, p.surface_energy.has_value()),
       energy(contact.gamma_surface, s.surface_energy.has_value())}};
  return table;
}

Table contact_table(const Analysis& a, std::size_t k) {
  const ImpactSystem& system = a.datasets[k].system;
  const ContactProperties& contact = a.fitted.model.contacts[k];
  const bool by_force = traits(a.fitted.model.adhesion).by_force;
  const bool adhesion_free = a.fitted.model.slots[a.fitted.model.slot_adhesion[k]].free;
  const auto origin = [](bool stated) { return stated ? "stated" : "derived"; };
  Table table;
  table.caption = say("{}: the contact", a.datasets[k].id);
  table.columns = {{}, {"used"}, {"from", "", true}};
  table.rows = {
      {say("{K} [GPa]"), Number{contact.stiffness / units::GPa},
       say("{}; eq. 6 gives {}", origin(system.stiffness_K.has_value()),
           number(contact.stiffness_derived / units::GPa))},
      {say("{W_A} [{J/m2}]"), Number{contact.adhesion_energy},
       system.adhesion_energy ? "stated" : "twice the geometric mean of the surface energies"}};
  const bool has_theta = a.fitted.theta.size() == a.fitted.model.slots.size();
  if (!has_theta) return table;
  const ImpactConditions conditions = reference_conditions(a, k, 1.0);
  table.rows.push_back({say("{f0} [N/m]"), Number{conditions.adhesion_force},
                        say("{}; eq. 12 gives {}",
                            !by_force       ? "the W below"
                            : adhesion_free ? "fitted"
                                            : origin(system.adhesion_force_f0.has_value()),
                            eq_12_words(contact))});
  table.rows.push_back({say("{W} [{J/m2}]"),
                        Number{adhesion_energy_for(conditions.adhesion_force,
                                                   conditions.diameter / 2.0, contact.stiffness)},
                        by_force        ? "this f0, by eqs 9 and 10"
                        : adhesion_free ? "fitted"
                                        : "the materials"});
  table.rows.push_back({say("reference diameter [{um}]"),
                        Sentence(diameter_text(contact.reference_diameter)),
                        say("{f0} grows with the cube root of the radius from here")});
  table.rows.push_back(
      {say("{a_eq} [nm]"), Number{contact.equilibrium_radius / units::nm}, "eq. 10"});
  table.rows.push_back({say("{V_a} [m/s]"), Number{adhesion_velocity(conditions)},
                        "the velocity at which adhesion and inertia balance"});
  return table;
}

Table options_table(const Analysis& a) {
  return items({{"adhesion", Sentence(to_string(a.fitted.model.adhesion))},
                {"fit", Sentence(a.spec.file.empty() ? a.spec.id : a.spec.file.generic_string())},
                {"adhesion damping acts", a.fitted.model.phase == AdhesionDampingPhase::rebound
                                              ? "during rebound"
                                              : "during approach and rebound"},
                {"mechanisms", Sentence(fmt::format("{}", fmt::join(a.spec.mechanisms, ", ")))},
                {"replicates", say("{}", a.uncertainty.options.replicates)},
                {"level of every interval", Sentence(level_of(a))},
                {"seed", Sentence(fmt::format("{}", a.uncertainty.options.seed))},
                {"SHA-256 of the fit file", code(a.spec.sha256)},
                {"recoil", Sentence(version())}});
}

Table starts_table(const Analysis& a) {
  Table table;
  if (a.fitted.starts.empty()) return table;
  table.caption = "Where the minimisation began and ended";
  if (a.fitted.searched_points < a.fitted.data.points.size()) {
    table.caption = say("Where the minimisation began and ended, on {} of the {} points",
                        a.fitted.searched_points, a.fitted.data.points.size());
  }
  table.columns = {{"start"}};
  std::vector<std::size_t> free;
  for (std::size_t s = 0; s < a.fitted.model.slots.size(); ++s) {
    if (!a.fitted.model.slots[s].free) continue;
    free.push_back(s);
    table.columns.push_back({symbol(a.fitted.model.slots[s].label()) + ", start"});
    table.columns.push_back({"end"});
  }
  table.columns.push_back({"chi-square"});
  table.columns.push_back({"outcome", "", true});
  for (std::size_t i = 0; i < a.fitted.starts.size(); ++i) {
    const StartSummary& start = a.fitted.starts[i];
    std::vector<Cell> row = {say("{}", i + 1)};
    for (const std::size_t s : free) {
      row.push_back(number_at(start.start, s, significant(3)));
      row.push_back(number_at(start.end, s, significant(6)));
    }
    row.emplace_back(Number{start.chi2, significant(7)});
    row.emplace_back(ending_words(start));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table points_table(const Analysis& a) {
  const FitResult& f = a.fitted;
  const bool joint = a.datasets.size() > 1;
  const double scale = residual_unit(a);
  const SizeUnit unit = size_unit(a.datasets);
  Table table;
  table.compact = true;
  if (joint) table.columns = {{"dataset"}};
  for (const TableColumn& column : std::vector<TableColumn>{{"series"},
                                                            {say("{d}"), unit.name},
                                                            {say("{V}"), "m/s"},
                                                            {say("{e}")},
                                                            {"sd"},
                                                            {"fit"},
                                                            {"residual", "sd"},
                                                            {"leverage"}}) {
    table.columns.push_back(column);
  }
  const std::size_t count = std::min(f.data.points.size(), most_residuals);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& point = f.data.points[i];
    const Dataset& dataset = a.datasets[point.dataset];
    std::vector<Cell> row;
    if (joint) row.emplace_back(Sentence(dataset.id));
    row.emplace_back(
        Sentence(point.series < dataset.series.size() ? dataset.series[point.series] : ""));
    row.emplace_back(Sentence(size_text(point.diameter, unit)));
    row.emplace_back(Number{point.velocity});
    row.push_back(point.censored ? Cell("captured") : Cell(Number{point.restitution, fixed(4)}));
    row.push_back(f.data.sd_stated ? Cell(Number{point.weights.sd, significant(2)}) : Cell());
    row.push_back(number_at(f.prediction, i, fixed(4)));
    row.push_back(i < f.residuals.size() ? Cell(Number{f.residuals[i] / scale, signed_fixed(2)})
                                         : Cell());
    row.push_back(number_at(f.leverage, i, fixed(3)));
    table.rows.push_back(std::move(row));
  }
  if (count < f.data.points.size()) {
    table.caption =
        say("The first {} of {} points; fit.json has them all.", count, f.data.points.size());
  }
  return table;
}

}  // namespace recoil
