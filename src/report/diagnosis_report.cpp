#include "report/diagnosis_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "document/html.hpp"
#include "report/format.hpp"
#include "report/words_candidate.hpp"
#include "report/words_dataset.hpp"
#include "report/words_diagnosis.hpp"
#include "report/words_restitution.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_pairs = 8;
constexpr std::size_t most_misfits_on_top = 2;  // figures of the misfit in the answer
constexpr std::size_t summary_sentences = 3;    // on the page of the fit

struct FittedParameter {
  Cell estimate, interval;
  std::string remark;
};

FittedParameter fitted_parameter(const FitResult& fitted, const std::vector<IntervalSet>& intervals,
                                 const std::string& label) {
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    if (fitted.model.slots[j].label() != label) continue;
    if (!fitted.model.slots[j].free) {
      return {Number{acting_value(fitted.model, fitted.theta, j)},
              {},
              followed_in(fitted.model, j) ? "follows the materials" : "fixed"};
    }
    const double error = j < fitted.std_error.size() ? fitted.std_error[j] : 0.0;
    FittedParameter found{Number{fitted.theta[j], significant(4), error}, {}, ""};
    if (fitted.at_bound[j]) found.remark = "at its bound";
    if (j < intervals.size())
      found.interval = interval_cell(recommended_interval(intervals[j]), padded(3));
    return found;
  }
  return {};
}

Cell remark_on_both(const std::string& base, const std::string& extended) {
  if (base == extended) return Sentence(base);
  if (base.empty()) return Sentence(extended + " in the extended model");
  if (extended.empty()) return Sentence(base + " in the base model");
  return Sentence(fmt::format("{}, then {}", base, extended));
}

Table structure_table(const Diagnosis& d) {
  Table table;
  table.caption =
      say("Tests of the residuals; {p} from {} simulated data sets", d.structure.simulated);
  table.columns = {{"structure"}, {say("{p}")}};
  for (const StructureTest& test : d.structure.tests) {
    table.rows.push_back({Sentence(words_of(test.question)), Number{test.p_value, probability()}});
  }
  table.rows.push_back({"all tests together", Number{d.structure.p_value, probability()}});
  return table;
}

Table misfit_table(const Diagnosis& d) {
  const SizeUnit sizes = size_unit(d.datasets);
  Table table;
  table.caption = say("Mean {e} of the points minus {e} of the model");
  table.columns = {{say("{d}"), sizes.name}, {"dataset", "", true}, {say("{V}"), "m/s"}, {"points"},
                   {say("in {e}")},          {"energy", "J"},       {"standard errors"}};
  for (const MisfitCell& cell : d.where) {
    table.rows.push_back(
        {Sentence(size_text(cell.diameter, sizes)),
         d.datasets.size() > 1 ? Cell(Sentence(short_name(d.datasets, cell.dataset))) : Cell(),
         say("{:.3g} to {:.3g}", cell.slowest, cell.fastest), whole(cell.points),
         Number{cell.restitution, signed_fixed(3)}, Number{cell.energy, scientific(2)},
         Number{cell.standardised, signed_fixed(1)}});
  }
  return table;
}

/// All single mechanisms and the best pairs, sorted by AICc.
std::vector<CandidateResult> sorted_candidates(const Diagnosis& d) {
  std::vector<CandidateResult> all = d.candidates;
  const std::size_t pairs = std::min(d.pairs.size(), most_pairs);
  all.insert(all.end(), d.pairs.begin(), d.pairs.begin() + static_cast<std::ptrdiff_t>(pairs));
  std::ranges::stable_sort(
      all, [](const auto& one, const auto& other) { return one.delta_aicc < other.delta_aicc; });
  return all;
}

