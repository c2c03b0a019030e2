#include "validation/studies/reconstruction_document.hpp"

#include <algorithm>

#include "document/terminal.hpp"

namespace recoil {
namespace {

Sentence file_words(const ReconstructionResult& result) {
  if (result.written) return "points.csv: written";
  if (result.identical) return "points.csv: byte for byte what the recipe makes";
  return say("points.csv: NOT what the recipe makes ({})", result.difference);
}

}  // namespace

Table facts_table(const ReconstructionResult& result) {
  Table table;
  table.columns = {{"fact"}, {"holds", "", true}, {"as published", "", true}, {"found", "", true}};
  for (const FactCheck& fact : result.facts) {
    table.rows.push_back({Sentence(fact.id), fact.holds ? "yes" : "NO",
                          say("{} [{}]", fact.statement, fact.source), Sentence(fact.found)});
  }
  return table;
}

std::vector<Section> reconstruction_sections(const ReconstructionResult& result) {
  Section made{"reconstruction", "Reconstruction",
               say("{}: {} points, seed {}", result.id, result.points, result.seed)};
  made.blocks = {Paragraph{
      "No point of it was measured: a committed recipe makes the points from the facts below."}};
  if (result.from_events) {
    made.blocks.emplace_back(
        Paragraph{"The points come from simulated passages, paired by recoil pair."});
  }
  made.blocks.emplace_back(Paragraph{file_words(result)});
  List assumptions;
  for (const std::string& assumption : result.assumptions) {
    assumptions.entries.emplace_back(assumption);
  }
  const auto held = std::count_if(result.facts.begin(), result.facts.end(),
                                  [](const FactCheck& fact) { return fact.holds; });
  return {
      std::move(made),
      {"facts", "Facts", say("{} of {} hold", held, result.facts.size()), {facts_table(result)}},
      {"assumptions", "Assumptions", "not published, chosen here", {std::move(assumptions)}}};
}

std::string reconstruction_text(const ReconstructionResult& result) {
  return terminal_text(reconstruction_sections(result));
}

}  // namespace recoil
