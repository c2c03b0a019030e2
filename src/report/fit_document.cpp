#include "report/fit_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/program.hpp"
#include "document/html.hpp"
#include "document/terminal.hpp"
#include "plot/draw.hpp"
#include "plot/plot.hpp"
#include "report/corrections_document.hpp"
#include "report/explore.hpp"
#include "report/figures.hpp"
#include "report/figures_budget.hpp"
#include "report/figures_corner.hpp"
#include "report/figures_intervals.hpp"
#include "report/figures_overview.hpp"
#include "report/figures_physics.hpp"
#include "report/figures_statistics.hpp"
#include "report/figures_two_point.hpp"
#include "report/fit_tables.hpp"
#include "report/format.hpp"
#include "report/law_comparison.hpp"
#include "report/materials_tables.hpp"
#include "report/posterior_report.hpp"
#include "report/prediction_document.hpp"
#include "report/words_dataset.hpp"
#include "report/words_identifiability.hpp"
#include "report/words_intervals.hpp"
#include "report/words_materials.hpp"
#include "report/words_two_point.hpp"
#include "report/words_validity.hpp"

namespace recoil {
namespace {

std::string title_of(const Analysis& a) {
  if (a.datasets.size() == 1 && !a.datasets.front().title.empty()) return a.datasets.front().title;
  return a.spec.id;
}

std::string subtitle_of(const Analysis& a) {
  std::vector<std::string> ids;
  for (const Dataset& dataset : a.datasets) ids.push_back(dataset.id);
  return fmt::format("Fit {} of {}", a.spec.id, fmt::join(ids, ", "));
}

Sentence estimate_words(const Analysis& a, std::size_t s) {
  const ParameterSlot& slot = a.fitted.model.slots[s];
  const Interval interval = recommended_interval(intervals_of(a, s));
  Sentence words = say("{} = {}", symbol(slot.label()), number(a.fitted.theta[s], 3)) +
                   unit_after_number(slot.parameter->unit);
  if (interval.available()) {
    words += say(" ({} to {})", number(*interval.lower, 3), number(*interval.upper, 3));
  }
  return words;
}

/// What the p-value of the misfit says of the model.
const char* quality_words(double p) {
  if (p > 0.99) return "the points scatter less than their stated deviations";
  if (p < 0.01) return "the model does not describe these points within their stated deviations";
  if (p < 0.05) return "the model hardly describes the points within their deviations";
  return "the model describes the points within their stated deviations";
}

Sentence fit_quality_words(const Analysis& a) {
  const FitResult& f = a.fitted;
  if (!f.data.sd_stated || f.dof <= 0) {
    return say("The rms residual of the fit is {} in {e}.", number(f.rmse, 2));
  }
  return say(
      "Chi-square is {} on {} degrees of freedom ({} each, {p} {}): {}. The rms residual is {} in "
      "{e}.",
      number(f.chi2, 4), f.dof, number(f.chi2 / f.dof, 3),
      f.p_value < 1e-6 ? p_value_text(f.p_value) : "= " + p_value_text(f.p_value),
      quality_words(f.p_value), number(f.rmse, 2));
}

Sentence calibration_words(const Analysis& a) {
  const TwoPointComparison* comparison = two_point_of(a, 0);
  if (comparison == nullptr) return {};
  const TwoPointResult& two = comparison->result;
  const std::string where =
      a.datasets.size() > 1 ? fmt::format(" on {}", a.datasets.front().id) : std::string();
  if (two.status != TwoPointStatus::converged) {
    return say(" The two-point calibration of the paper{} gave no answer ({}).", where,
               words_of(to_string(two.status)));
  }
  Sentence words =
      say(" The two-point calibration of the paper{} gives {C_H} = {} and {C_A} = {} s/m with an "
          "rms residual of {} over the same points, where the full fit has {}",
          where, number(two.theta[a.fitted.model.slot_C_H[0]], 3),
          number(two.theta[a.fitted.model.slot_C_A[0]], 3), number(comparison->rmse, 2),
          number(comparison->full_rmse, 2));
  if (comparison->held_out_rmse && comparison->full_held_out_rmse) {
    words += say("; fitted to one diameter and judged on the others, {} against {}",
                 number(*comparison->held_out_rmse, 2), number(*comparison->full_held_out_rmse, 2));
  }
  return words + ".";
}

List list_of_sentences(const std::vector<Sentence>& sentences) {
  List list;
  for (const Sentence& sentence : sentences) list.entries.push_back(as_sentence(sentence));
  return list;
}

void add_paragraphs(std::vector<Block>& blocks, const std::vector<Sentence>& sentences) {
  for (const Sentence& sentence : sentences) {
    if (!sentence.empty()) blocks.emplace_back(Paragraph{as_sentence(sentence)});
  }
}

Section provenance_section(const Analysis& a) {
  std::vector<std::pair<Sentence, Cell>> entries = {
      {"fit", Sentence(a.spec.file.empty() ? a.spec.id : a.spec.file.generic_string())},
      {"recoil", Sentence(version())}};
  for (const Dataset& dataset : a.datasets) {
    entries.emplace_back("dataset", say("{} ({}, {} points)", dataset.id,
                                        to_string(dataset.provenance), dataset.points.size()));
    if (!dataset.title.empty()) entries.emplace_back("  title", Sentence(dataset.title));
    if (!dataset.sha256.empty()) entries.emplace_back("  sha256", Sentence(dataset.sha256));
  }
  Section section{"provenance", "Provenance"};
  section.blocks = {items(entries)};
  append(section.blocks, provenance_banners(a.datasets));
  return section;
}

Section model_section(const Analysis& a) {
  Section section{"model", "Model"};
  std::vector<std::pair<Sentence, Cell>> entries = {
      {"adhesion damping",
       say("phase \"{}\", always dissipative", to_string(a.fitted.model.phase))},
      {"mechanisms", a.spec.mechanisms.empty()
                         ? Sentence("none")
                         : Sentence(fmt::format("{}", fmt::join(a.spec.mechanisms, ", ")))}};
  for (std::size_t d = 0; d < a.datasets.size(); ++d) {
    if (!averages_over_sizes(a.fitted.model, d)) continue;
    const std::string of = a.datasets.size() > 1 ? a.datasets[d].id + ": " : "";
    entries.emplace_back("sizes", Sentence(of + mixed_sizes_words(*a.datasets[d].mixed_sizes)));
  }
  section.blocks = {Paragraph{say(traits(a.fitted.model.adhesion).description)}, items(entries)};
  for (std::size_t k = 0; k < a.datasets.size() && k < a.fitted.model.contacts.size(); ++k) {
    section.blocks.emplace_back(contact_table(a, k));
  }
  List contradictions;
  for (const Sentence& sentence : all_contradictions(a)) {
    contradictions.entries.push_back(say("contradiction: {}", sentence));
  }
  section.blocks.emplace_back(contradictions);
  return section;
}

Section statistics_section(const Analysis& a) {
  return {"goodness", "Fit Statistics", {}, {statistics_table(a)}};
}

/// @param every_interval all kinds of intervals beside the recommended one
Section parameters_section(const Analysis& a, bool every_interval) {
  Section section{"parameters", "Variables"};
  section.blocks = {parameters_table(a), parameter_remarks(a)};
  add_paragraphs(section.blocks, recommendations(a));
  add_paragraphs(section.blocks, disagreements(a));
  if (!every_interval) return section;
  section.blocks.emplace_back(intervals_table(a));
  section.blocks.emplace_back(Details{"Why some intervals are missing", {missing_intervals(a)}});
  return section;
}

/// What the errors of the materials make of the fit; without blocks where there are none.
Section materials_section(const Analysis& a) {
  Section section{"materials", "Errors of the Materials"};
  if (a.fitted.model.constants.empty()) return section;
  section.blocks = {constants_table(a)};
  add_paragraphs(section.blocks, {moved_words(a)});
  section.blocks.emplace_back(conditional_table(a));
  add_paragraphs(section.blocks, {conditional_words(a)});
  section.blocks.emplace_back(budget_table(a));
  section.blocks.emplace_back(list_of_sentences(budget_sentences(a)));
  return section;
}

/// The sampled posterior; without blocks where it was not asked for.
Section posterior_section(const Analysis& a) {
  Section section{"posterior", "Posterior"};
  if (!a.uncertainty.posterior) return section;
  section.blocks = {posterior_table(a)};
  add_paragraphs(section.blocks, {no_posterior_words(*a.uncertainty.posterior)});
  return section;
}

Section two_point_section(const Analysis& a, std::string title) {
  Section section{"comparison", std::move(title)};
  for (const TwoPointComparison& comparison : a.uncertainty.two_point) {
    const TwoPointResult& two = comparison.result;
    section.blocks.emplace_back(two_point_table(a, comparison));
    section.blocks.emplace_back(Paragraph{as_sentence(
        say("Two-point iteration: {} ({} iterations): {}", words_of(to_string(two.status)),
            two.iterations, two_point_words(a.fitted, comparison.dataset, two)))});
    if (comparison.full_held_out_rmse) {
      section.blocks.emplace_back(
          Paragraph{"For the held-out diameters, the full fit used the points of the calibration "
                    "diameter only."});
    }
    add_paragraphs(section.blocks, {held_out_words(comparison)});
  }
  return section;
}

Section bootstrap_section(const Analysis& a) {
  const BootstrapResult& bootstrap = a.uncertainty.bootstrap;
  Section section{"bootstrap", "Bootstrap"};
  if (bootstrap.replicates == 0) {
    section.blocks = {Paragraph{"Not run: no replicates were asked for."}};
    return section;
  }
  section.blocks = {bootstrap_table(a)};
  add_paragraphs(section.blocks, {scheme_words(bootstrap), chance_words(bootstrap),
                                  failures_words(bootstrap, a.fitted.data)});
  return section;
}

Section identifiability_section(const Analysis& a) {
  const Identifiability& found = a.uncertainty.identifiability;
  Section section{"identifiability", "Identifiability"};
  if (found.assessed()) {
    section.blocks = {
        Paragraph{strong(plain_text(as_sentence(words_of(to_string(found.verdict))))) + " " +
                  as_sentence(identifiability_words(a.fitted, a.uncertainty))}};
  }
  return section;
}

Figures together(std::vector<std::vector<Figure>> groups) {
  Figures all;
  for (std::vector<Figure>& group : groups) {
    for (Figure& figure : group) all.figures.push_back(std::move(figure));
  }
  return all;
}

Section inputs_section(const Analysis& a) {
  Section section{"inputs", "Inputs"};
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    const Dataset& dataset = a.datasets[k];
    List sources;
    for (const std::string& source : dataset.sources) sources.entries.emplace_back(source);
    Section of_dataset{"", dataset.id};
    of_dataset.blocks = {Paragraph{as_sentence(Sentence(dataset.title)) +
                                   say(" {} points, {}. SHA-256 ", dataset.points.size(),
                                       to_string(dataset.provenance)) +
                                   code(dataset.sha256)},
                         sources, materials_table(a, k), contact_table(a, k)};
    section.blocks.emplace_back(std::move(of_dataset));
  }
  Table options = options_table(a);
  options.caption = "The fit";
  section.blocks.emplace_back(std::move(options));
  return section;
}

std::vector<Section> figure_sections(const Analysis& a, std::vector<Block> diagnosis) {
  Section two_points{"two-points", "Two points against all"};
  if (!a.uncertainty.two_point.empty()) {
    two_points.blocks = {together({two_point_figures(a)})};
  }
  return {{"restitution", "Restitution against velocity", {}, {together({restitution_figures(a)})}},
          {"residuals",
           "Residuals",
           {},
           {together({residual_velocity_figures(a), residual_diameter_figures(a)})}},
          {"diagnosis", "What the model gets wrong", {}, std::move(diagnosis)},
          {"distribution",
           "How sure the parameters are",
           {},
           {together({interval_figures(a), bootstrap_figures(a), corner_figures(a)})}},
          std::move(two_points),
          {"forces",
           "Adhesion and contact forces",
           {},
           {together({adhesion_force_figures(a), force_history_figures(a)})}},
          {"corrections", "From passages to points", {}, corrections_blocks(a)},
          {"mixture", "A mixture of sizes", {}, mixture_blocks(a)},
          {"capture-models",
           "Capture velocity by this and other models",
           {},
           capture_comparison_blocks(a)}};
}

}  // namespace

