#include "report/diagnosis_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/program.hpp"
#include "core/units.hpp"
#include "document/html.hpp"
#include "document/terminal.hpp"
#include "report/answer_words.hpp"
#include "report/diagnosis_headline.hpp"
#include "report/figures_diagnosis.hpp"
#include "report/fit_document.hpp"
#include "report/format.hpp"
#include "report/words_diagnosis.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_on_terminal = 12;  // of the causes tried
constexpr std::size_t most_pairs = 8;
constexpr std::size_t most_values = 8;  // of the parameters of one mechanism

/// One parameter under one of the models: estimate, interval, and what is special about it.
struct UnderModel {
  Cell estimate, interval;
  std::string remark;
};

UnderModel under_model(const FitResult& fitted, const std::vector<IntervalSet>& intervals,
                       const std::string& label) {
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    if (fitted.model.slots[j].label() != label) continue;
    if (!fitted.model.slots[j].free) {
      const bool moves = fitted.model.slots[j].is_constant();
      const bool follows = followed_in(fitted.model, j).has_value();
      return {Number{acting_value(fitted.model, fitted.theta, j)},
              {},
              moves     ? "moves within its stated error"
              : follows ? "follows the materials"
                        : "fixed"};
    }
    const double error = j < fitted.std_error.size() ? fitted.std_error[j] : 0.0;
    UnderModel found{Number{fitted.theta[j], significant(4), error}, {}, ""};
    if (fitted.at_bound[j]) found.remark = "at its bound";
    if (j < intervals.size())
      found.interval = interval_cell(recommended_interval(intervals[j]), padded(3));
    return found;
  }
  return {};
}

Cell said_of_both(const std::string& base, const std::string& extended) {
  if (base == extended) return Sentence(base);
  if (base.empty()) return Sentence(extended + " in the extended model");
  if (extended.empty()) return Sentence(base + " in the base model");
  return Sentence(fmt::format("{}, then {}", base, extended));
}

Paragraph gain_summary(const Diagnosis& d) {
  if (!d.gain || !d.gain->lower || !d.gain->upper || !d.gain->any_chosen()) return {};
  return {say("Together: {} instead of {}, {:.0f} % less (95 % interval {:.0f} to {:.0f} %).",
              number(d.gain->rmse_extended, 3), number(d.gain->rmse_base, 3),
              100.0 * d.gain->relative, 100.0 * *d.gain->lower, 100.0 * *d.gain->upper)};
}

List notes_of(const Diagnosis& d) {
  List list;
  for (const std::string& note : answer_notes(d)) list.entries.emplace_back(note);
  return list;
}

List warnings_of(const Diagnosis& d) {
  List list;
  for (const std::string& warning : diagnosis_warnings(d)) {
    list.entries.push_back(as_sentence(Sentence(warning)));
  }
  return list;
}

}  // namespace

Table structure_table(const Diagnosis& d) {
  Table table;
  table.caption =
      say("Questions asked of the residuals; p-values from {} data sets simulated with the fitted "
          "model",
          d.structure.simulated);
  table.columns = {{"question"}, {say("{p}")}, {"id", "", true}};
  for (const StructureTest& test : d.structure.tests) {
    table.rows.push_back({Sentence(words_of(test.question)), Number{test.p_value, probability()},
                          Sentence(to_string(test.question))});
  }
  table.rows.push_back({"all of them together", Number{d.structure.p_value, probability()}, {}});
  return table;
}

Table misfit_table(const Diagnosis& d) {
  const SizeUnit sizes = size_unit(d.datasets);
  Table table;
  table.caption =
      say("Mean of {e} - {e}_model, also as energy of the rebound and in standard errors: positive "
          "where the model is too low");
  table.columns = {{"dataset"},     {say("{d}"), sizes.name}, {say("{V}"), "m/s"}, {"points"},
                   {say("in {e}")}, {"energy", "J"},          {"standard errors"}};
  for (const MisfitCell& cell : d.where) {
    table.rows.push_back(
        {Sentence(d.datasets[cell.dataset].id), Sentence(size_text(cell.diameter, sizes)),
         say("{:.3g} to {:.3g}", cell.slowest, cell.fastest),
         Number{static_cast<double>(cell.points), fixed(0)},
         Number{cell.restitution, signed_fixed(3)}, Number{cell.energy, scientific(2)},
         Number{cell.standardised, signed_fixed(1)}});
  }
  return table;
}

