#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "plot/draw.hpp"
#include "report/corrections.hpp"
#include "report/figures.hpp"
#include "report/format.hpp"
#include "report/html_page.hpp"
#include "report/html_tables.hpp"
#include "report/pair_words.hpp"
#include "report/prediction.hpp"

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

std::string estimate_words(const Analysis& a, std::size_t s) {
  const ParameterSlot& slot = a.fitted.model.slots[s];
  const Interval interval = recommended_interval(intervals_of(a, s));
  std::string text =
      fmt::format("{} = {} {}", slot.label(), number(a.fitted.theta[s], 3), slot.unit);
  if (interval.available()) {
    text += fmt::format(" ({} to {})", number(*interval.lower, 3), number(*interval.upper, 3));
  }
  return text;
}

std::string fit_quality_words(const Analysis& a) {
  const FitResult& f = a.fitted;
  if (!a.data.sd_stated || f.dof <= 0) {
    return fmt::format("The fit misses the points by {} in e (root mean square).",
                       number(f.rmse, 2));
  }
  const double reduced = f.chi2 / f.dof;
  const char* verdict = "the model describes the points within their stated deviations";
  if (f.p_value < 0.05) verdict = "the model hardly describes the points within their deviations";
  if (f.p_value < 0.01) {
    verdict = "the model does not describe these points within their stated deviations";
  }
  if (f.p_value > 0.99) verdict = "the points scatter less than their stated deviations";
  return fmt::format(
      "Chi-square is {} on {} degrees of freedom ({} each, p {}): {}. The root mean square miss is "
      "{} in e.",
      number(f.chi2, 4), f.dof, number(reduced, 3),
      f.p_value < 1e-6 ? p_value_text(f.p_value) : "= " + p_value_text(f.p_value), verdict,
      number(f.rmse, 2));
}

std::string two_point_words(const Analysis& a) {
  const TwoPointComparison* comparison = two_point_of(a, 0);
  if (comparison == nullptr) return "";
  const TwoPointResult& two = comparison->result;
  const std::string where =
      a.datasets.size() > 1 ? fmt::format(" on {}", a.datasets.front().id) : std::string();
  if (two.status != TwoPointStatus::converged) {
    return fmt::format(" The two-point calibration of the paper{} gave no answer ({}).", where,
                       words_of(to_string(two.status)));
  }
  const std::size_t H = a.fitted.model.slot_C_H[0];
  const std::size_t A = a.fitted.model.slot_C_A[0];
  std::string text = fmt::format(
      " The two-point calibration of the paper{} gives C_H = {} and C_A = {} s/m and misses by {} "
      "over the same points where the full fit misses by {}",
      where, number(two.theta[H], 3), number(two.theta[A], 3), number(comparison->rmse, 2),
      number(comparison->full_rmse, 2));
  if (comparison->held_out_rmse && comparison->full_held_out_rmse) {
    text += fmt::format("; fitted to one diameter and judged on the others, {} against {}",
                        number(*comparison->held_out_rmse, 2),
                        number(*comparison->full_held_out_rmse, 2));
  }
  return text + ".";
}

std::string summary_words(const Analysis& a) {
  double smallest = INFINITY;
  double largest = 0.0;
  std::vector<double> diameters;
  for (const Observation& point : a.data.points) {
    smallest = std::min(smallest, point.velocity);
    largest = std::max(largest, point.velocity);
    diameters.push_back(point.diameter);
  }
  std::sort(diameters.begin(), diameters.end());
  diameters.erase(std::unique(diameters.begin(), diameters.end()), diameters.end());
  const Dataset& first = a.datasets.front();
  std::string size = diameters.empty() ? std::string() : diameter_text(diameters.front());
  if (diameters.size() > 1) size += " to " + diameter_text(diameters.back());
  std::vector<std::string> surfaces;
  for (const Dataset& dataset : a.datasets) surfaces.push_back(dataset.system.surface.name);

  std::string text =
      fmt::format("{} points of {} spheres, {} um in diameter, hitting {} at {} to {} m/s. ",
                  a.data.points.size(), first.system.particle.name, size, fmt::join(surfaces, ", "),
                  number(smallest, 3), number(largest, 3));
  std::vector<std::string> estimates;
  for (std::size_t s = 0; s < a.fitted.model.slots.size(); ++s) {
    if (a.fitted.model.slots[s].free) estimates.push_back(estimate_words(a, s));
  }
  text += fmt::format("A least-squares fit to all of them gives {}", fmt::join(estimates, ", "));
  text += fmt::format(", with {} intervals in brackets. ", percent(a.uncertainty.options.level));
  return text + fit_quality_words(a) + two_point_words(a);
}