Sentence fit_summary(const Analysis& a) {
  double smallest = INFINITY;
  double largest = 0.0;
  std::vector<double> diameters;
  for (const auto& point : a.fitted.data.points) {
    smallest = std::min(smallest, point.velocity);
    largest = std::max(largest, point.velocity);
    diameters.push_back(point.diameter);
  }
  std::sort(diameters.begin(), diameters.end());
  diameters.erase(std::unique(diameters.begin(), diameters.end()), diameters.end());
  const SizeUnit sizes = size_unit(diameters);
  std::string size = diameters.empty() ? std::string() : size_text(diameters.front(), sizes);
  if (diameters.size() > 1) size += " to " + size_text(diameters.back(), sizes);
  std::vector<std::string> surfaces;
  for (const Dataset& dataset : a.datasets) surfaces.push_back(dataset.system.surface.name);
  std::vector<Sentence> estimates;
  for (std::size_t s = 0; s < a.fitted.model.slots.size(); ++s) {
    if (a.fitted.model.slots[s].free) estimates.push_back(estimate_words(a, s));
  }
  return say("{} points of {} spheres, {} {} in diameter, hitting {} at {} to {} m/s. ",
             a.fitted.data.points.size(), a.datasets.front().system.particle.name, size, sizes.sign,
             fmt::format("{}", fmt::join(surfaces, ", ")), number(smallest, 3),
             number(largest, 3)) +
         say("A least-squares fit to all of them gives {}, with {} intervals in brackets. ",
             join(estimates, ", "), percent(a.uncertainty.options.level)) +
         fit_quality_words(a) + calibration_words(a);
}