/// The candidates that decrease AICc or explain the misfit, the best `most` of them.
Table candidates_table(const Diagnosis& d, std::size_t most = SIZE_MAX) {
  Table table;
  table.caption =
      say("Mechanisms added to the model, alone or in pairs. Gain: decrease of AICc. {p}: share of "
          "simulated data sets in which the best of all candidates gains as much by chance. Left: "
          "p-value of the structure that remains");
  table.columns = {{"mechanism"}, {"gain"}, {say("{p}")},
                   {"held out"},  {"left"}, {"verdict", "", true}};
  table.compact = true;
  std::size_t more = 0;
  std::size_t others = 0;
  for (const CandidateResult& c : sorted_candidates(d)) {
    const bool gains = c.delta_aicc < 0.0 || c.explains();
    if (!gains || table.rows.size() == most) {
      ++(gains ? more : others);
      continue;
    }
    table.rows.push_back(
        {Sentence(words_of(c.candidate.name())), Number{-c.delta_aicc, fixed(1)},
         cell_if(number_if(c.p_value, probability())),
         c.gain ? Cell(Number{c.gain->relative, in_percent(signed_fixed(0))}) : Cell(),
         Number{c.remaining_p, probability()},
         Sentence(c.explains() ? "explains it" : short_set_aside_words(c))});
  }
  if (more > 0) table.rows.push_back({say("{} more", more), {}, {}, {}, {}, {}});
  if (others > 0) {
    table.rows.push_back({say("{} others", others), {}, {}, {}, {}, "gain too little"});
  }
  return table;
}

/// The meaning of the causes in the answer.
List causes_list(const Diagnosis& d) {
  List list;
  for (const std::string& id : d.causes()) {
    const Mechanism* const mechanism = find_mechanism(id);
    if (mechanism == nullptr) continue;
    list.entries.push_back(strong(words_of(id)) + ": " + mechanism->info.title);
  }
  return list;
}

std::string remark_of(const HeldOutGain::PerFold& fold) {
  std::vector<std::string> remarks;
  if (!fold.chosen) remarks.emplace_back("the other points choose the base model");
  if (!fold.counted) remarks.emplace_back("shown, not counted");
  return fmt::format("{}", fmt::join(remarks, "; "));
}

Table held_out_table(const Diagnosis& d) {
  Table table;
  if (!d.gain()) return table;
  table.caption = "Both models are fitted without a block of points and compared with that block";
  table.columns = {{"held out"},
                   {"points"},
                   {say("rms of {e}, base")},
                   {say("rms of {e}, extended")},
                   {"ln likelihood"},
                   {"remark", "", true}};
  for (const HeldOutGain::PerFold& fold : d.gain()->folds) {
    table.rows.push_back(
        {say("{} {}", to_string(fold.fold.kind), fold_words(fold.fold, d.datasets)),
         whole(fold.fold.points.size()), Number{fold.rmse_base, significant(3)},
         Number{fold.rmse_extended, significant(3)}, Number{fold.log_score, signed_fixed(1)},
         Sentence(remark_of(fold))});
  }
  return table;
}

Table both_models_table(const Diagnosis& d) {
  Table table;
  if (!d.extended() || !d.extended()->fit) return table;
  const ExtendedModel& extension = *d.extended();
  const std::string level = percent(d.spec.uncertainty.level) + " interval";
  table.compact = true;
  table.caption = "Parameters under both models";
  if (d.spec.law_error != 0.0) table.caption += ", with exact laws";
  table.columns = {{"parameter"}, {"base"}, {level}, {"extended"}, {level}, {"remark", "", true}};
  const ImpactModel& model = extension.fit->model;
  for (std::size_t s = 0; s < model.slots.size(); ++s) {
    const ParameterSlot& slot = model.slots[s];
    if (slot.is_constant()) continue;
    const FittedParameter base = fitted_parameter(d.base, extension.base_intervals, slot.label());
    const FittedParameter extended =
        fitted_parameter(*extension.fit, extension.intervals, slot.label());
    table.rows.push_back(
        {name_with_unit(parameter_words(model, s, d.datasets), slot.parameter->unit), base.estimate,
         base.interval, extended.estimate, extended.interval,
         remark_on_both(base.remark, extended.remark)});
  }
  return table;
}

Table capture_change_table(const Diagnosis& d) {
  const SizeUnit sizes = size_unit(d.datasets);
  Table table;
  table.caption = "Predicted capture velocity";
  table.columns = {
      {say("{d}"), sizes.name}, {"dataset", "", true}, {"base", "m/s"}, {"extended", "m/s"}};
  const auto cell = [](const std::optional<double>& value) {
    return value ? Cell(Number{*value, significant(4)}) : Cell("none");
  };
  if (!d.extended()) return table;
  for (const CaptureChange& change : d.extended()->capture) {
    table.rows.push_back(
        {Sentence(size_text(change.diameter, sizes)),
         d.datasets.size() > 1 ? Cell(Sentence(short_name(d.datasets, change.dataset))) : Cell(),
         cell(change.base), cell(change.extended)});
  }
  return table;
}