std::string list_html(const std::vector<std::string>& sentences, const std::string& name) {
  if (sentences.empty()) return "";
  std::string out = fmt::format("<ul class=\"{}\">\n", name);
  for (const std::string& sentence : sentences) {
    out += fmt::format("<li>{}</li>\n", prose_html(as_sentence(sentence)));
  }
  return out + "</ul>\n";
}

std::string pair_paragraphs(const Analysis& a) {
  std::string out;
  for (const PairStudy& study : a.uncertainty.pairs) {
    out += fmt::format("<p>{}</p>\n",
                       prose_html(fmt::format("{}", fmt::join(pair_words(a, study), " "))));
  }
  return out;
}

struct PageSection {
  const char* id;
  const char* heading;
  std::string body;
};

std::vector<PageSection> plot_sections(const Analysis& a) {
  const auto joined = [](std::vector<Figure> one, const std::vector<Figure>& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
  };
  return {
      {"restitution", "Restitution against velocity", figures_html(restitution_figures(a))},
      {"residuals", "Residuals",
       figures_html(joined(residual_velocity_figures(a), residual_diameter_figures(a)))},
      {"distribution", "How sure the parameters are",
       figures_html(joined(joined(interval_figures(a), bootstrap_figures(a)), corner_figures(a)))},
      {"two-points", "Two points against all",
       figures_html(joined(two_point_figures(a), pair_figures(a))) + pair_paragraphs(a)},
      {"forces", "Adhesion and contact forces",
       figures_html(joined(adhesion_force_figures(a), force_history_figures(a)))},
      {"corrections", "From events to points", corrections_section(a)},
      {"mixture", "A mixture of sizes", mixture_section(a)},
      {"capture-models", "Capture velocity by this and other models",
       capture_comparison_section(a)},
  };
}

std::vector<PageSection> table_sections(const Analysis& a) {
  const Identifiability& found = a.uncertainty.identifiability;
  std::string identifiability;
  if (!found.verdict.empty()) {
    identifiability = fmt::format("<p><strong>{}</strong> {}</p>\n",
                                  escape_html(as_sentence(words_of(found.verdict))),
                                  prose_html(as_sentence(found.text)));
  }
  return {
      {"parameters", "Parameters",
       parameters_table(a) + intervals_table(a) + correlations_table(a)},
      {"goodness", "Fit statistics", goodness_table(a)},
      {"capture", "Capture velocity", capture_table(a)},
      {"identifiability", "What the data can tell", identifiability},
      {"comparison", "Two points against all, in numbers", two_point_tables(a)},
      {"bootstrap", "Bootstrap", bootstrap_table(a)},
      {"inputs", "Inputs", inputs_tables(a)},
      {"contradictions", "Inputs that contradict each other",
       list_html(all_contradictions(a), "warnings")},
      {"starts", "Starts", starts_table(a)},
      {"points", "Every point", points_table(a)},
      {"glossary", "Glossary", glossary(a)},
  };
}

}  // namespace

std::string html_report(const Analysis& analysis, const std::string& diagnosis) {
  if (!analysis.fitted.usable) {
    throw ComputationError(
        fmt::format("there is no page without a usable fit: {}", analysis.fitted.failure));
  }
  std::string body =
      fmt::format("<header>\n<h1>{}</h1>\n<p class=\"subtitle\">{}</p>\n",
                  escape_html(title_of(analysis)), escape_html(subtitle_of(analysis)));
  body += provenance_html(provenances(analysis.datasets));
  body += fmt::format("<p class=\"summary\">{}</p>\n", prose_html(summary_words(analysis)));

  std::vector<PageSection> sections = plot_sections(analysis);
  sections.insert(sections.begin() + 2, {"diagnosis", "What the model gets wrong", diagnosis});
  for (PageSection& section : table_sections(analysis)) sections.push_back(std::move(section));
  const std::vector<std::string> warnings = all_warnings(analysis);
  body += "<nav aria-label=\"Contents\">";
  if (!warnings.empty()) body += "<a href=\"#warnings\">Warnings</a>";
  std::string content;
  const std::string empty_figures = figures_html({});
  for (const PageSection& section : sections) {
    if (section.body.empty() || section.body == empty_figures) continue;
    body += fmt::format("<a href=\"#{}\">{}</a> ", section.id, escape_html(section.heading));
    content += section_html(section.id, section.heading, section.body);
  }
  body += "</nav>\n</header>\n<main>\n";
  if (!warnings.empty()) {
    body += section_html("warnings", "Warnings", list_html(warnings, "warnings"));
  }
  return page_html(title_of(analysis), body + content + "</main>\n");
}

std::string thumbnail(const Analysis& analysis) {
  return plot::draw_svg(restitution_overview(analysis, analysis.spec.id));
}

}  // namespace recoil
