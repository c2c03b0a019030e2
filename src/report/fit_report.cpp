#include "report/fit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/error.hpp"
#include "core/program.hpp"
#include "data/text.hpp"
#include "document/html.hpp"
#include "report/comparison_report.hpp"
#include "report/diagnosis_report.hpp"
#include "report/format.hpp"
#include "report/prediction_report.hpp"
#include "report/words_dataset.hpp"
#include "report/words_fit.hpp"
#include "report/words_restitution.hpp"
#include "report/words_validity.hpp"
#include "report/words_verdict.hpp"

namespace recoil {
namespace {

constexpr int picture_width = 560;               // [px]
constexpr int picture_height = 380;              // [px]
constexpr std::ptrdiff_t most_lines = 25;        // of the answer on the terminal
constexpr std::size_t most_rows_of_answer = 12;  // of a table in this answer
constexpr std::size_t fewest_rows_of_answer = 3;

/// "ammonium fluorescein on molybdenum, 60 points"
Sentence subtitle_of(const Analysis& a) {
  return say("{} on {}, {}", a.datasets.front().system.particle.name,
             joined(a.datasets, ", ", [](const Dataset& d) { return d.system.surface.name; }),
             counted(a.fitted.data.points.size(), "point"));
}

/// "Spheres of 4.9 um stick below 0.958 m/s [0.912, 0.984]."
Sentence capture_words(const Analysis& a) {
  for (const CaptureEstimate& capture : a.uncertainty.capture) {
    const Sentence who = diameter_sentence(capture.diameter);
    if (capture.above && capture.below) {
      return say(
          "All impacts up to {:.3g} m/s were captured, none from {:.3g} m/s on: the capture "
          "velocity of {} lies between them.",
          *capture.above, *capture.below, who);
    }
    if (capture.above) {
      return say("All impacts were captured: the capture velocity of {} lies above {:.3g} m/s.",
                 who, *capture.above);
    }
    if (capture.below) {
      return say("No impact was captured: the capture velocity of {} lies below {:.3g} m/s.", who,
                 *capture.below);
    }
  }
  std::vector<Sentence> parts;
  double last = 0.0;  // diameter in the previous part [m]
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    const CaptureEstimate* const capture = reference_capture(a, k);
    if (capture == nullptr) continue;
    Sentence part = with_interval(capture->value, capture->interval, padded(3)).words() + " m/s";
    if (a.datasets.size() > 1) part += " on " + short_name(a.datasets, k);
    parts.push_back(capture->diameter == last
                        ? part
                        : say("of {} {}below {}", diameter_sentence(capture->diameter),
                              parts.empty() ? "stick " : "", part));
    last = capture->diameter;
  }
  if (parts.empty()) return {};
  return say("Spheres {}.", join(parts, ", "));
}

/// A warning about spheres that rebounded below half of their fitted capture velocity.
Sentence contradiction_words(const Analysis& a) {
  for (const CaptureEstimate& capture : a.uncertainty.capture) {
    double slowest = INFINITY;  // rebound
    for (const ImpactPoint& point : a.datasets[capture.dataset].points) {
      if (point.diameter != capture.diameter || point.all_captured()) continue;
      slowest = std::min(slowest, point.incident_velocity);
    }
    if (!capture.found || !(2.0 * slowest < capture.value)) continue;
    return say(
        "Some rebounded at {:.3g} m/s, far below {:.3g} m/s: check the units and the stated "
        "errors.",
        slowest, capture.value);
  }
  return {};
}

/// A warning about damping parameters at their upper bound.
Sentence bound_words(const FitResult& f) {
  const std::vector<std::size_t> held = held_back_dampings(f);
  if (held.empty()) return {};
  return say("{} is at its upper bound: widen the bounds before you interpret the fit.",
             joined(held, ", ", [&](std::size_t j) { return symbol(f.model.slots[j].label()); }));
}

/// The outlying point, and the fit without it.
Sentence odd_point_words(const Analysis& a) {
  if (!a.uncertainty.odd_point) return {};
  const OddPoint& odd = *a.uncertainty.odd_point;
  const Observation& point = a.fitted.data.points[odd.index];
  std::vector<Sentence> values;
  for (std::size_t j = 0; j < odd.without.theta.size(); ++j) {
    const ParameterSlot& slot = odd.without.model.slots[j];
    if (!slot.free) continue;
    values.push_back(
        say("{} = {}", symbol(slot.label()),
            Number{odd.without.theta[j], significant(3), odd.without.std_error[j]}.words()));
  }
  std::string verdict = plain_text(verdict_sentence(odd.without));
  verdict.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(verdict.front())));
  verdict.pop_back();  // the full stop
  return say(
      "Line {}{} ({e} = {:.3g} at {:.3g} m/s) lies {:.1f} standard deviations from the prediction "
      "of the others. Without it {}; {}.",
      point.line, a.datasets.size() > 1 ? " of " + a.datasets[point.dataset].id : std::string(),
      point.restitution, point.velocity, std::abs(odd.residual), verdict, join(values, ", "));
}

