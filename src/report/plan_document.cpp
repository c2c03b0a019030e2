#include "report/plan_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/program.hpp"
#include "core/units.hpp"
#include "document/html.hpp"
#include "document/terminal.hpp"
#include "predict/validity.hpp"
#include "report/figures_plan.hpp"
#include "report/format.hpp"
#include "report/words_dataset.hpp"
#include "report/words_diagnosis.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_steps = 8;
constexpr std::size_t most_told = 4;
constexpr std::size_t most_places = 3;

Notation two_digit_percent() {
  Notation notation = significant(2);
  notation.scale = 100.0;
  return notation;
}

Cell impacts_cell(const std::optional<double>& impacts) {
  if (!impacts) return Sentence("no number");
  return Number{std::ceil(*impacts), fixed(0)};
}

Sentence name_of_quantity(const ExperimentPlan& plan, const PlannedQuantity& quantity) {
  if (quantity.kind == PlannedKind::parameter) return symbol(quantity.label);
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

Paragraph plan_answer(const ExperimentPlan& plan) {
  const PlannedQuantity* worst = &plan.quantities.front();
  for (const PlannedQuantity& quantity : plan.quantities) {
    if (quantity.error > worst->error) worst = &quantity;
  }
  Sentence text = say("{} impacts in {} points determine everything to {} or better", plan.impacts,
                      plan.points, text_of(worst->error, in_percent(significant(2))));
  if (plan.reached) {
    return {text + say(", as wanted ({:.3g} %).", 100.0 * plan.options.error), true};
  }
  text += say("; wanted were {:.3g} %. Hardest is ", 100.0 * plan.options.error) +
          name_of_quantity(plan, *worst);
  text += worst->impacts
              ? say(": {:.0f} impacts in the same proportions.", std::ceil(*worst->impacts))
              : Sentence(
                    ", for which no number of impacts would do: the constants of "
                    "the materials are not known well enough.");
  return {text, true};
}

Table assumptions(const ExperimentPlan& plan, const std::string& assumed) {
  const PlanOptions& options = plan.options;
  std::vector<std::pair<Sentence, Cell>> entries = {{"fit", Sentence(plan.fit)}};
  const std::string adhesion(plan.model.slots[plan.model.slot_adhesion[0]].parameter->name);
  for (std::size_t d = 0; d < plan.datasets.size(); ++d) {
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
  entries.emplace_back(
      "one impact",
      say("{e} scatters by {:.3g} % of itself and {:.3g} beside it; {V*} differs by {:.3g} % from "
          "impact to impact",
          100.0 * options.scatter, options.floor, 100.0 * options.spread));
  entries.emplace_back("one point", say("the mean of {} impacts", options.events));
  return items(entries);
}

SizeUnit planned_unit(const ExperimentPlan& plan) {
  std::vector<double> diameters;
  for (const PlannedSetting& setting : plan.settings) diameters.push_back(setting.diameter);
  return size_unit(diameters);
}

Table settings_table(const ExperimentPlan& plan) {
  Table table;
  table.caption =
      say("What to measure: so many points of {} impacts each. Expected: the mean "
          "{e} of the rebounds, its standard deviation over all points there, and the "
          "share of spheres that stay",
          plan.options.events);
  table.columns = {{"dataset"},
                   {say("{d}"), planned_unit(plan).name},
                   {say("{V}"), "m/s"},
                   {"points"},
                   {"impacts"},
                   {say("{e}")},
                   {"sd"},
                   {"captured", "%"}};
  for (const PlannedSetting& setting : plan.settings) {
    const bool returns = setting.sd > 0.0;
    table.rows.push_back(
        {plan.datasets.size() > 1 ? Cell(Sentence(plan.datasets[setting.dataset].id)) : Cell(),
         Sentence(size_text(setting.diameter, planned_unit(plan))),
         Number{setting.velocity, significant(3)},
         Number{static_cast<double>(setting.points), fixed(0)},
         Number{static_cast<double>(setting.points * plan.options.events), fixed(0)},
         returns ? Cell(Number{setting.restitution, fixed(3)}) : Cell(),
         returns ? Cell(Number{setting.sd, padded(2)}) : Cell(),
         Number{100.0 * setting.captured, fixed(0)}});
  }
  if (plan.datasets.size() == 1) {  // the first cell of a row is its heading
    table.columns.erase(table.columns.begin());
    for (std::vector<Cell>& row : table.rows) row.erase(row.begin());
  }
  return table;
}

Table errors_table(const ExperimentPlan& plan) {
  Table table;
  table.caption =
      say("Standard errors to be expected of this plan and of as many points evenly "
          "spaced in ln {V} above capture, and the impacts that make each {:.3g} %: of "
          "the plan, evenly spaced, and if nothing else were asked",
          100.0 * plan.options.error);
  table.columns = {{"quantity"},    {"assumed"}, {"unit"},           {"plan", "%"},
                   {"evenly", "%"}, {"impacts"}, {"impacts evenly"}, {"impacts alone"}};
  for (const PlannedQuantity& quantity : plan.quantities) {
    table.rows.push_back({name_of_quantity(plan, quantity), Number{quantity.value, significant(4)},
                          Sentence(quantity.unit), Number{quantity.error, two_digit_percent()},
                          Number{quantity.plain_error, two_digit_percent()},
                          impacts_cell(quantity.impacts), impacts_cell(quantity.plain_impacts),
                          impacts_cell(quantity.alone_impacts)});
  }
  return table;
}

Table learnt_table(const ExperimentPlan& plan) {
  Table table;
  table.caption = "Where each is learnt: the best experiment for one of them alone";
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

/// "1e-14 (0 to 1e-11) J"
Sentence strength_words(const PlannedCause& cause) {
  const std::string range = cause.stated
                                ? std::string("stated")
                                : fmt::format("{:.2g} to {:.2g}", cause.lower, cause.upper);
  return say("{:.3g} ({})", cause.strength, range) + unit_after_number(cause.unit);
}

Table causes_table(const ExperimentPlan& plan) {
  Table table;
  if (plan.expected.causes.empty()) return table;
  table.compact = true;
  table.caption = say(
      "What else may act, at the strength at which a diagnosis starts to look for it (and what it "
      "can be). Seen: expected odds of 99 to 1 against the model without it; told from: other "
      "causes against which the odds are as good");
  table.columns = {{"cause"}, {"strength", "", true}, {say("change of {e}")},
                   {"seen"},  {"seen from"},          {"told from"}};
  for (const PlannedCause& cause : plan.expected.causes) {
    const bool possible = cause.seen_from && *cause.seen_from <= std::max(cause.upper, 0.0);
    const int told = cause.rivals - static_cast<int>(cause.confused.size());
    table.rows.push_back({Sentence(cause.id), strength_words(cause),
                          Number{cause.change, signed_fixed(3)},
                          Sentence(cause.seen() ? "yes" : "no"),
                          possible ? Cell(Number{*cause.seen_from, significant(2)}) : Cell(),
                          cause.seen() ? Cell(say("{} of {}", told, cause.rivals)) : Cell()});
  }
  return table;
}

Table confusions_table(const ExperimentPlan& plan) {
  Table table;
  table.compact = true;
  table.caption =
      "Seen, but not told from others: if the first is true, each of these does as well";
  table.columns = {{"true"}, {"does as well", "", true}};
  for (const PlannedCause& cause : plan.expected.causes) {
    if (cause.confused.empty()) continue;
    std::vector<Sentence> rivals;
    for (const Confusion& rival : cause.confused) rivals.emplace_back(rival.id);
    table.rows.push_back({Sentence(cause.id), join(rivals, ", ")});
  }
  return table;
}

/// "shows a, b; tells c from d, e": what a step does, or nothing would do.
std::string done_words(const std::vector<CausePair>& pairs, std::size_t most) {
  std::vector<std::string> shown;
  std::map<std::string, std::vector<std::string>> told;
  for (const auto& [one, other] : pairs) {
    if (other.empty()) {
      shown.push_back(one);
    } else {
      told[one].push_back(other);
    }
  }
  std::vector<std::string> parts;
  if (!shown.empty()) parts.push_back(fmt::format("show {}", fmt::join(shown, ", ")));
  std::size_t named = 0;
  std::size_t more = 0;
  for (const auto& [one, others] : told) {
    if (named >= most) {
      more += others.size();
      continue;
    }
    parts.push_back(fmt::format("tell {} from {}", one, fmt::join(others, ", ")));
    named += others.size();
  }
  if (more > 0) parts.push_back(fmt::format("tell {} more pair{}", more, more == 1 ? "" : "s"));
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string doing_words(const PlanRemedy& remedy) {
  switch (remedy.kind) {
    case ExperimentKind::points:
      break;
    case ExperimentKind::condition:
      return std::string(remedy.doing);
    case ExperimentKind::target:
      return fmt::format("take {} as the target, {} impacts at each of {} velocities and sizes",
                         block_words(remedy.material), remedy.places.front().events,
                         remedy.places.size());
  }
  return "more points";
}

Cell size_cell(const ExperimentPlan& plan, const PlanRemedy& remedy) {
  const SizeUnit unit = planned_unit(plan);
  const std::string first = size_text(remedy.diameter, unit);
  if (remedy.places.empty()) return Sentence(first);
  const std::string last = size_text(remedy.places.back().diameter, unit);
  return Sentence(first == last ? first : first + " and " + last);
}

Cell velocity_cell(const PlanRemedy& remedy) {
  if (remedy.places.empty()) return Number{remedy.velocity, significant(3)};
  const auto [slowest, fastest] = std::minmax_element(
      remedy.places.begin(), remedy.places.end(),
      [](const ExperimentPlace& a, const ExperimentPlace& b) { return a.velocity < b.velocity; });
  return say("{:.3g} to {:.3g}", slowest->velocity, fastest->velocity);
}

Table steps_table(const ExperimentPlan& plan) {
  Table table;
  table.compact = true;
  table.caption =
      "What would do the rest, on top of the plan: each line by itself, so that all "
      "beside it has odds of 99 to 1";
  table.columns = {{"do", "", true},
                   {"impacts"},
                   {say("{d}"), planned_unit(plan).name},
                   {say("{V}"), "m/s"},
                   {"to", "", true}};
  for (const PlanStep& step : plan.expected.steps) {
    if (table.rows.size() == most_steps) break;
    const PlanRemedy& remedy = step.remedy;
    table.rows.push_back({Sentence(doing_words(remedy)),
                          Number{static_cast<double>(remedy.impacts), fixed(0)},
                          size_cell(plan, remedy), velocity_cell(remedy),
                          Sentence(done_words(step.tells, most_told))});
  }
  return table;
}

List beyond_reach(const ExperimentPlan& plan) {
  const PlannedCauses& expected = plan.expected;
  List list;
  if (expected.steps.size() > most_steps) {
    list.entries.push_back(
        say("{} more steps stand in plan.json.", expected.steps.size() - most_steps));
  }
  if (expected.beyond.empty()) return list;
  list.entries.push_back(
      Sentence("At these strengths no size, velocity, condition or target within reach, with 10000 "
               "impacts, would " +
               done_words(expected.beyond, expected.beyond.size()) + "."));
  return list;
}

List limits_of_plan(const ExperimentPlan& plan) {
  std::vector<Validity> worst;
  for (const PlannedSetting& setting : plan.settings) {
    for (const Validity& found :
         impact_validity(plan.model, plan.datasets[setting.dataset].system, plan.theta,
                         {setting.dataset, setting.diameter, setting.velocity})) {
      const auto same = std::find_if(worst.begin(), worst.end(), [&](const Validity& other) {
        return other.quantity == found.quantity && other.dataset == found.dataset;
      });
      if (same == worst.end()) {
        worst.push_back(found);
      } else if (found.limit_is_least() ? found.value < same->value : found.value > same->value) {
        *same = found;
      }
    }
  }
  List list;
  for (const std::string& sentence : passed_limits(worst, plan.datasets)) {
    list.entries.push_back(as_sentence(Sentence(sentence)));
  }
  return list;
}

}  // namespace

std::vector<Section> plan_sections(const ExperimentPlan& plan, const std::string& assumed) {
  Section answer{"plan", "Plan", {}, {plan_answer(plan)}};
  const Sentence efficiency =
      say("the plan has at least {:.0f} % of the efficiency of the best one",
          std::floor(100.0 * plan.efficiency));
  answer.blocks.emplace_back(
      Paragraph{plan.options.checks > 0.0
                    ? say("{:.0f} % of the points are spread evenly, so that a wrong model shows; ",
                          100.0 * plan.options.checks) +
                          efficiency + Sentence(" without them.")
                    : Sentence("No point is there to check the model (--checks 0); ") + efficiency +
                          Sentence(".")});
  answer.blocks.emplace_back(Figures{plan_figures(plan)});
  return {std::move(answer),
          {"assumed", "Assumed", {}, {assumptions(plan, assumed)}},
          {"settings", "What to Measure", {}, {settings_table(plan)}},
          {"errors", "Errors", {}, {errors_table(plan), learnt_table(plan)}},
          {"causes",
           "Causes",
           {},
           {causes_table(plan), confusions_table(plan), steps_table(plan), beyond_reach(plan)}},
          {"limits", "Limits of the Model", {}, {limits_of_plan(plan)}}};
}

std::string plan_text(const ExperimentPlan& plan, const std::string& assumed) {
  return terminal_text(plan_sections(plan, assumed));
}

std::string plan_html(const ExperimentPlan& plan, const std::string& assumed) {
  Document page;
  page.title = "Plan for " + plan.fit;
  page.heading = "What to measure";
  page.subtitle = page.title;
  page.name = plan.fit;
  page.foot = "recoil " + version();
  page.sections = plan_sections(plan, assumed);
  return html_page(std::move(page));
}

}  // namespace recoil
