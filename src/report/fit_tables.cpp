#include "report/fit_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/program.hpp"
#include "core/units.hpp"
#include "report/format.hpp"
#include "report/words_fit.hpp"
#include "report/words_uncertainty.hpp"

namespace recoil {
namespace {

constexpr double least_correlation = 0.1;
constexpr double least_share = 5e-4;  // of a variance, in the table of sources
constexpr std::size_t most_sizes = 10;
constexpr std::size_t most_correlations = 6;

Cell number_at(const std::vector<double>& values, std::size_t i, const Notation& notation) {
  return i < values.size() ? Cell(Number{values[i], notation}) : Cell();
}

Cell count_cell(std::size_t count) { return Number{static_cast<double>(count), fixed(0)}; }

std::string level_of(const Analysis& a) { return percent(a.uncertainty.options.level); }

Sentence labelled(const ParameterSlot& slot) {
  const std::string_view name = slot.parameter->unit;
  return name == "1" ? symbol(slot.label()) : symbol(slot.label()) + " [" + unit(name) + "]";
}

std::size_t free_parameters(const FitResult& fitted) {
  const auto& slots = fitted.model.slots;
  return static_cast<std::size_t>(std::count_if(
      slots.begin(), slots.end(), [](const ParameterSlot& slot) { return slot.free; }));
}

Cell capture_cell(const Analysis& a, const CaptureEstimate& capture) {
  if (without_adhesion(a, capture.dataset)) return no_capture_words;
  if (capture.above && capture.below && *capture.above < *capture.below) {
    return say("{:.3g} to {:.3g}", *capture.above, *capture.below);
  }
  if (capture.above) return say("above {:.3g}", *capture.above);
  if (capture.below) return say("below {:.3g}", *capture.below);
  if (!capture.found) return "none found";
  Number value{capture.value, padded(3)};
  if (capture.interval.available()) {
    value.band = {*capture.interval.lower, *capture.interval.upper};
  }
  return value;
}

/// What is special about a parameter, in a word or two.
std::string remark_of(const FitResult& f, std::size_t s, const Interval& interval) {
  if (!f.model.slots[s].free) return followed_in(f.model, s) ? "follows the materials" : "fixed";
  if (interval.note) {
    if (const std::string words = short_note(interval.note->caution); !words.empty()) return words;
  }
  if (s < f.at_bound.size() && f.at_bound[s]) return "at its bound";
  return interval.available() ? "" : missing_words(interval);
}

Cell p_value_cell(const FitResult& f) {
  if (!f.data.sd_stated) return "not defined (no standard deviations are stated)";
  if (f.dof <= 0) return "not defined (no degrees of freedom left)";
  return Number{f.p_value, probability()};
}

/// Points less free parameters, and why there may be fewer.
Cell degrees_of_freedom_cell(const FitResult& f) {
  const int silent =
      static_cast<int>(f.data.points.size()) - static_cast<int>(free_parameters(f)) - f.dof;
  if (!f.data.sd_stated || f.data.spec.student || silent <= 0) {
    return Number{static_cast<double>(std::max(0, f.dof)), fixed(0)};
  }
  return say("{} ({} captured point{} excluded)", std::max(0, f.dof), silent,
             silent == 1 ? " is" : "s are");
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

std::string starts_words(const FitResult& f) {
  const auto agreeing = std::count_if(f.starts.begin(), f.starts.end(), [](const auto& start) {
    return start.outcome == StartOutcome::best || start.outcome == StartOutcome::same;
  });
  return fmt::format("{} of {} reach the same minimum", agreeing, f.starts.size());
}

}  // namespace

std::string short_name(const std::vector<Dataset>& datasets, std::size_t dataset) {
  std::set<std::string> surfaces;
  for (const Dataset& one : datasets) surfaces.insert(one.system.surface.name);
  const bool tell = surfaces.size() == datasets.size() && !surfaces.contains("");
  return tell ? datasets[dataset].system.surface.name : datasets[dataset].id;
}

Table capture_table(const Analysis& a) {
  const SizeUnit size = size_unit(a.datasets);
  std::map<double, std::vector<Cell>> by_diameter;
  for (const CaptureEstimate& capture : a.uncertainty.capture) {
    std::vector<Cell>& cells = by_diameter[capture.diameter];
    cells.resize(a.datasets.size());
    cells[capture.dataset] = capture_cell(a, capture);
  }
  Table table;
  table.columns = {{say("{d}"), size.name}};
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    const Sentence where =
        a.datasets.size() > 1 ? Sentence(" on " + short_name(a.datasets, k)) : Sentence();
    table.columns.push_back({say("{V*} [{} interval]", level_of(a)) + where, "m/s"});
  }
  for (auto& [diameter, cells] : by_diameter) {
    if (table.rows.size() == most_sizes) {
      table.rows.push_back({say("{} more in fit.json", by_diameter.size() - most_sizes)});
      break;
    }
    cells.insert(cells.begin(), Sentence(size_text(diameter, size)));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

Table parameters_table(const Analysis& a) {
  const FitResult& f = a.fitted;
  Table table;
  table.compact = true;
  table.columns = {{"parameter"},
                   {say("estimate {+/-} standard error")},
                   {level_of(a) + " interval"},
                   {"", "", true}};
  bool adheres = false;
  for (std::size_t d = 0; d < f.model.contacts.size(); ++d) {
    adheres = adheres || !without_adhesion(f.model, d);
  }
  for (std::size_t s = 0; s < f.model.slots.size(); ++s) {
    const ParameterSlot& slot = f.model.slots[s];
    if (slot.is_constant()) continue;
    if (!adheres && (slot.parameter->is_adhesion() ||
                     slot.parameter->role == ParameterRole::adhesion_damping)) {
      continue;
    }
    if (dry_loss_mechanism(a.spec.loss) != nullptr &&
        slot.parameter->role == ParameterRole::hertz_damping) {
      continue;  // that law takes its place
    }
    const Interval interval = recommended_interval(intervals_of(a, s));
    const bool follows = followed_in(f.model, s).has_value();
    double error = s < f.std_error.size() ? f.std_error[s] : 0.0;
    if (follows) error = s < a.uncertainty.budgets.size() ? a.uncertainty.budgets[s].sd : 0.0;
    if (!std::isfinite(error)) error = 0.0;
    const bool flat = std::find(f.flat.begin(), f.flat.end(), s) != f.flat.end();
    table.rows.push_back(
        {labelled(slot),
         flat ? Cell() : Cell(Number{acting_value(f.model, f.theta, s), significant(4), error}),
         interval_cell(interval, significant(3)),
         Sentence(flat ? "no point depends on it" : remark_of(f, s, interval))});
  }
  return table;
}

Table intervals_table(const Analysis& a) {
  Table table;
  table.caption = say("Every kind of {} interval", level_of(a));
  table.columns = {{"parameter"}};
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    table.columns.push_back({words_of(kind)});
  }
  table.columns.push_back({"recommended", "", true});
  for (std::size_t s = 0; s < a.fitted.model.slots.size(); ++s) {
    const ParameterSlot& slot = a.fitted.model.slots[s];
    if (!slot.free || s >= a.uncertainty.intervals.size()) continue;
    const IntervalSet& set = a.uncertainty.intervals[s];
    std::vector<Cell> row = {labelled(slot)};
    for (const IntervalKind kind : values_of<IntervalKind>()) {
      row.push_back(interval_cell(set[kind]));
    }
    row.emplace_back(Sentence(recommended_interval(set).available() ? words_of(set.recommended)
                                                                    : std::string("none")));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table correlations_table(const Analysis& a) {
  const auto& slots = a.fitted.model.slots;
  struct Pair {
    std::size_t one, other;
    double value;
  };
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
  if (pairs.size() > most_correlations) pairs.resize(most_correlations);
  Table table;
  table.caption = say("The largest correlations above {:g}", least_correlation);
  table.columns = {{"parameter"}, {"with", "", true}, {"correlation"}};
  for (const Pair& pair : pairs) {
    table.rows.push_back({symbol(slots[pair.one].label()), symbol(slots[pair.other].label()),
                          Number{pair.value, signed_fixed(3)}});
  }
  return table;
}

Table constants_table(const Analysis& a) {
  const ImpactModel& model = a.fitted.model;
  Table table;
  if (a.fitted.std_error.empty()) return table;
  const bool adjusted = model.adjusts_constants();
  table.caption = adjusted
                      ? "Material constants with uncertainty, fitted with their stated values as "
                        "priors"
                      : "Material constants with uncertainty: their errors widen the intervals";
  table.columns = {{"constant", "", true}, {"unit", "", true}, {"stated"}};
  if (adjusted) table.columns.insert(table.columns.end(), {{"fitted"}, {"moved", "sd"}});
  for (std::size_t k = 0; k < model.constants.size(); ++k) {
    const std::size_t j = model.first_constant() + k;
    const UncertainConstant& constant = model.constants[k];
    const double sd = constant.sd * (is_positive(constant.constant) ? constant.stated : 1.0);
    table.rows.push_back({Sentence(model.slots[j].label()), unit(model.slots[j].parameter->unit),
                          Number{constant.stated, significant(4), sd}});
    if (!adjusted) continue;
    table.rows.back().insert(table.rows.back().end(),
                             {Number{a.fitted.theta[j], significant(4), a.fitted.std_error[j]},
                              Number{a.fitted.constants_moved[k], signed_fixed(2)}});
  }
  return table;
}

Table conditional_table(const Analysis& a) {
  Table table;
  if (!a.uncertainty.conditional) return table;
  const ConditionalFit& exact = *a.uncertainty.conditional;
  table.caption = "Profile intervals with the errors of the materials, and with exact materials";
  table.columns = {{"parameter"},
                   {"estimate"},
                   {"interval"},
                   {"estimate, exact materials"},
                   {"interval, exact materials"}};
  for (std::size_t j = 0; j < exact.fitted.model.slots.size(); ++j) {
    const ParameterSlot& slot = exact.fitted.model.slots[j];
    if (!slot.free) continue;
    table.rows.push_back({labelled(slot), Number{a.fitted.theta[j]},
                          interval_cell(intervals_of(a, j)[IntervalKind::profile]),
                          Number{exact.fitted.theta[j]},
                          interval_cell(exact.intervals[j][IntervalKind::profile])});
  }
  return table;
}

Table budget_table(const Analysis& a) {
  Table table;
  const std::vector<BudgetOf> budgets = reference_budgets(a);
  if (a.fitted.model.constants.empty() || budgets.empty()) return table;
  table.caption = "Share of each source of error in the variance [%]";
  table.columns = {{"source", "", true}};
  std::map<std::string, std::vector<Cell>> rows;
  std::vector<std::pair<double, std::string>> largest;  // share of each source, and its name
  for (std::size_t k = 0; k < budgets.size(); ++k) {
    table.columns.push_back({budgets[k].quantity});
    for (const BudgetEntry& entry : budgets[k].budget->entries) {
      const std::string name = source_words(entry, a.fitted.model);
      std::vector<Cell>& row = rows[name];
      row.resize(budgets.size());
      row[k] = Number{100.0 * entry.share, fixed(1)};
      largest.emplace_back(entry.share, name);
    }
  }
  std::stable_sort(largest.begin(), largest.end(),
                   [](const auto& one, const auto& other) { return one.first > other.first; });
  for (const auto& [share, name] : largest) {
    if (share < least_share || rows[name].empty()) continue;
    std::vector<Cell> row = std::move(rows[name]);
    rows[name].clear();
    row.insert(row.begin(), Sentence(name));
    table.rows.push_back(std::move(row));
  }
  std::vector<Cell> total = {"standard error"};
  for (const BudgetOf& of : budgets) {
    total.push_back(Number{of.budget->sd, significant(2), 0.0, of.unit == "1" ? "" : of.unit});
  }
  table.rows.push_back(std::move(total));
  return table;
}

Table posterior_table(const Analysis& a) {
  Table table;
  if (!a.uncertainty.posterior || !a.uncertainty.posterior->available()) return table;
  const PosteriorResult& found = *a.uncertainty.posterior;
  table.caption = say("Posterior with flat priors between the bounds; {} intervals of equal tails",
                      level_of(a));
  table.columns = {{"quantity"}, {"mean"}, {"sd"}, {"interval"}, {"R-hat"}, {"effective draws"}};
  for (std::size_t j = 0; j < found.parameters.size(); ++j) {
    const PosteriorMarginal& m = found.parameters[j];
    if (!a.fitted.model.slots[j].moves()) continue;
    table.rows.push_back({labelled(a.fitted.model.slots[j]), Number{m.mean},
                          Number{m.sd, significant(2)}, interval_cell(m.interval),
                          Number{m.r_hat, fixed(4)}, Number{m.effective, fixed(0)}});
  }
  for (std::size_t k = 0; k < found.capture.size(); ++k) {
    const PosteriorMarginal& m = found.capture[k];
    table.rows.push_back({capture_name(a, a.uncertainty.capture[k]) + " [m/s]", Number{m.mean},
                          Number{m.sd, significant(2)}, interval_cell(m.interval)});
  }
  return table;
}

Sentence compared_words(ComparisonWay row) {
  switch (row) {
    case ComparisonWay::two_point:
      return "two points";
    case ComparisonWay::full:
      return "all points, same f0";
    case ComparisonWay::full_f0_free:
      return "all points, f0 fitted";
  }
  return {};
}

Table two_point_table(const Analysis& a, const TwoPointComparison& comparison) {
  const FitResult& f = a.fitted;
  Table table;
  table.columns = {{"with exact materials"}, {symbol("C_H"), "s/m"}, {symbol("C_A"), "s/m"},
                   {say("{f0}"), "N/m"},     {say("rms of {e}")},    {"held out"}};
  const std::size_t d = comparison.dataset;
  for (const ComparisonRow& row : comparison.rows) {
    const auto f0 = row.theta.empty() ? std::nullopt
                                      : std::optional(adhesion_force_under(f.model, row.theta, d));
    const auto damping = [&](std::size_t slot) -> Cell {
      if (row.standard_errors.empty()) return number_at(row.theta, slot, significant(3));
      return Number{row.theta[slot], significant(3), row.standard_errors[slot]};
    };
    table.rows.push_back(
        {row.row == ComparisonWay::two_point
             ? say("two points of {}", diameter_sentence(comparison.result.diameter))
             : Sentence(compared_words(row.row)),
         damping(f.model.slot_C_H[d]), damping(f.model.slot_C_A[d]),
         cell_if(number_if(f0, significant(3))), cell_if(number_if(row.rmse, {})),
         cell_if(number_if(row.held_out_rmse, {}))});
  }
  return table;
}

Table two_point_spread_table(const Analysis& a, const TwoPointComparison& comparison) {
  const FitResult& f = a.fitted;
  Table table;
  table.caption =
      say("{}: standard deviations under resampling", short_name(a.datasets, comparison.dataset));
  table.columns = {{}, {"two points"}, {"this fit"}};
  for (const std::size_t s :
       {f.model.slot_C_H[comparison.dataset], f.model.slot_C_A[comparison.dataset]}) {
    table.rows.push_back({labelled(f.model.slots[s]),
                          number_at(comparison.spread, s, significant(2)),
                          number_at(comparison.full_spread, s, significant(2))});
  }
  table.rows.push_back(
      {"replicates without an answer",
       say("{} of {}", comparison.failed, a.uncertainty.bootstrap.two_point_replicates)});
  return table;
}

Table statistics_table(const Analysis& a) {
  const FitResult& f = a.fitted;
  std::vector<std::pair<Sentence, Cell>> entries = {
      {"fit file", Sentence(a.spec.file.empty() ? a.spec.id : a.spec.file.generic_string())},
      {"equation of motion", equation_words(f.model.adhesion)},
      {"adhesion damping", f.model.phase == AdhesionDampingPhase::rebound
                               ? "during rebound"
                               : "during approach and rebound"},
      {"mechanisms", Sentence(fmt::format("{}", fmt::join(a.spec.mechanisms, ", ")))},
      {"method", say("{} in {e}^2, {}",
                     f.data.spec.student ? "Student's t likelihood" : "weighted least squares",
                     strategy_words(f.strategy))},
      {"starts", Sentence(starts_words(f))},
      {"solver", f.model.solver.kind == Solver::reference
                     ? Sentence("reference (CVODES)")
                     : say("fast ({} impacts by the reference solver)", f.handovers)},
      {"data points", count_cell(f.data.points.size())},
      {"free parameters", count_cell(free_parameters(f))},
      {"chi-square", Number{f.chi2, significant(6)}},
      {"degrees of freedom", degrees_of_freedom_cell(f)},
      {"p-value", p_value_cell(f)},
      {say("rms of {e}"), Number{f.rmse}},
      {"noise", Sentence(noise_words(f))}};
  const BootstrapResult& bootstrap = a.uncertainty.bootstrap;
  if (bootstrap.replicates > 0) {
    entries.emplace_back("bootstrap", say("{} {} replicates, {} failed, seed {}",
                                          bootstrap.replicates, to_string(bootstrap.scheme),
                                          bootstrap.failed, fmt::format("{}", bootstrap.seed)));
  }
  for (const Dataset& dataset : a.datasets) {
    if (!dataset.sha256.empty()) {
      entries.emplace_back("SHA-256 of " + dataset.id, code(dataset.sha256));
    }
  }
  entries.emplace_back("recoil", Sentence(version()));
  return items(entries);
}

Table materials_table(const Analysis& a, std::size_t k) {
  const ContactProperties& contact = a.fitted.model.contacts[k];
  const Material& p = a.datasets[k].system.particle;
  const Material& s = a.datasets[k].system.surface;
  const auto energy = [](double value, bool stated) {
    return say("{}{}", number(value), stated ? "" : " (Gilman)");
  };
  Table table;
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
  table.columns = {{"contact"}, {"used"}, {"from", "", true}};
  table.rows = {
      {say("{K} [GPa]"), Number{contact.stiffness / units::GPa},
       say("{}; eq. 6 gives {}", origin(system.stiffness_K.has_value()),
           number(contact.stiffness_derived / units::GPa))},
      {say("{W_A} [{J/m2}]"), Number{contact.adhesion_energy},
       system.adhesion_energy ? "stated" : "twice the geometric mean of the surface energies"}};
  if (a.fitted.theta.size() != a.fitted.model.slots.size()) return table;
  const ImpactConditions conditions = reference_conditions(a, k, 1.0);
  const double radius = conditions.diameter / 2.0;
  table.rows.push_back({say("{f0} [N/m] at {}", diameter_sentence(contact.reference_diameter)),
                        Number{conditions.adhesion_force},
                        say("{}; eq. 12 gives {}",
                            !by_force       ? "the W below"
                            : adhesion_free ? "fitted"
                                            : origin(system.adhesion_force_f0.has_value()),
                            eq_12_words(contact))});
  table.rows.push_back(
      {say("{W} [{J/m2}]"),
       Number{adhesion_energy_for(conditions.adhesion_force, radius, contact.stiffness)},
       by_force        ? "this f0, by eqs 9 and 10"
       : adhesion_free ? "fitted"
                       : "the materials"});
  table.rows.push_back({say("{V_a} [m/s]"), Number{adhesion_velocity(conditions)},
                        "adhesion and inertia balance at this velocity"});
  return table;
}

}  // namespace recoil