Table candidates_table(const std::vector<CandidateResult>& candidates, std::size_t most) {
  Table table;
  table.compact = true;
  table.caption =
      say("Every mechanism of the catalogue, added to the model and refitted. {p}: how often the "
          "best of all candidates gains as much on data simulated with the base model; left: "
          "p-value of the structure that remains");
  table.columns = {{"mechanism"}, {"kind", "", true}, {"dAICc"},
                   {say("{p}")},  {"held out"},       {"left"}};
  for (std::size_t k = 0; k < std::min(most, candidates.size()); ++k) {
    const CandidateResult& c = candidates[k];
    table.rows.push_back(
        {Sentence(c.candidate.name()), Sentence(to_string(c.kind)), Number{c.delta_aicc, fixed(1)},
         cell_if(number_if(c.p_value, probability())),
         c.gain ? Cell(Number{c.gain->relative, in_percent(signed_fixed(0))}) : Cell(),
         Number{c.remaining_p, probability()}});
  }
  return table;
}

Sentence value_of(const FoundParameter& p) {
  return say("{} = {:.3g}", symbol(p.label), p.value) + unit_after_number(p.unit);
}

/// All of them; of many, the least and the largest.
Sentence values_of(const std::vector<FoundParameter>& parameters) {
  if (parameters.size() > most_values) {
    const auto [least, largest] =
        std::minmax_element(parameters.begin(), parameters.end(),
                            [](const auto& a, const auto& b) { return a.value < b.value; });
    return say("{} values from ", parameters.size()) + value_of(*least) + Sentence(" to ") +
           value_of(*largest);
  }
  std::vector<Sentence> values;
  for (const FoundParameter& p : parameters) values.push_back(value_of(p));
  return join(values, ", ");
}

Table found_parameters_table(const std::vector<CandidateResult>& candidates, std::size_t most) {
  Table table;
  table.compact = true;
  table.caption = "The values that each would need, and what speaks against it";
  table.columns = {{"mechanism"}, {"parameters", "", true}, {"verdict", "", true}};
  for (std::size_t k = 0; k < std::min(most, candidates.size()); ++k) {
    const CandidateResult& c = candidates[k];
    table.rows.push_back({Sentence(c.candidate.name()), values_of(c.parameters),
                          Sentence(c.explains() ? "explains it" : set_aside_words(c))});
  }
  return table;
}

std::string remark_of(const HeldOutGain::PerFold& fold) {
  std::vector<std::string> remarks;
  if (!fold.chosen) remarks.emplace_back("the other points choose the base model");
  if (!fold.counted) remarks.emplace_back("shown, not counted");
  return fmt::format("{}", fmt::join(remarks, "; "));
}

Table held_out_table(const Diagnosis& d) {
  Table table;
  if (!d.gain) return table;
  table.caption =
      "Blocks of points that were held out: both models were fitted to the other points and then "
      "compared with these";
  table.columns = {{"held out"},
                   {"points"},
                   {say("rms of {e}, base")},
                   {say("rms of {e}, extended")},
                   {"ln likelihood"},
                   {"remark", "", true}};
  for (const HeldOutGain::PerFold& fold : d.gain->folds) {
    table.rows.push_back(
        {say("{} {}", to_string(fold.fold.kind), fold_words(fold.fold, d.datasets)),
         Number{static_cast<double>(fold.fold.points.size()), fixed(0)},
         Number{fold.rmse_base, significant(3)}, Number{fold.rmse_extended, significant(3)},
         Number{fold.log_score, signed_fixed(1)}, Sentence(remark_of(fold))});
  }
  return table;
}

