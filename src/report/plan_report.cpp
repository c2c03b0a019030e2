#include "report/plan_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/program.hpp"
#include "core/units.hpp"
#include "data/datapackage.hpp"
#include "document/html.hpp"
#include "document/terminal.hpp"
#include "json/printed_results.hpp"
#include "predict/validity.hpp"
#include "report/format.hpp"
#include "report/result_json.hpp"
#include "report/words_validity.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_places = 3;

Cell impacts_cell(const std::optional<double>& impacts) {
  return impacts ? Cell(whole(std::ceil(*impacts))) : Cell("no number");
}

Sentence name_of_quantity(const ExperimentPlan& plan, const PlannedQuantity& quantity) {
  if (quantity.is_parameter()) return symbol(quantity.label);
  Sentence name = say("{V*} of {}", diameter_words(quantity.diameter));
  if (plan.datasets.size() > 1) name += Sentence(", " + plan.datasets[quantity.dataset].id);
  return name;
}

Sentence place_words(const ExperimentPlan& plan, std::size_t dataset, double diameter,
                     double velocity) {
  Sentence words = say("{} at {:.3g} m/s", diameter_words(diameter), velocity);
  if (plan.datasets.size() > 1) words += Sentence(" on " + plan.datasets[dataset].id);
  return words;
}

/// Why a quantity does not have the wanted error, and what it takes.
Sentence unreached_words(const ExperimentPlan& plan, const PlannedQuantity& quantity) {
  const std::string wanted = fmt::format("{:.3g} %", 100.0 * plan.options.error);
  const Sentence known =
      name_of_quantity(plan, quantity) +
      say(" is known to {}: ", text_of(quantity.error, in_percent(significant(2))));
  return known + (quantity.impacts
                      ? say("{} takes {:.0f} impacts in the same proportions.", wanted,
                            std::ceil(*quantity.impacts))
                      : say("no number of impacts gives {}, because the constants of the materials "
                            "are too uncertain.",
                            wanted));
}

Paragraph plan_answer(const ExperimentPlan& plan) {
  constexpr std::size_t most_named = 4;
  std::vector<Sentence> reached, others;
  double worst = 0.0, worst_reached = 0.0;  // expected errors
  double worst_case = 0.0, worst_case_reached = 0.0;
  for (const PlannedQuantity& quantity : plan.quantities) {
    worst = std::max(worst, quantity.error);
    worst_case = std::max(worst_case, quantity.worst_error);
    if (quantity.error > plan.options.error) {
      others.push_back(unreached_words(plan, quantity));
    } else {
      reached.push_back(name_of_quantity(plan, quantity));
      worst_reached = std::max(worst_reached, quantity.error);
      worst_case_reached = std::max(worst_case_reached, quantity.worst_error);
    }
  }
  const bool none = reached.empty();
  const std::string wanted = fmt::format("{:.3g} %", 100.0 * plan.options.error);
  Sentence text =
      say("{} impacts in {} points determine ", plan.impacts, plan.points) +
      (none || others.empty()        ? Sentence("everything")
       : reached.size() > most_named ? Sentence("the rest")
                                     : join(reached, ", ")) +
      say(" to {} or better", text_of(none ? worst : worst_reached, in_percent(significant(2))));
  if (plan.draws > 1) {
    text += say(" (at worst {})",
                text_of(none ? worst_case : worst_case_reached, in_percent(significant(2))));
  }
  text += none ? say("; the wanted error was {}.", wanted) : say(", as wanted ({}).", wanted);
  for (std::size_t k = 0; k < std::min(others.size(), most_named); ++k) text += " " + others[k];
  return {text, true};
}