/// The name of a quantity with its symbol and unit marked: "C_H", "V*(4.9 um)".
Sentence quantity_words(const std::string& name) {
  const auto um = name.find("um)");
  if (um == std::string::npos) return symbol(name);
  return say("{V*}") + name.substr(2, um - 2) + unit("um") + name.substr(um + 2);
}

/// "In 200 simulated data sets like this one the 95 % interval of C_H contained the truth in 94 %,
/// that of V*(4.9 um) in 93 %."
/// @param below only coverages below this are reported [1]
Sentence own_design_words(const Analysis& a, double below) {
  std::vector<Sentence> parts;
  int datasets = 0;
  for (const OwnCoverage& row : a.own_design) {
    datasets = std::max(datasets, row.datasets);
    if (!(row.share() < below)) continue;
    parts.push_back(
        say(parts.empty() ? "interval of {} contained the truth in {}" : "that of {} in {}",
            quantity_words(row.quantity), percent(row.share())));
  }
  if (parts.empty()) return {};
  return say("In {} simulated data sets like this one the {} {}.", datasets,
             percent(a.uncertainty.options.level), join(parts, ", "));
}

/// e(V) for all sizes, the panel if there is one, otherwise one picture with all sizes; and what
/// the laws get wrong.
Figures answer_figures(const Analysis& a, const std::vector<Figure>& panels) {
  Figures shown = {panels};
  if (panels.size() != 1) {
    shown = {
        {figure_of(restitution_overview(a, picture_width, picture_height), overview_caption(a))}};
  }
  for (Figure& figure : law_error_figures(a)) shown.figures.push_back(std::move(figure));
  return shown;
}

/// All warnings, the most important first, without the noise warning, which the verdict includes.
std::vector<Sentence> warnings_of(const Analysis& a) {
  std::vector<Sentence> warnings = all_warnings(a);
  if (a.fitted.usable && a.fitted.noise_verdict == NoiseVerdict::exceeded) {
    std::erase(warnings, noise_warning(a.fitted));
  }
  return warnings;
}

/// The first warning, and the number of other warnings.
Blocks first_warning(const std::vector<Sentence>& warnings) {
  if (warnings.empty()) return {};
  Sentence text = as_sentence(warnings.front());
  if (warnings.size() > 1) {
    text += say(" ({} more under Warnings and limits.)", warnings.size() - 1);
  }
  return {Banner{"warning", text}};
}

/// One picture for each diameter, and the residuals of each dataset.
Section sizes_section(const Analysis& a, std::vector<Figure> panels) {
  if (panels.size() == 1) panels.clear();  // the answer shows this panel
  for (Figure& figure : residual_figures(a)) panels.push_back(std::move(figure));
  return detail_section("sizes", "Sizes and residuals",
                        {Figures{std::move(panels)}, restitution_table(a.datasets)});
}