Table both_models_table(const Diagnosis& d) {
  Table table;
  if (!d.extended_fit) return table;
  const std::string level = percent(d.spec.uncertainty.level) + " interval";
  table.caption =
      "Parameters under both models: how far the base model's damping stood in for the missing "
      "effect";
  if (d.spec.law_error > 0.0) {
    table.caption += fmt::format(
        ". These are fits as recoil fit makes them; what the answer and the list of causes state "
        "allows every law an error of {} besides, and may differ",
        percent(d.spec.law_error));
  }
  table.columns = {{"parameter"}, {"unit", "", true},  {"base"}, {level}, {"extended"},
                   {level},       {"remark", "", true}};
  for (const ParameterSlot& slot : d.extended_fit->model.slots) {
    const UnderModel base = under_model(d.base, d.base_intervals, slot.label());
    const UnderModel extended = under_model(*d.extended_fit, d.extended_intervals, slot.label());
    table.rows.push_back({symbol(slot.label()), unit(slot.parameter->unit), base.estimate,
                          base.interval, extended.estimate, extended.interval,
                          said_of_both(base.remark, extended.remark)});
  }
  return table;
}

Table capture_change_table(const Diagnosis& d) {
  const SizeUnit sizes = size_unit(d.datasets);
  Table table;
  table.caption = "Predicted capture velocity";
  table.columns = {{"dataset"}, {say("{d}"), sizes.name}, {"base", "m/s"}, {"extended", "m/s"}};
  const auto cell = [](const std::optional<double>& value) {
    return value ? Cell(Number{*value, significant(4)}) : Cell("none");
  };
  for (const CaptureChange& change : d.capture) {
    table.rows.push_back({Sentence(d.datasets[change.dataset].id),
                          Sentence(size_text(change.diameter, sizes)), cell(change.base),
                          cell(change.extended)});
  }
  return table;
}

Table next_experiment_table(const Diagnosis& d) {
  const SizeUnit sizes = size_unit(d.datasets);
  Table table;
  if (d.experiments.empty()) return table;
  table.compact = true;
  table.caption =
      "What to do next, the least effort first: so many impacts are expected to give the right one "
      "of two causes odds of 99 to 1, as far as the parameters and the laws of both are known";
  table.columns = {{"do", "", true},          {"impacts"},         {say("{d}"), sizes.name},
                   {say("{V}"), "m/s"},       {"tells", "", true}, {"from", "", true},
                   {say("difference in {e}")}};
  for (const NextExperiment& next : d.experiments) {
    table.rows.push_back(
        {Sentence(doing_words(next)), Number{static_cast<double>(next.events), fixed(0)},
         Sentence(size_text(next.diameter, sizes)), Number{next.velocity, significant(3)},
         Sentence(next.one), Sentence(next.other), Number{next.difference, signed_fixed(3)}});
  }
  return table;
}

Table expected_table(const Diagnosis& d) {
  const SizeUnit sizes = size_unit(d.datasets);
  Table table;
  if (d.expected.empty()) return table;
  table.caption =
      "Effects of which the stated conditions leave nothing open, where they do most to a point; "
      "theory has them there, also where they are too small to be seen";
  table.columns = {{"mechanism"},
                   {"dataset", "", true},
                   {"condition", "", true},
                   {"value"},
                   {say("{d}"), sizes.name},
                   {say("{V}"), "m/s"},
                   {say("change of {e}")}};
  for (const ExpectedEffect& effect : d.expected) {
    table.rows.push_back(
        {Sentence(effect.id), Sentence(d.datasets[effect.dataset].id),
         Sentence(condition_words(effect.condition)), Number{effect.stated, significant(4)},
         Sentence(size_text(effect.diameter, sizes)), Number{effect.velocity, significant(3)},
         Number{effect.change, significant(2)}});
  }
  return table;
}

std::vector<Block> diagnosis_answer(const Diagnosis& d) {
  std::vector<Block> blocks = {
      Paragraph{strong(headline(d) + ".")},
      Paragraph{fmt::format("{}", fmt::join(answer_sentences(d), " ")), true}};
  for (const std::string& remark : d.remarks) blocks.emplace_back(Paragraph{remark});
  return blocks;
}