Table assumptions(const ExperimentPlan& plan, const std::string& assumed, bool folded) {
  const PlanOptions& options = plan.options;
  std::vector<std::pair<Sentence, Cell>> entries = {{"fit", Sentence(plan.fit)}};
  const std::string adhesion(plan.model.slots[plan.model.slot_adhesion[0]].parameter->name);
  for (std::size_t d = 0; !folded && d < plan.datasets.size(); ++d) {
    const Dataset& dataset = plan.datasets[d];
    const double reference = plan.model.contacts[d].reference_diameter;
    entries.emplace_back("dataset", say("{}: {} on {}; ", dataset.id, dataset.system.particle.name,
                                        dataset.system.surface.name) +
                                        symbol(adhesion) +
                                        say(" is that of {}", diameter_words(reference)));
  }
  std::vector<Sentence> values;
  for (std::size_t j = 0; j < plan.theta.size(); ++j) {
    const ParameterSlot& slot = plan.model.slots[j];
    if (slot.is_constant()) continue;
    values.push_back(say("{} = {:.4g}", symbol(slot.label()), plan.theta[j]) +
                     unit_after_number(slot.parameter->unit) +
                     Sentence(slot.free ? "" : " (fixed)"));
  }
  entries.emplace_back("parameters", join(values, ", ") + Sentence("; " + assumed));
  entries.emplace_back("velocities", say("{:.4g} to {:.4g} m/s", options.slowest, options.fastest));
  entries.emplace_back("one impact",
                       say("{e} scatters by {:.3g} % of {e} and by a constant {:.3g}; {V*} varies "
                           "by {:.3g} % from impact to impact",
                           100.0 * options.scatter, options.floor, 100.0 * options.spread));
  entries.emplace_back("one point", say("the mean of {} impacts", options.events));
  return items(entries);
}

SizeUnit planned_unit(const ExperimentPlan& plan) {
  std::vector<double> diameters;
  for (const PlannedSetting& setting : plan.settings) diameters.push_back(setting.diameter);
  return size_unit(diameters);
}

/// Settings in one row of a table: one, or those that only check the model.
struct ShownSettings {
  std::vector<const PlannedSetting*> settings;

  int points() const {
    int sum = 0;
    for (const PlannedSetting* one : settings) sum += one->points;
    return sum;
  }
};

/// @param folded settings of one diameter with the fewest points share a row if they are many
std::vector<ShownSettings> rows_of(const ExperimentPlan& plan, bool folded) {
  constexpr std::size_t many = 4;
  std::vector<ShownSettings> rows;
  const auto alike = [](const PlannedSetting& a, const PlannedSetting& b) {
    return a.dataset == b.dataset && a.diameter == b.diameter && a.points == b.points;
  };
  for (const PlannedSetting& setting : plan.settings) {
    const auto same = std::ranges::count_if(
        plan.settings, [&](const PlannedSetting& other) { return alike(setting, other); });
    const auto row = std::ranges::find_if(
        rows, [&](const ShownSettings& shown) { return alike(*shown.settings.front(), setting); });
    if (folded && static_cast<std::size_t>(same) >= many && row != rows.end()) {
      row->settings.push_back(&setting);
    } else {
      rows.push_back({{&setting}});
    }
  }
  return rows;
}

Table settings_table(const ExperimentPlan& plan, bool folded) {
  Table table;
  table.caption =
      say("Number of points of {} impacts each. Expected: mean {e} of the "
          "rebounds, its standard deviation over all these points, and share of captured spheres",
          plan.options.events);
  table.columns = {{"dataset"},
                   {say("{d}"), planned_unit(plan).name},
                   {say("{V}"), "m/s"},
                   {"points"},
                   {"impacts"},
                   {say("{e}")},
                   {"sd"},
                   {"captured", "%"}};
  for (const ShownSettings& row : rows_of(plan, folded)) {
    const PlannedSetting& setting = *row.settings.front();
    const bool one = row.settings.size() == 1;
    const bool returns = one && setting.sd > 0.0;
    table.rows.push_back(
        {plan.datasets.size() > 1 ? Cell(Sentence(plan.datasets[setting.dataset].id)) : Cell(),
         Sentence(size_text(setting.diameter, planned_unit(plan))),
         one ? Cell(Number{setting.velocity, significant(3)})
             : Cell(say("{} to {}", number(setting.velocity, 3),
                        number(row.settings.back()->velocity, 3))),
         whole(row.points()), whole(row.points() * plan.options.events),
         returns ? Cell(Number{setting.restitution, fixed(3)}) : Cell(),
         returns ? Cell(Number{setting.sd, padded(2)}) : Cell(),
         one ? Cell(Number{100.0 * setting.captured, fixed(0)}) : Cell()});
  }
  if (plan.datasets.size() == 1) {  // the first cell of a row is its heading
    table.columns.erase(table.columns.begin());
    for (std::vector<Cell>& row : table.rows) row.erase(row.begin());
  }
  return table;
}

double worst_capture(const ExperimentPlan& plan) {
  double worst = 0.0;
  for (const PlannedQuantity& quantity : plan.quantities) {
    if (!quantity.is_parameter()) worst = std::max(worst, quantity.error);
  }
  return worst;
}

