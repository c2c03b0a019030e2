#include "report/corrections_document.hpp"

#include <fmt/format.h>

#include <cmath>

#include "report/figures_corrections.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

Cell estimate_cell(double value, double error) {
  if (!(error > 0.0)) return say("{:.4f} (at its bound)", value);
  return say("{:.4f} {+/-} {:.4f}", value, error);
}

Table corrections_table(const CorrectionStudy& study) {
  Table table;
  table.compact = true;
  table.columns = {{"left out"},
                   {"captured"},
                   {say("{e} - truth, {V} < {:g} m/s", slow_impacts)},
                   {"above"},
                   {say("{C_H}"), "s/m"},
                   {say("{C_A}"), "s/m"},
                   {say("{V*} of {} {um}", diameter_text(study.diameter)), "m/s"}};
  table.rows.push_back({"the truth of the recipe",
                        {},
                        "0",
                        "0",
                        say("{:g}", study.C_H),
                        say("{:g}", study.C_A),
                        Number{study.capture_velocity, fixed(3)}});
  for (const CorrectionRow& row : study.rows) {
    std::vector<Cell> cells = {Sentence(words_of(row.left_out)),
                               Number{static_cast<double>(row.captured), fixed(0)},
                               cell_if(number_if(row.error_slow, signed_fixed(4))),
                               cell_if(number_if(row.error_fast, signed_fixed(4)))};
    if (row.usable) {
      cells.insert(cells.end(),
                   {estimate_cell(row.C_H, row.C_H_sd), estimate_cell(row.C_A, row.C_A_sd),
                    Number{row.capture_velocity, fixed(3)}});
    } else {
      cells.insert(cells.end(), {"no usable fit", {}, {}});
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

Sentence change_of_e(const CorrectionRow& base, const CorrectionRow& row) {
  if (!base.error_slow || !row.error_slow || !base.error_fast || !row.error_fast) {
    return say("{e} cannot be compared");
  }
  const double below = *row.error_slow - *base.error_slow;
  const double above = *row.error_fast - *base.error_fast;
  if (std::abs(below) < 5e-5 && std::abs(above) < 5e-5) return say("{e} stays as it is");
  return say("{e} changes by {:+.4f} below {:g} m/s and by {:+.4f} above", below, slow_impacts,
             above);
}

/// How the fit's answer lies to the truth, without an error of its own when it rests on a bound.
Sentence change_of_fit(const CorrectionRow& base, const CorrectionRow& row) {
  if (!base.usable || !row.usable) return "the fit has no usable answer";
  const std::string bound = row.C_A_sd > 0.0 ? "" : ", its bound,";
  const double sd = base.C_A_sd;
  return say(
      "{C_A} becomes {:.4f} s/m{} instead of {:.4f}{}, the capture velocity {:.3f} "
      "instead of {:.3f} m/s",
      row.C_A, bound, base.C_A,
      sd > 0.0 ? say(" ({:+.1f} of its standard errors)", (row.C_A - base.C_A) / sd) : "",
      row.capture_velocity, base.capture_velocity);
}

}  // namespace

std::string words_of(Correction left_out) {
  switch (left_out) {
    case Correction::none_left_out:
      return "all corrections";
    case Correction::probe_plane:
      return "velocities taken at the measuring plane";
    case Correction::second_impacts:
      return "second and further impacts left in";
    case Correction::survivors:
      return "captured spheres not counted";
    case Correction::all_left_out:
      return "none of the three corrections";
  }
  return "";
}

std::string study_words(const CorrectionStudy& study) {
  return fmt::format(
      "{:g} spheres seen to rebound per drop height, {}", study.rebounds_per_velocity,
      study.size_classes > 1 ? fmt::format("in {} classes of size", study.size_classes)
                             : std::string("all sizes in one point"));
}

std::vector<Sentence> correction_words(const CorrectionStudy& study) {
  std::vector<Sentence> sentences;
  const CorrectionRow& base = study.rows.front();
  for (const CorrectionRow& row : study.rows) {
    if (row.left_out == Correction::none_left_out) continue;
    sentences.push_back(say("with {}, {}; {}", words_of(row.left_out), change_of_e(base, row),
                            change_of_fit(base, row)));
  }
  return sentences;
}

std::vector<Block> corrections_blocks(const Analysis& analysis) {
  if (analysis.corrections_outdated) {
    return {
        Paragraph{say("The study of the corrections was made for another fit, dataset or recipe. "
                      "{} makes it again.",
                      code("recoil_study corrections " + analysis.spec.file.string()))}};
  }
  if (analysis.corrections.empty()) return {};
  std::vector<Block> blocks = {
      Paragraph{"The points of this reconstruction come from simulated passages: its recipe says "
                "what the instrument would have recorded, recoil pair makes points of that, and "
                "none of it was measured. Because the truth is known, each correction can be left "
                "out, with the same passages, to see what it does. Where one point averages over "
                "all sizes, the mixture is a further error, which no correction removes; the "
                "second table, with more spheres in narrow size classes, is nearly free of it."}};
  std::size_t index = 0;
  for (const CorrectionStudy& study : analysis.corrections) {
    List changes;
    for (const Sentence& sentence : correction_words(study)) {
      changes.entries.push_back(as_sentence(sentence));
    }
    Section section{"", as_sentence(Sentence(study_words(study)))};
    section.blocks = {corrections_table(study), std::move(changes),
                      Figures{correction_figures(study, ++index)}};
    blocks.emplace_back(std::move(section));
  }
  return blocks;
}

}  // namespace recoil