std::vector<Block> provenance_banners(const std::vector<Dataset>& datasets) {
  std::vector<Block> banners;
  for (const auto& [label, sentence] : provenances(datasets)) {
    banners.emplace_back(Banner{label, sentence});
  }
  return banners;
}

Glossary glossary(const Analysis& a) {
  Glossary terms;
  terms.entries = {
      {say("{e}"),
       say("Restitution: rebound velocity divided by incident velocity, both normal to the surface "
           "and at the surface. {e} = 1 loses nothing, {e} = 0 is capture.")},
      {say("{C_H}"),
       "Damping of the Hertz force [s/m]: the contact pushes back harder while the "
       "sphere approaches than while it leaves."},
      {say("{C_A}"), "Damping of the adhesion force [s/m]; always takes energy out."},
      {say("{f0}"), say("Adhesion force per length of the contact's edge [N/m]; the edge is a ring "
                        "of length 2 pi {a}, {a} the contact radius.")},
      {say("{W_A}"), say("Energy of adhesion per area of contact [{J/m2}].")},
      {say("{V_a}"),
       "The velocity at which adhesion and inertia balance; it sets the scale of capture."},
      {say("{V*}"), "Capture velocity: the largest incident velocity at which the sphere stays."},
      {"Two points",
       say("The calibration of Li, Dunn & Brach (1999): the fastest point gives {C_H}, the slowest "
           "gives {C_A}, in turn until nothing changes.")},
      {"Weighted residual", "Measured minus fitted, in standard deviations of the point."},
      {"Leverage", "How much a point pulls the fit towards itself, from 0 to 1."},
      {"Wald interval", "Estimate plus and minus a multiple of its standard error."},
      {"Profile interval",
       "All values for which the best fit with that value held is not significantly worse."},
      {"Percentile and BCa intervals",
       "Quantiles of the bootstrap estimates, plain, and corrected for bias and skewness."},
      {"Bootstrap", "The whole fit repeated on resampled data, to see how much the answer moves."},
      {"p-value",
       "The probability of a chi-square at least this large if the model and the stated deviations "
       "are right."}};
  for (const auto& [label, sentence] : provenances(a.datasets)) {
    terms.entries.emplace_back(label, sentence);
  }
  return terms;
}