/// @param folded only the worst of many capture velocities
Table errors_table(const ExperimentPlan& plan, bool folded) {
  Table table;
  table.caption =
      say("Standard errors of this plan, expected and at worst (median and 95 % quantile of {} "
          "draws of the parameters), and of as many points evenly spaced in ln {V} above capture; "
          "impacts "
          "for {:.3g} %: with this plan{}",
          plan.draws, 100.0 * plan.options.error,
          folded ? "" : ", evenly spaced, and with a plan for this quantity alone");
  table.columns = {{"quantity"},  {"assumed"},        {"unit"},
                   {"plan", "%"}, {"worst", "%"},     {"evenly", "%"},
                   {"impacts"},   {"impacts evenly"}, {"impacts alone"}};
  if (folded) table.columns.resize(7);
  const Notation two_digits = in_percent(significant(2), "");
  constexpr std::ptrdiff_t many = 5;
  const auto captures =
      std::ranges::count_if(plan.quantities, std::not_fn(&PlannedQuantity::is_parameter));
  const double worst = worst_capture(plan);
  bool shown = false;
  for (const PlannedQuantity& quantity : plan.quantities) {
    Sentence name = name_of_quantity(plan, quantity);
    if (folded && captures >= many && !quantity.is_parameter()) {
      if (shown || quantity.error < worst) continue;
      shown = true;
      name += say(" (worst of {})", captures);
    }
    table.rows.push_back(
        {name, Number{quantity.value, significant(4)}, Sentence(quantity.unit),
         Number{quantity.error, two_digits}, Number{quantity.worst_error, two_digits},
         Number{quantity.plain_error, two_digits}, impacts_cell(quantity.impacts)});
    if (folded) continue;
    table.rows.back().push_back(impacts_cell(quantity.plain_impacts));
    table.rows.back().push_back(impacts_cell(quantity.alone_impacts));
  }
  return table;
}

Table learnt_table(const ExperimentPlan& plan) {
  Table table;
  table.caption = "The best experiment for each quantity alone";
  table.columns = {{"quantity"}, {"impacts", "", true}};
  for (const PlannedQuantity& quantity : plan.quantities) {
    std::vector<Sentence> places;
    for (const LearntAt& at : quantity.learnt_at) {
      if (places.size() == most_places) break;
      places.push_back(say("{:.0f} % ", 100.0 * at.share) +
                       place_words(plan, at.dataset, at.diameter, at.velocity));
    }
    table.rows.push_back({name_of_quantity(plan, quantity), join(places, "; ")});
  }
  return table;
}

List limits_of_plan(const ExperimentPlan& plan, bool folded) {
  std::vector<Validity> all;
  for (const PlannedSetting& setting : plan.settings) {
    const std::vector<Validity> found =
        impact_validity(plan.model, plan.datasets[setting.dataset].system, plan.theta,
                        {setting.dataset, setting.diameter, setting.velocity});
    all.insert(all.end(), found.begin(), found.end());
  }
  constexpr std::size_t most = 2;
  std::vector<std::string> limits = exceeded_limits(all, plan.datasets);
  if (folded && limits.size() > most + 1) {
    const std::string more = fmt::format("{} more: --verbose", limits.size() - most);
    limits.resize(most);
    limits.push_back(more);
  }
  return list_of_sentences({limits.begin(), limits.end()});
}

std::vector<Section> plan_sections(const ExperimentPlan& plan, const std::string& assumed,
                                   bool folded) {
  Section answer{"plan", "Plan", {}, {plan_answer(plan)}};
  const Sentence efficiency =
      say("on average over the draws, the plan has at least {:.0f} % of the efficiency of the "
          "optimal plan",
          std::floor(100.0 * plan.efficiency));
  answer.blocks.emplace_back(
      Paragraph{plan.options.checks > 0.0
                    ? say("{:.0f} % of the points are spread evenly to detect a wrong model; ",
                          100.0 * plan.options.checks) +
                          efficiency + Sentence(" without them.")
                    : Sentence("No points are reserved to check the model (--checks 0); ") +
                          efficiency + Sentence(".")});
  return {std::move(answer),
          shown_section("assumed", "Assumed", {assumptions(plan, assumed, folded)}),
          shown_section("settings", "Points to measure", {settings_table(plan, folded)}),
          shown_section("errors", "Errors", {errors_table(plan, folded)}),
          detail_section("alone", "Each quantity alone", {learnt_table(plan)}),
          shown_section("limits", "Limits of the model", {limits_of_plan(plan, folded)})};
}

std::optional<double> whole_number(const std::optional<double>& value) {
  return value ? std::optional(std::ceil(*value)) : std::nullopt;
}

