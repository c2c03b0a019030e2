#include "validation/studies/paper_page.hpp"

#include "core/program.hpp"
#include "data/text.hpp"

namespace recoil::paper {
namespace {

/// The row of a statement: label, the paper, recoil, ratio, does it agree?
std::vector<Cell> row_of(const Statement& statement, const Comparison& comparison) {
  const Sentence label = say(statement.label);
  if (statement.kind == Kind::obstacle) {
    return {label, {}, say(statement.words), {}, "cannot be compared"};
  }
  const Finding& found = comparison.findings.find(statement.id)->second;
  Sentence verdict = holds(statement, comparison) ? "yes" : "no";
  if (statement.is_built_in && comparison.is_reconstruction && holds(statement, comparison)) {
    verdict += ", built in";
  }
  if (statement.kind == Kind::claim) {
    return {label, say(statement.words), as_sentence(found.words), {}, verdict};
  }
  const std::string unit_name(statement.unit);
  return {label, Sentence(Number{statement.printed, significant(4), 0.0, unit_name}),
          Sentence(Number{*found.value, significant(4), 0.0, unit_name}),
          Number{*found.value / statement.printed, fixed(3)}, verdict};
}

Table statements_table(std::string_view part, const Comparison& comparison) {
  Table table;
  table.columns = {{"statement"},
                   {"the paper", "", true},
                   {"recoil", "", true},
                   {"ratio"},
                   {"agrees", "", true}};
  for (const Statement& statement : statements()) {
    if (statement.part == part) table.rows.push_back(row_of(statement, comparison));
  }
  return table;
}

std::string counted_words(const Tally& tally) {
  return fmt::format("{} of {}", tally.agree, tally.compared());
}

/// The statements that do not agree, by the names of their parts.
Sentence disagreements(const Comparison& comparison) {
  std::vector<Sentence> found;
  for (const Statement& statement : statements()) {
    if (statement.kind == Kind::obstacle || holds(statement, comparison)) continue;
    for (const Part& part : parts()) {
      if (part.id == statement.part) {
        found.push_back(say(statement.label) + fmt::format(" ({})", part.name));
      }
    }
  }
  return found.empty() ? Sentence("None disagrees.")
                       : say("Those that disagree: {}.", join(found, "; "));
}

/// One row for each table and figure.
Table overview(const Comparison& comparison) {
  Table table;
  table.columns = {{"in the paper"},
                   {"subject", "", true},
                   {"agree", "", true},
                   {"what the fit to all points adds", "", true}};
  for (const Part& part : parts()) {
    table.rows.push_back({link(std::string(part.name), fmt::format("#{}", part.id)),
                          Sentence(part.subject), counted_words(tally(comparison, part.id)),
                          as_sentence(comparison.parts.find(part.id)->second.gain)});
  }
  return table;
}

Banner banner_of(const Comparison& comparison) {
  const char* const axes = " Axes show the quantities of the paper; their ranges are chosen here.";
  if (!comparison.is_reconstruction) {
    return {"mixed",
            std::string("Some points here were imported; the others are reconstructed.") + axes};
  }
  return {
      "reconstruction",
      std::string("The paper's points were never published as numbers. The points here are made "
                  "by recipes from what the paper says in words and numbers. A statement is "
                  "marked \"built in\" if a recipe was made so that it holds: it tests the "
                  "reconstruction, not the paper.") +
          axes};
}

Section section_of(const Part& part, const Comparison& comparison) {
  const PartResult& result = comparison.parts.find(part.id)->second;
  const Tally found = tally(comparison, part.id);
  Section section{std::string(part.id), fmt::format("{}: {}", part.name, part.subject)};
  section.blocks = {Paragraph{say("{} statements agree. ", counted_words(found)) + result.words}};
  append(section.blocks, result.blocks);
  section.blocks.emplace_back(statements_table(part.id, comparison));
  return section;
}

}  // namespace

bool holds(const Statement& statement, const Comparison& comparison) {
  const Finding& found = comparison.findings.at(std::string(statement.id));
  return statement.kind == Kind::number ? agrees(statement, found.value.value()) : found.holds;
}

Tally tally(const Comparison& comparison, std::string_view part) {
  Tally found;
  for (const Statement& statement : statements()) {
    if (!part.empty() && statement.part != part) continue;
    int& count = statement.kind == Kind::obstacle ? found.obstacles
                 : holds(statement, comparison)   ? found.agree
                                                  : found.disagree;
    ++count;
  }
  return found;
}

Document paper_document(const Comparison& comparison) {
  const Tally all = tally(comparison);
  Document page;
  page.title = "The paper, figure by figure";
  page.heading = page.title;
  page.subtitle =
      "Li, X., Dunn, P. F. & Brach, R. M. (1999). Experimental and numerical studies on the normal "
      "impact of microspheres with surfaces. J. Aerosol Sci. 30, 439-449.";
  page.foot = "recoil " + version();
  page.name = "li1999";
  page.foreword = {
      Paragraph{say("{} statements of the paper agree with recoil. ", counted_words(all)) +
                    disagreements(comparison) +
                    say(" {} cannot be compared, and the tables say why.",
                        counted(all.obstacles, "entry", "entries")),
                true},
      banner_of(comparison), overview(comparison)};
  for (const Part& part : parts()) page.sections.push_back(section_of(part, comparison));
  return page;
}

}  // namespace recoil::paper