Section certainty_section(const Analysis& a) {
  std::vector<Sentence> sentences = {identifiability_words(a.fitted, a.uncertainty)};
  for (std::size_t s = 0; s < a.uncertainty.intervals.size(); ++s) {
    const ParameterSlot& slot = a.fitted.model.slots[s];
    if (!slot.free || slot.is_constant()) continue;
    const Interval& interval = recommended_interval(a.uncertainty.intervals[s]);
    if (interval.available()) continue;
    sentences.push_back(say("{} has no interval: {}",
                            parameter_words(a.fitted.model, s, a.datasets),
                            missing_words(interval)));
  }
  if (a.uncertainty.posterior) {
    sentences.emplace_back(no_posterior_words(*a.uncertainty.posterior));
    sentences.push_back(leave_one_out_words(a));
  }
  for (Sentence& words : budget_sentences(a)) sentences.push_back(std::move(words));
  sentences.push_back(moved_words(a));
  return detail_section("certainty", "Uncertainty",
                        {list_of_sentences(sentences), constants_table(a), posterior_table(a)});
}

Section comparison_section(const Analysis& a) {
  Blocks blocks;
  std::vector<Sentence> sentences;
  for (const TwoPointComparison& comparison : a.uncertainty.two_point) {
    const std::string where =
        a.datasets.size() > 1 ? " on " + short_name(a.datasets, comparison.dataset) : "";
    if (!where.empty()) {
      blocks.emplace_back(two_point_table(a, comparison));
      std::get<Table>(blocks.back()).caption = short_name(a.datasets, comparison.dataset);
    }
    sentences.push_back(say("two points{}, {}: {}", where,
                            words_of(to_string(comparison.result.status)),
                            two_point_words(a.fitted, comparison.dataset, comparison.result)));
    sentences.emplace_back(held_out_words(comparison));
  }
  blocks.emplace_back(list_of_sentences(sentences));
  append(blocks, law_blocks(compared_laws(a.laws, a.datasets)));
  blocks.emplace_back(Figures{capture_figures(a)});
  append(blocks, mixture_blocks(a));
  return detail_section("comparison", "Two points, other laws, other models", std::move(blocks));
}

/// @param sentences the warnings that the answer does not show
Section warnings_section(const Analysis& a, std::vector<Sentence> sentences) {
  for (const std::string& words : exceeded_limits(a.validity, a.datasets)) {
    sentences.push_back("limit of the model: " + words);
  }
  return detail_section("warnings", "Warnings and limits", {list_of_sentences(sentences)});
}

Section inputs_section(const Analysis& a) {
  Blocks blocks = {statistics_table(a), materials_table(a), contact_table(a)};
  List sources;
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    const Dataset& dataset = a.datasets[k];
    for (const std::string& source : dataset.sources) {
      const auto same = std::ranges::find(sources.entries, Sentence(source));
      if (same == sources.entries.end()) sources.entries.emplace_back(source);
    }
    if (averages_over_sizes(a.fitted.model, k)) {
      sources.entries.push_back(as_sentence(Sentence(mixed_sizes_words(*dataset.mixed_sizes))));
    }
  }
  blocks.emplace_back(std::move(sources));
  return detail_section("inputs", "Data, model and method", std::move(blocks));
}