Section validity_section(const Analysis& a, const char* title) {
  const std::vector<std::string> passed = passed_limits(a.validity, a.datasets);
  return {"validity", title, {}, {list_of_sentences({passed.begin(), passed.end()})}};
}

std::vector<Section> fit_sections(const Analysis& a) {
  std::vector<Section> sections = {provenance_section(a), model_section(a)};
  if (a.fitted.usable) {
    sections.push_back(statistics_section(a));
    sections.push_back(parameters_section(a, false));
    if (!a.fitted.model.constants.empty()) sections.push_back(materials_section(a));
    if (a.uncertainty.posterior) sections.push_back(posterior_section(a));
    sections.push_back({"correlations", "Correlations", {}, {correlations_table(a)}});
    sections.push_back({"capture", "Capture Velocity", {}, {capture_table(a)}});
    sections.push_back(two_point_section(a, "Two Points Against All"));
    sections.push_back(bootstrap_section(a));
    sections.push_back(identifiability_section(a));
    sections.push_back(validity_section(a, "Limits of the Model"));
  } else {
    sections.push_back({"failure", "Failure", {}, {Paragraph{a.fitted.failure}}});
  }
  sections.push_back({"starts", "Starts", {}, {starts_table(a)}});
  sections.push_back({"warnings", "Warnings", {}, {list_of_sentences(all_warnings(a))}});
  return sections;
}