Table next_experiment_table(const Diagnosis& d) {
  const SizeUnit sizes = size_unit(d.datasets);
  Table table;
  if (d.next.list.empty()) return table;
  table.compact = true;
  table.caption =
      "Experiments with the fewest impacts: impacts that make the expected odds between two causes "
      "99 to 1";
  table.columns = {
      {"action", "", true},    {"impacts"},        {say("{d}"), sizes.name},  {say("{V}"), "m/s"},
      {"separates", "", true}, {"from", "", true}, {say("difference in {e}")}};
  for (const NextExperiment& next : d.next.list) {
    table.rows.push_back(
        {Sentence(doing_words(next)), whole(next.events), Sentence(size_text(next.diameter, sizes)),
         Number{next.velocity, significant(3)}, Sentence(rival_words(next.one)),
         Sentence(rival_words(next.other)), Number{next.difference, signed_fixed(3)}});
  }
  return table;
}

Section answer_section(const Diagnosis& d) {
  Section answer{"answer", d.spec.id, "diagnosis"};
  answer.blocks = {Paragraph{headline(d), true},
                   Paragraph{fmt::format("{}", fmt::join(answer_sentences(d), " "))},
                   Paragraph{join(restitution_sentences(d.datasets, d.base), " ")}};
  append(answer.blocks, data_banners(d.datasets));
  return answer;
}

}  // namespace

std::vector<Section> diagnosis_sections(const Diagnosis& d) {
  const std::vector<Figure> before_after = before_after_figures(d);
  const std::vector<Figure> misfit = misfit_figures(d);
  const bool one = d.datasets.size() == 1;
  std::vector<Figure> answer = one ? before_after : std::vector<Figure>();
  std::vector<Figure> where = misfit;
  if (one || misfit.size() <= most_misfits_on_top) {
    answer.insert(answer.end(), misfit.begin(), misfit.end());
    where.clear();
  }
  std::vector<std::string> notes = answer_notes(d);
  for (std::string& warning : diagnosis_warnings(d)) notes.push_back(std::move(warning));
  return {answer_section(d),
          shown_section("picture", "", {Figures{std::move(answer)}}),
          detail_section("misfit", "Misfit by velocity and diameter",
                         {Figures{std::move(where)}, structure_table(d), misfit_table(d)}),
          detail_section("causes", "Every cause tried", {candidates_table(d), causes_list(d)}),
          detail_section("gain", "The extended model",
                         {one ? Figures{} : Figures{before_after}, both_models_table(d),
                          capture_change_table(d), held_out_table(d)}),
          detail_section("next", "What to measure next", {next_experiment_table(d)}),
          detail_section("notes", "Notes and warnings",
                         {list_of_sentences({notes.begin(), notes.end()})})};
}

Section closest_causes(const Diagnosis& d) {
  constexpr std::size_t most = 2;
  return detail_section("diagnosis-causes", "Diagnosis: The closest causes",
                        {candidates_table(d, most), causes_list(d)});
}

Section diagnosis_summary(const Diagnosis& d, const std::string& address) {
  std::vector<std::string> sentences = answer_sentences(d);
  if (sentences.size() > summary_sentences) sentences.resize(summary_sentences);
  Section section{"diagnosis", "Diagnosis"};
  const std::string cause = cause_headline(d);
  section.blocks = {Paragraph{(cause.empty() ? Sentence() : strong(cause + ".") + " ") +
                              Sentence(fmt::format("{}", fmt::join(sentences, " ")))}};
  if (!address.empty()) section.blocks.emplace_back(Paragraph{link("The closest causes", address)});
  return section;
}

Document diagnosis_document(const Diagnosis& d) {
  return page_of("Diagnosis of " + d.spec.id, d.spec.id, diagnosis_sections(d));
}

std::string diagnosis_text(const Diagnosis& d, Importance least, std::size_t columns) {
  std::vector<Section> sections = diagnosis_sections(d);
  if (!d.spec.file.empty()) {
    const std::string file = d.spec.file.generic_string();
    const auto first_detail = std::ranges::find_if(
        sections, [](const Section& one) { return one.importance == Importance::detail; });
    sections.insert(
        first_detail,
        shown_section(
            "next", "",
            {Paragraph{say("Next: {} (a page, and the extended model as a fit "
                           "file), {} (every cause tried).",
                           code("recoil diagnose " + file + " --out DIR"), code("--verbose"))}}));
  }
  return terminal_text(sections, least, columns);
}

std::string diagnosis_html(const Diagnosis& d) { return html_page(diagnosis_document(d)); }

}  // namespace recoil
