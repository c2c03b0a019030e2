#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/units.hpp"
#include "data/text.hpp"
#include "report/diagnosis_report.hpp"
#include "report/format.hpp"
#include "report/html_page.hpp"
#include "uncertainty/identifiability.hpp"

namespace recoil {
namespace {

std::string answer_html(const Diagnosis& d) {
  std::string out = fmt::format("<p><strong>{}.</strong></p>\n<p class=\"summary\">{}</p>\n",
                                escape_html(headline(d)), prose_html(d.text));
  for (const std::string& remark : d.remarks) {
    out += fmt::format("<p>{}</p>\n", prose_html(remark));
  }
  return out;
}

std::string value_cell(const FitResult& fitted, const std::vector<IntervalSet>& intervals,
                       const std::string& label) {
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    if (fitted.model.slots[j].label() != label) continue;
    std::string cell = number(fitted.theta[j], 4);
    if (!fitted.model.slots[j].free) return cell + " (fixed)";
    if (fitted.at_bound[j]) cell += " (at its bound)";
    if (j < intervals.size()) {
      const Interval interval = recommended_interval(intervals[j]);
      if (interval.available()) cell += " " + interval_text(interval, 3);
    }
    return cell;
  }
  return "–";
}

std::string parameters_html(const Diagnosis& d) {
  if (!d.extended_fit) return "";
  HtmlTable table;
  table.caption = fmt::format(
      "Parameters under both models, with {} intervals: what the base model's damping was carrying "
      "for the missing effect",
      percent(d.spec.uncertainty.level));
  table.head = {"parameter", "unit", "base", "extended"};
  for (const ParameterSlot& slot : d.extended_fit->model.slots) {
    table.rows.push_back(
        {parameter_html(slot.label()), escape_html(slot.parameter->unit),
         escape_html(value_cell(d.base, d.base_intervals, slot.label())),
         escape_html(value_cell(*d.extended_fit, d.extended_intervals, slot.label()))});
  }
  return table_html(table);
}

std::string gain_html(const Diagnosis& d) {
  if (!d.gain || d.gain->folds.empty()) return "";
  HtmlTable table;
  table.caption =
      "Blocks of points that neither model saw: both fitted to the others, then compared with them";
  table.head = {"held out", "points", "rms of e, base", "rms of e, extended", "ln likelihood"};
  for (const HeldOutGain::PerFold& fold : d.gain->folds) {
    table.rows.push_back({escape_html(fmt::format("{} {}{}", fold.fold.kind, fold.fold.name,
                                                  fold.counted ? "" : " (shown, not counted)")),
                          std::to_string(fold.fold.points.size()), number(fold.rmse_base, 3),
                          number(fold.rmse_extended, 3), fmt::format("{:+.1f}", fold.log_score)});
  }
  std::string out = table_html(table);
  if (d.gain->lower && d.gain->upper) {
    out += fmt::format(
        "<p>Together: {} instead of {}, {:.0f} % less (95 % interval {:.0f} to {:.0f} %).</p>\n",
        number(d.gain->rmse_extended, 3), number(d.gain->rmse_base, 3), 100.0 * d.gain->relative,
        100.0 * *d.gain->lower, 100.0 * *d.gain->upper);
  }
  return out;
}

std::string capture_html(const Diagnosis& d) {
  if (d.capture.empty()) return "";
  HtmlTable table;
  table.caption = "Predicted capture velocity [m/s]";
  table.head = {"dataset", "diameter [µm]", "base", "extended"};
  const auto cell = [](const std::optional<double>& value) {
    return value ? number(*value, 3) : std::string("none");
  };
  for (const CaptureChange& change : d.capture) {
    table.rows.push_back({escape_html(d.datasets[change.dataset].id),
                          diameter_text(change.diameter), cell(change.base),
                          cell(change.extended)});
  }
  return table_html(table);
}

std::string next_html(const Diagnosis& d) {
  if (d.next.empty()) return "";
  HtmlTable table;
  table.caption = "Impacts at which the rivals differ most for the number of events";
  table.head = {"tells", "diameter [µm]", "V [m/s]", "difference in e", "events"};
  for (const NextMeasurement& next : d.next) {
    table.rows.push_back({escape_html(words_of(next.one) + " from " + words_of(next.other)),
                          diameter_text(next.diameter), number(next.velocity, 3),
                          fmt::format("{:+.3f}", next.difference),
                          next.events ? std::to_string(*next.events) : "more than a million"});
  }
  return table_html(table);
}

std::string tests_html(const Diagnosis& d) {
  HtmlTable table;
  table.caption = fmt::format(
      "Questions put to the residuals; p-values from {} data sets that the fitted model itself "
      "made",
      d.structure.simulated);
  table.head = {"question", "p"};
  for (const StructureTest& test : d.structure.tests) {
    table.rows.push_back({escape_html(test.title), escape_html(p_value_text(test.p_value))});
  }
  table.rows.push_back({"all of them together", escape_html(p_value_text(d.structure.p_value))});
  return table_html(table);
}

void add_candidates(const std::vector<CandidateResult>& candidates, std::size_t most,
                    HtmlTable& table) {
  for (std::size_t k = 0; k < std::min(most, candidates.size()); ++k) {
    const CandidateResult& c = candidates[k];
    std::vector<std::string> values;
    for (const FoundParameter& p : c.parameters) {
      values.push_back(fmt::format("{} = {:.3g}{}", p.label, p.value, unit_suffix(p.unit)));
    }
    table.rows.push_back({escape_html(c.candidate.name()), escape_html(to_string(c.kind)),
                          fmt::format("{:.1f}", c.delta_aicc),
                          c.p_value ? escape_html(p_value_text(*c.p_value)) : "",
                          c.gain ? fmt::format("{:+.0f} %", 100.0 * c.gain->relative) : "",
                          escape_html(p_value_text(c.remaining_p)),
                          escape_html(fmt::format("{}", fmt::join(values, ", "))),
                          escape_html(c.explains() ? "explains it" : c.aside)});
  }
}

std::string candidates_html(const Diagnosis& d) {
  if (d.candidates.empty()) return "";
  HtmlTable table;
  table.caption =
      "Every mechanism of the catalogue, added to the model and refitted. p: of the gain, against "
      "the best of all candidates on data of the base model; left: p of the structure that remains";
  table.head = {"mechanism", "kind", "ΔAICc", "p", "held out", "left", "parameters", "verdict"};
  table.words = {6, 7};
  table.compact = true;
  add_candidates(d.candidates, d.candidates.size(), table);
  add_candidates(d.pairs, 8, table);
  return table_html(table);
}

std::string warnings_html(const Diagnosis& d) {
  if (d.warnings.empty()) return "";
  std::string out = "<ul class=\"warnings\">\n";
  for (const std::string& warning : d.warnings) {
    out += fmt::format("<li>{}</li>\n", prose_html(as_sentence(warning)));
  }
  return out + "</ul>\n";
}

}  // namespace