PlanFile::Quantity quantity_of(const ExperimentPlan& plan, const PlannedQuantity& quantity) {
  PlanFile::Quantity out = {.kind = quantity.is_parameter() ? "parameter" : "capture_velocity",
                            .value = quantity.value,
                            .unit = quantity.unit,
                            .relative_error = quantity.error,
                            .relative_error_worst = quantity.worst_error,
                            .relative_error_even = quantity.plain_error,
                            .impacts = whole_number(quantity.impacts),
                            .impacts_even = whole_number(quantity.plain_impacts),
                            .impacts_alone = whole_number(quantity.alone_impacts)};
  if (quantity.is_parameter()) {
    out.parameter = quantity.label;
  } else {
    out.dataset = plan.datasets[quantity.dataset].id;
    out.diameter_um = quantity.diameter / units::um;
  }
  for (const LearntAt& at : quantity.learnt_at) {
    out.learnt_at.push_back(
        {plan.datasets[at.dataset].id, at.diameter / units::um, at.velocity, at.share});
  }
  return out;
}

}  // namespace

std::string plan_text(const ExperimentPlan& plan, const std::string& assumed, Importance least) {
  return terminal_text(plan_sections(plan, assumed, least == Importance::answer), least);
}

std::string plan_html(const ExperimentPlan& plan, const std::string& assumed) {
  Document page = page_of("Plan for " + plan.fit, plan.fit, plan_sections(plan, assumed, false));
  page.heading = "What to measure";
  page.subtitle = page.title;
  page.sections.front().title = "Plan";
  return html_page(page);
}

std::string json_plan(const ExperimentPlan& plan) {
  const PlanOptions& options = plan.options;
  PlanFile out = {.recoil_version = version(),
                  .fit = plan.fit,
                  .assumed = {.draws = plan.draws,
                              .velocities = {options.slowest, options.fastest},
                              .scatter = options.scatter,
                              .floor = options.floor,
                              .spread = options.spread},
                  .wanted_error = options.error,
                  .reached = plan.reached,
                  .checks = options.checks,
                  .points = plan.points,
                  .events_per_point = options.events,
                  .impacts = plan.impacts,
                  .efficiency = plan.efficiency};
  for (const Dataset& dataset : plan.datasets) {
    out.datasets.push_back({dataset.id, dataset.system.particle.name, dataset.system.surface.name});
  }
  for (std::size_t j = 0; j < plan.theta.size(); ++j) {
    const ParameterSlot& slot = plan.model.slots[j];
    out.assumed.parameters.push_back(
        {slot.label(), {plan.theta[j], std::string(slot.parameter->unit), slot.free}});
  }
  for (const PlannedSetting& setting : plan.settings) {
    out.settings.push_back(
        {.dataset = plan.datasets[setting.dataset].id,
         .diameter_um = setting.diameter / units::um,
         .incident_velocity = setting.velocity,
         .points = setting.points,
         .impacts = setting.points * options.events,
         .restitution = setting.restitution,
         .restitution_sd = setting.sd > 0.0 ? OrNull<double>(setting.sd) : std::nullopt,
         .captured = setting.captured});
  }
  for (const PlannedQuantity& quantity : plan.quantities) {
    out.quantities.push_back(quantity_of(plan, quantity));
  }
  return text_of(out);
}

std::string csv_points_to_make(const ExperimentPlan& plan, std::size_t dataset) {
  const std::vector<DataColumn>& columns = plan.datasets[dataset].columns;
  std::string csv;
  for (const DataColumn& column : columns) csv += (csv.empty() ? "" : ",") + column.name;
  csv += '\n';
  for (const PlannedSetting& setting : plan.settings) {
    if (setting.dataset != dataset) continue;
    std::string row;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (c > 0) row += ',';
      const auto quantity = value_named<Quantity>(columns[c].name);
      if (!quantity) continue;
      const double factor = unit_factor(dimension_of(*quantity), columns[c].unit).value_or(1.0);
      if (quantity == Quantity::series) {
        row += diameter_words(setting.diameter);
      } else if (quantity == Quantity::diameter) {
        row += fmt::format("{:.6g}", setting.diameter / factor);
      } else if (quantity == Quantity::incident_velocity) {
        row += fmt::format("{:.6g}", setting.velocity / factor);
      } else if (quantity == Quantity::incidence_angle) {
        row += "0";  // planned along the normal
      } else if (quantity == Quantity::events) {
        row += fmt::format("{}", plan.options.events);
      }
    }
    for (int k = 0; k < setting.points; ++k) csv += row + '\n';
  }
  return csv;
}

}  // namespace recoil