/// The equation of motion as MathML (equation 5 of Li, Dunn & Brach 1999, for the law "ring").
Formula equation_of(const Analysis& a) {
  const bool ring = a.fitted.model.adhesion == AdhesionLaw::ring;
  const std::string adhesion =
      ring ? "<mn>2</mn><mi>π</mi><mi>a</mi><msub><mi>f</mi><mn>0</mn></msub>"
             "<mo>(</mo><mn>1</mn><mo>+</mo><msub><mi>C</mi><mi>A</mi></msub><mi>S</mi><mo>)</mo>"
           : "<msub><mi>F</mi><mi>adhesion</mi></msub>";
  const bool other_loss = dry_loss_mechanism(a.spec.loss) != nullptr;
  const std::string loss =
      other_loss ? "<mo>−</mo><msub><mi>F</mi><mi>loss</mi></msub>"
                 : "<mo>(</mo><mn>1</mn><mo>+</mo><msub><mi>C</mi><mi>H</mi></msub><mover>"
                   "<mi>n</mi><mo>˙</mo></mover><mo>)</mo>";
  const bool adheres = adheres_anywhere(a.fitted.model);
  return {
      "<mrow><mi>m</mi><mover><mi>n</mi><mo>¨</mo></mover><mo>=</mo><mo>−</mo>"
      "<msqrt><mi>r</mi></msqrt><mi>K</mi><msup><mi>n</mi><mrow><mn>3</mn><mo>/</mo>"
      "<mn>2</mn></mrow></msup>" +
          loss + (adheres ? "<mo>+</mo>" + adhesion : "") + "</mrow>",
      fmt::format("m n'' = -sqrt(r) K n^(3/2) {}{}", other_loss ? "- loss" : "(1 + C_H n')",
                  adheres ? " + adhesion" : "")};
}

/// What a reader needs who has only this page: the equation, the data, the program, how to cite.
Section citation_section(const Analysis& a) {
  const auto captured = std::ranges::count_if(a.fitted.data.points, &Observation::censored);
  std::vector<std::pair<Sentence, Cell>> entries = {
      {"program", Sentence("recoil " + version())},
      {"date", Sentence(today())},
      {"points", say("{}, {} with captured spheres only", a.fitted.data.points.size(), captured)}};
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    const ImpactSystem& system = a.datasets[k].system;
    entries.emplace_back(say("data {}", a.datasets[k].id),
                         Sentence("SHA-256 " + a.datasets[k].sha256));
    if (!adheres_anywhere(a.fitted.model)) continue;
    entries.emplace_back(
        say("{f0} of {}", a.datasets[k].id),
        a.fitted.model.slots[a.fitted.model.slot_adhesion[k]].free ? Sentence("fitted")
        : system.adhesion_force_f0 ? Sentence("stated with the data")
        : system.adhesion_energy   ? Sentence("from the stated adhesion energy")
        : system.particle.surface_energy && system.surface.surface_energy
            ? Sentence("from the stated surface energies (equations 6 to 12)")
            : Sentence("from the elastic constants by Gilman's estimate (equations 6 to 12)"));
  }
  entries.emplace_back(
      "to cite",
      say("Li, X., Dunn, P. F. & Brach, R. M. (1999). J. Aerosol Sci. 30, 439-449 (the model); "
          "the sources below (data); recoil {} (analysis).",
          version()));
  return detail_section(
      "citation", "Equation, data and citation",
      {equation_of(a), Paragraph{equation_words(a.fitted.model.adhesion)}, items(entries)});
}

Section next_section(const Analysis& a) {
  if (a.spec.file.empty()) return {};
  const std::string file = a.spec.file.generic_string();
  return shown_section("next", "",
                       {Paragraph{say("Next: {}; with pictures: {}; all details: {}.",
                                      code("recoil diagnose " + file),
                                      code("recoil report " + file), code("--verbose"))}});
}

/// `section` with tables of at most `rows` rows. The last row states how many rows are omitted.
Section shortened(Section section, std::size_t rows) {
  for (Block& block : section.blocks) {
    auto* const table = std::get_if<Table>(&block.content());
    if (table == nullptr || table->rows.size() <= rows) continue;
    const std::size_t more = table->rows.size() - rows + 1;
    table->rows.resize(rows - 1);
    table->rows.push_back({say("{} more", more)});
  }
  return section;
}

}  // namespace