Document fit_document(const Analysis& a, std::vector<Block> diagnosis) {
  if (!a.fitted.usable) {
    throw ComputationError(
        fmt::format("there is no page without a usable fit: {}", a.fitted.failure));
  }
  Document page;
  page.title = title_of(a);
  page.heading = page.title;
  page.subtitle = subtitle_of(a);
  page.foot = "recoil " + version();
  page.name = a.spec.id;
  page.script = explore_script();
  page.foreword = provenance_banners(a.datasets);
  page.foreword.emplace_back(Paragraph{fit_summary(a), true});
  page.sections = {{"warnings", "Warnings", {}, {list_of_sentences(all_warnings(a))}}};
  for (Section& section : figure_sections(a, std::move(diagnosis))) {
    page.sections.push_back(std::move(section));
  }
  Section parameters = parameters_section(a, true);
  parameters.blocks.emplace_back(correlations_table(a));
  parameters.title = "Parameters";
  page.sections.push_back(std::move(parameters));
  if (Section materials = materials_section(a); !materials.blocks.empty()) {
    materials.title = "Errors of the materials";
    materials.blocks.emplace_back(together({budget_figures(a)}));
    page.sections.push_back(std::move(materials));
  }
  if (a.uncertainty.posterior) page.sections.push_back(posterior_section(a));
  Section statistics = statistics_section(a);
  statistics.title = "Fit statistics";
  page.sections.push_back(std::move(statistics));
  Table capture = capture_table(a);
  capture.caption = "Capture velocity: slower spheres stay on the surface";
  page.sections.push_back({"capture", "Capture velocity", {}, {std::move(capture)}});
  if (!a.laws.empty()) {
    page.sections.push_back(laws_section(compared_laws(a.laws, a.datasets)));
  }
  page.sections.push_back(identifiability_section(a));
  page.sections.push_back(
      validity_section(a, "Where the points are outside the limits of the model"));
  page.sections.push_back(two_point_section(a, "Two points against all, in numbers"));
  page.sections.push_back(bootstrap_section(a));
  page.sections.push_back(inputs_section(a));
  page.sections.push_back({"contradictions",
                           "Inputs that contradict each other",
                           {},
                           {list_of_sentences(all_contradictions(a))}});
  page.sections.push_back({"starts", "Starts", {}, {starts_table(a)}});
  page.sections.push_back({"points", "Every point", {}, {points_table(a)}});
  page.sections.push_back({"glossary", "Glossary", {}, {glossary(a)}});
  return page;
}

std::string text_report(const Analysis& analysis) { return terminal_text(fit_sections(analysis)); }

std::string html_report(const Analysis& analysis, std::vector<Block> diagnosis) {
  return html_page(fit_document(analysis, std::move(diagnosis)));
}

std::string thumbnail(const Analysis& analysis) {
  return plot::draw_svg(restitution_overview(analysis, analysis.spec.id));
}

std::string thumbnail_csv(const Analysis& analysis) {
  return plot::csv_of(restitution_overview(analysis, analysis.spec.id));
}

}  // namespace recoil