std::string diagnosis_section(const Diagnosis& d) {
  // A page of several targets has many pictures already; the diagnosis itself shows the others.
  std::vector<Figure> figures = misfit_figures(d);
  if (d.datasets.size() == 1) {
    for (Figure& figure : before_after_figures(d)) figures.push_back(std::move(figure));
  }
  return answer_html(d) + figures_html(figures) + parameters_html(d);
}

std::string diagnosis_html(const Diagnosis& d) {
  std::string body = fmt::format(
      "<header>\n<h1>What the model gets wrong</h1>\n<p class=\"subtitle\">Diagnosis of {}</p>\n",
      escape_html(d.spec.id));
  body += provenance_html(provenances(d.datasets)) + answer_html(d) + "</header>\n<main>\n";
  const std::vector<std::pair<std::string, std::string>> sections = {
      {"Where it misses", figures_html(misfit_figures(d)) + tests_html(d)},
      {"What could explain it", figures_html(ranking_figures(d)) + candidates_html(d)},
      {"Before and after",
       figures_html(before_after_figures(d)) + parameters_html(d) + capture_html(d)},
      {"What was gained", gain_html(d)},
      {"What to measure next", next_html(d)},
      {"Warnings", warnings_html(d)},
  };
  std::size_t number_of_section = 0;
  for (const auto& [heading, content] : sections) {
    ++number_of_section;
    if (content.empty()) continue;
    body += section_html(fmt::format("part-{}", number_of_section), heading, content);
  }
  return page_html("Diagnosis of " + d.spec.id, body + "</main>\n");
}

}  // namespace recoil