std::vector<Section> fit_sections(const Analysis& a, const Diagnosis* diagnosis,
                                  const std::string& diagnosis_page) {
  Section answer{"answer", a.spec.id, subtitle_of(a)};
  std::vector<Sentence> warnings = warnings_of(a);
  if (!a.fitted.usable) {
    answer.blocks = {Paragraph{"The fit failed: " + a.fitted.failure}};
    return {answer, warnings_section(a, warnings), inputs_section(a)};
  }
  std::vector<Figure> panels = restitution_figures(a);
  std::vector<Sentence> leads = {bound_words(a.fitted), verdict_sentence(a.fitted),
                                 capture_words(a),      contradiction_words(a),
                                 loss_words(a),         odd_point_words(a)};
  std::erase(leads, Sentence());
  answer.blocks = {Paragraph{join(leads, " "), true},
                   Paragraph{join(restitution_sentences(a.datasets, a.fitted), " ")},
                   Paragraph{join(friction_sentences(a.datasets), " ")}};
  append(answer.blocks, data_banners(a.datasets));
  std::vector<Section> sections = {std::move(answer)};
  sections.push_back(shown_section("picture", "", {answer_figures(a, panels)}));
  sections.push_back(shown_section("capture", "Capture velocity", {capture_table(a)}));
  sections.push_back(shown_section("parameters", "Parameters", {parameters_table(a)}));
  if (a.datasets.size() == 1 && !a.uncertainty.two_point.empty()) {
    sections.push_back(shown_section("calibrations", "Two points and all points",
                                     {two_point_table(a, a.uncertainty.two_point.front())}));
  }
  Section causes;  // on this page, too, because a page may travel alone
  if (diagnosis != nullptr) {
    if (!diagnosis_page.empty()) causes = closest_causes(*diagnosis);
    sections.push_back(diagnosis_summary(*diagnosis, empty(causes) ? "" : "#" + causes.id));
  }
  sections.push_back(shown_section("warning", "", first_warning(warnings)));
  sections.push_back(sizes_section(a, std::move(panels)));
  sections.push_back(certainty_section(a));
  sections.push_back(comparison_section(a));
  if (!warnings.empty()) warnings.erase(warnings.begin());  // the answer shows it
  sections.push_back(warnings_section(a, std::move(warnings)));
  sections.push_back(std::move(causes));
  sections.push_back(citation_section(a));
  sections.push_back(inputs_section(a));
  return sections;
}

Document fit_document(const Analysis& a, const Diagnosis* diagnosis,
                      const std::string& diagnosis_page) {
  if (!a.fitted.usable) {
    throw ComputationError(
        fmt::format("there is no page without a usable fit: {}", a.fitted.failure));
  }
  const std::string& title = a.datasets.front().title;
  Document page = page_of(a.datasets.size() == 1 && !title.empty() ? title : a.spec.id, a.spec.id,
                          fit_sections(a, diagnosis, diagnosis_page));
  page.subtitle = subtitle_of(a);
  page.script = explore_script();
  const Sentence rates = own_design_words(a, INFINITY);
  if (!rates.empty()) page.sections.front().blocks.emplace_back(Paragraph{rates});
  return page;
}

std::string fit_text(const Analysis& a, Importance least, std::size_t columns) {
  std::vector<Section> answer, details;
  for (Section& section : fit_sections(a)) {
    const bool detail = section.importance == Importance::detail;
    if (!detail && !answer.empty()) section.title = {};  // the headings of the tables suffice
    (detail ? details : answer).push_back(std::move(section));
  }
  constexpr double far_below = 0.05;  // a coverage this much below the level is reported
  const Sentence rates = own_design_words(a, a.uncertainty.options.level - far_below);
  if (!rates.empty()) answer.front().blocks.emplace_back(Paragraph{rates});
  answer.push_back(next_section(a));
  if (least == Importance::detail) {
    return terminal_text(answer, least, columns) + terminal_text(details, least, columns);
  }
  std::string text;
  for (std::size_t rows = most_rows_of_answer; rows >= fewest_rows_of_answer; --rows) {
    std::vector<Section> shorter;
    for (const Section& section : answer) shorter.push_back(shortened(section, rows));
    text = terminal_text(shorter, least, columns);
    if (std::ranges::count(text, '\n') <= most_lines) break;
  }
  return text;
}

std::string fit_html(const Analysis& a, const Diagnosis* diagnosis,
                     const std::string& diagnosis_page) {
  return html_page(fit_document(a, diagnosis, diagnosis_page));
}

}  // namespace recoil
