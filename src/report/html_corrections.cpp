#include <fmt/format.h>

#include <cmath>

#include "report/corrections.hpp"
#include "report/format.hpp"
#include "report/html_page.hpp"

namespace recoil {
namespace {

std::string signed_cell(const std::optional<double>& value) {
  return value ? fmt::format("{:+.4f}", *value) : "–";
}

std::string with_error(double value, double error) {
  if (!(error > 0.0)) return fmt::format("{:.4f} (at its bound)", value);
  return fmt::format("{:.4f} ± {:.4f}", value, error);
}

std::string table_of(const CorrectionStudy& study) {
  HtmlTable table;
  table.compact = true;
  table.head = {"",
                "captured",
                fmt::format("<i>e</i> − truth, <i>V</i> &lt; {:g} m/s", slow_impacts),
                "above",
                "C<sub>H</sub> [s/m]",
                "C<sub>A</sub> [s/m]",
                fmt::format("<i>V</i>* of {} µm [m/s]", diameter_text(study.diameter))};
  table.rows.push_back({"the truth of the recipe", "", "0", "0", fmt::format("{:g}", study.C_H),
                        fmt::format("{:g}", study.C_A),
                        fmt::format("{:.3f}", study.capture_velocity)});
  for (const CorrectionRow& row : study.rows) {
    std::vector<std::string> cells = {escape_html(words_of(row.left_out)),
                                      fmt::format("{}", row.captured), signed_cell(row.error_slow),
                                      signed_cell(row.error_fast)};
    if (row.usable) {
      cells.insert(cells.end(), {with_error(row.C_H, row.C_H_sd), with_error(row.C_A, row.C_A_sd),
                                 fmt::format("{:.3f}", row.capture_velocity)});
    } else {
      cells.insert(cells.end(), {"no usable fit", "–", "–"});
    }
    table.rows.push_back(std::move(cells));
  }
  return table_html(table);
}

std::string change_of_e(const CorrectionRow& base, const CorrectionRow& row) {
  if (!base.error_slow || !row.error_slow || !base.error_fast || !row.error_fast) {
    return "e cannot be compared";
  }
  const double below = *row.error_slow - *base.error_slow;
  const double above = *row.error_fast - *base.error_fast;
  if (std::abs(below) < 5e-5 && std::abs(above) < 5e-5) return "e stays as it is";
  return fmt::format("e changes by {:+.4f} below {:g} m/s and by {:+.4f} above", below,
                     slow_impacts, above);
}

/// How the fit's answer lies to the truth, without an error of its own when it rests on a bound.
std::string change_of_fit(const CorrectionRow& base, const CorrectionRow& row) {
  if (!base.usable || !row.usable) return "the fit has no usable answer";
  const std::string bound = row.C_A_sd > 0.0 ? "" : ", its bound,";
  const double sd = base.C_A_sd;
  return fmt::format(
      "C_A becomes {:.4f} s/m{} instead of {:.4f}{}, the capture velocity {:.3f} "
      "instead of {:.3f} m/s",
      row.C_A, bound, base.C_A,
      sd > 0.0 ? fmt::format(" ({:+.1f} of its standard errors)", (row.C_A - base.C_A) / sd) : "",
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

std::vector<std::string> correction_words(const CorrectionStudy& study) {
  std::vector<std::string> sentences;
  const CorrectionRow& base = study.rows.front();
  for (const CorrectionRow& row : study.rows) {
    if (row.left_out == Correction::none_left_out) continue;
    sentences.push_back(fmt::format("with {}, {}; {}", words_of(row.left_out),
                                    change_of_e(base, row), change_of_fit(base, row)));
  }
  return sentences;
}

std::string corrections_section(const Analysis& analysis) {
  if (analysis.corrections_outdated) {
    return fmt::format(
        "<p>What each correction does was studied for another fit, dataset or recipe than these. "
        "<code>recoil_study corrections {}</code> studies it again.</p>\n",
        escape_html(analysis.spec.file.string()));
  }
  if (analysis.corrections.empty()) return "";
  std::string out =
      "<p>" +
      prose_html(
          "The points of this reconstruction come from simulated events through the tool's own "
          "pairing: its recipe says what the instrument would have recorded, recoil pair makes the "
          "points, and none of it was measured. Because the truth is known, each correction on "
          "this way can be left out to see what it does, with the same events. Where all sizes "
          "stand "
          "in one point their mixture is a further error, which no correction takes away; the "
          "second table, with more spheres in narrow classes of size, is nearly free of it.") +
      "</p>\n";
  std::size_t index = 0;
  for (const CorrectionStudy& study : analysis.corrections) {
    out += fmt::format("<h3>{}</h3>\n", escape_html(as_sentence(study_words(study))));
    out += table_of(study) + "<ul>\n";
    for (const std::string& sentence : correction_words(study)) {
      out += fmt::format("<li>{}</li>\n", prose_html(as_sentence(sentence)));
    }
    out += "</ul>\n" + figures_html(correction_figures(study, ++index));
  }
  return out;
}

}  // namespace recoil