std::vector<Section> diagnosis_sections(const Diagnosis& d) {
  Section answer{"verdict", "Verdict"};
  answer.blocks = {Paragraph{to_string(d.verdict)}, Paragraph{answer_words(d)}};
  append(answer.blocks, provenance_banners(d.datasets));
  for (const std::string& remark : d.remarks) answer.blocks.emplace_back(Paragraph{remark});
  return {std::move(answer),
          {"residuals", "Residuals of the base model", {}, {structure_table(d)}},
          {"misfit", "Where it misses", {}, {misfit_table(d)}},
          {"causes",
           "Causes",
           {},
           {candidates_table(d.candidates, most_on_terminal),
            found_parameters_table(d.candidates, most_on_terminal)}},
          {"pairs",
           "Two causes at once",
           {},
           {candidates_table(d.pairs, most_on_terminal),
            found_parameters_table(d.pairs, most_on_terminal)}},
          {"gain", "Gain on held-out blocks", {}, {held_out_table(d), gain_summary(d)}},
          {"parameters", "Parameters", {}, {both_models_table(d), capture_change_table(d)}},
          {"next", "What to measure next", {}, {next_experiment_table(d)}},
          {"expected", "What the conditions say must be there", {}, {expected_table(d)}},
          {"warnings", "Warnings", {}, {warnings_of(d)}}};
}

Document diagnosis_document(const Diagnosis& d) {
  constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
  Document page;
  page.title = "Diagnosis of " + d.spec.id;
  page.heading = "What the model gets wrong";
  page.subtitle = page.title;
  page.name = d.spec.id;
  page.foot = "recoil " + version();
  page.foreword = provenance_banners(d.datasets);
  append(page.foreword, diagnosis_answer(d));
  std::vector<CandidateResult> tried = d.candidates;
  tried.insert(tried.end(), d.pairs.begin(),
               d.pairs.begin() + static_cast<std::ptrdiff_t>(std::min(d.pairs.size(), most_pairs)));
  page.sections = {
      {"misfit", "Where it misses", {}, {Figures{misfit_figures(d)}}},
      {"before-after", "Before and after", {}, {Figures{before_after_figures(d)}}},
      {"causes", "What could explain it", {}, {Figures{ranking_figures(d)}}},
      {"notes", "What else there is to know", {}, {notes_of(d)}},
      {"residuals",
       "What was asked of the residuals",
       {},
       {structure_table(d), Details{"The misfit in numbers", {misfit_table(d)}}}},
      {"tried",
       "Every cause that was tried",
       {},
       {candidates_table(tried, all),
        Details{"The values that each would need, and what speaks against it",
                {found_parameters_table(tried, all)}}}},
      {"parameters", "Parameters", {}, {both_models_table(d), capture_change_table(d)}},
      {"gain", "What was gained", {}, {held_out_table(d), gain_summary(d)}},
      {"next", "What to measure next", {}, {next_experiment_table(d)}},
      {"expected", "What the conditions say must be there", {}, {expected_table(d)}},
      {"warnings", "Warnings", {}, {warnings_of(d)}}};
  return page;
}

std::vector<Block> diagnosis_blocks(const Diagnosis& d, const std::string& address) {
  // A page of several targets has many pictures already; the diagnosis itself shows the others.
  Figures figures{misfit_figures(d)};
  if (d.datasets.size() == 1) {
    for (Figure& figure : before_after_figures(d)) figures.figures.push_back(std::move(figure));
  }
  std::vector<Block> blocks = diagnosis_answer(d);
  append(blocks, {std::move(figures), both_models_table(d)});
  if (!address.empty()) {
    blocks.emplace_back(Paragraph{link("The whole diagnosis", address) +
                                  ": what was asked of the residuals, every cause that was tried, "
                                  "what was held out."});
  }
  return blocks;
}

std::string diagnosis_text(const Diagnosis& d) { return terminal_text(diagnosis_sections(d)); }

std::string diagnosis_html(const Diagnosis& d) { return html_page(diagnosis_document(d)); }

}  // namespace recoil
