#include "report/html_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "report/format.hpp"
#include "report/html_page.hpp"
#include "report/words_noise.hpp"
#include "report/words_two_point.hpp"

namespace recoil {
namespace {

constexpr double least_correlation = 0.1;
const std::string none = "–";

std::string quantity(const std::string& symbol, const std::string& unit) {
  return fmt::format("{} [{}]", prose_html(symbol), prose_html(unit));
}

std::string interval_cell(const Interval& interval) {
  return interval.available() ? interval_text(interval) : none;
}

std::string number_at(const std::vector<double>& values, std::size_t i, int digits = 4) {
  return i < values.size() ? number(values[i], digits) : none;
}

std::string optional_number(const std::optional<double>& value) {
  return value ? number(*value) : none;
}

/// Removes the columns in which no row but the first column's says anything.
void drop_empty_columns(HtmlTable& table) {
  for (std::size_t column = table.head.size(); column-- > 1;) {
    const bool empty = std::all_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
      return row[column].empty() || row[column] == none;
    });
    if (!empty) continue;
    const auto place = static_cast<std::ptrdiff_t>(column);
    table.head.erase(table.head.begin() + place);
    for (auto& row : table.rows) row.erase(row.begin() + place);
    std::erase(table.words, column);
    for (std::size_t& word : table.words) word -= word > column ? 1 : 0;
  }
}

}  // namespace

std::string parameters_table(const Analysis& a) {
  const FitResult& f = a.fitted;
  HtmlTable table;
  table.head = {"parameter",
                "value",
                "± standard error",
                "unit",
                percent(a.uncertainty.options.level) + " interval",
                "kind",
                "start",
                "remark"};
  table.words = {7};
  for (std::size_t s = 0; s < f.model.slots.size(); ++s) {
    const ParameterSlot& slot = f.model.slots[s];
    if (!slot.free) {
      table.rows.push_back({parameter_html(slot.label()), number(f.theta[s]), none,
                            prose_html(slot.parameter->unit), none, "fixed", none, ""});
      continue;
    }
    const double error = s < f.std_error.size() ? f.std_error[s] : 0.0;
    const auto [value, spread] = number_with_error(f.theta[s], error);
    const IntervalSet set = intervals_of(a, s);
    const Interval interval = recommended_interval(set);
    std::string remark;
    if (s < f.at_bound.size() && f.at_bound[s]) {
      remark =
          fmt::format("Rests on a bound of [{}, {}]. ", number(slot.lower), number(slot.upper));
    }
    if (!interval.available()) remark += as_sentence("no interval: " + reason_without(set));
    if (!interval.note.empty()) remark += as_sentence(interval.note);
    table.rows.push_back({parameter_html(slot.label()), value, error > 0.0 ? spread : none,
                          prose_html(slot.parameter->unit), interval_cell(interval),
                          interval.available() ? escape_html(set.recommended) : none,
                          number(slot.initial), prose_html(remark)});
  }
  drop_empty_columns(table);
  std::string out = table_html(table);
  for (const std::string& sentence : recommendations(a)) {
    out += fmt::format("<p>{}</p>\n", prose_html(sentence));
  }
  return out;
}

std::string intervals_table(const Analysis& a) {
  HtmlTable table;
  table.caption = fmt::format("Every {} interval; a dash where there is none",
                              percent(a.uncertainty.options.level));
  table.head = {"parameter", "Wald", "profile", "percentile", "BCa", "studentized"};
  std::string reasons;
  for (std::size_t s = 0; s < a.fitted.model.slots.size(); ++s) {
    const ParameterSlot& slot = a.fitted.model.slots[s];
    if (!slot.free) continue;
    const IntervalSet set = intervals_of(a, s);
    table.rows.push_back({quantity(slot.parameter->name, slot.parameter->unit),
                          interval_cell(set.wald), interval_cell(set.profile),
                          interval_cell(set.percentile), interval_cell(set.bca),
                          interval_cell(set.studentized)});
    if (!slot.dataset.empty()) table.rows.back()[0] = parameter_html(slot.label());
    const std::pair<const char*, const Interval*> kinds[] = {{"Wald", &set.wald},
                                                             {"profile", &set.profile},
                                                             {"percentile", &set.percentile},
                                                             {"BCa", &set.bca},
                                                             {"studentized", &set.studentized}};
    for (const auto& [kind, interval] : kinds) {
      if (interval->available()) continue;
      reasons += fmt::format("<li>{}, {}: {}</li>\n", parameter_html(slot.label()), kind,
                             prose_html(interval->why));
    }
  }
  if (table.rows.empty()) return "";
  drop_empty_columns(table);
  std::string out = table_html(table);
  for (const std::string& sentence : disagreements(a)) {
    out += fmt::format("<p>{}</p>\n", prose_html(sentence));
  }
  if (!reasons.empty()) {
    out += "<details><summary>Why some intervals are missing</summary><ul>\n" + reasons +
           "</ul></details>\n";
  }
  return out;
}

std::string correlations_table(const Analysis& a) {
  const auto& slots = a.fitted.model.slots;
  HtmlTable table;
  table.caption = "Correlations above 0.1 in size";
  table.head = {"pair", "correlation"};
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = i + 1; j < slots.size(); ++j) {
      const double value = correlation(a, i, j);
      if (std::abs(value) < least_correlation) continue;
      table.rows.push_back(
          {parameter_html(slots[i].label()) + ", " + parameter_html(slots[j].label()),
           fmt::format("{:+.3f}", value)});
    }
  }
  return table.rows.empty() ? "" : table_html(table);
}

std::string goodness_table(const Analysis& a) {
  const FitResult& f = a.fitted;
  const auto free = std::count_if(f.model.slots.begin(), f.model.slots.end(),
                                  [](const ParameterSlot& slot) { return slot.free; });
  HtmlTable table;
  table.rows = {
      {"data points", fmt::format("{}", a.fitted.data.points.size())},
      {"variables", fmt::format("{}", free)},
      {"chi-square", number(f.chi2, 6)},
      {"degrees of freedom", fmt::format("{}", f.dof)},
      {"reduced chi-square", f.dof > 0 ? number(f.chi2 / f.dof, 4) : none},
      {"p-value", a.fitted.data.sd_stated && f.dof > 0 ? escape_html(p_value_text(f.p_value))
                                                       : "– (no deviations stated)"},
      {"rms of <i>e</i>", number(f.rmse)}};
  if (a.fitted.data.sd_stated && f.dof <= 0) table.rows[5][1] = none;
  std::string out = table_html(table);
  if (const std::string words = noise_words(f); !words.empty()) {
    out += fmt::format("<p>{}</p>\n", prose_html(as_sentence(words)));
  }
  return out;
}

std::string capture_table(const Analysis& a) {
  if (a.uncertainty.capture.empty()) return "";
  HtmlTable table;
  table.caption = "Capture velocity: slower spheres stay on the surface";
  table.head = {"dataset", "d [µm]", "<i>V</i>* [m/s]",
                percent(a.uncertainty.options.level) + " interval", "remark"};
  table.words = {4};
  for (const CaptureEstimate& capture : a.uncertainty.capture) {
    if (without_adhesion(a, capture.dataset)) {
      table.rows.push_back({escape_html(a.datasets[capture.dataset].id),
                            diameter_text(capture.diameter), no_capture_words, "", ""});
      continue;
    }
    table.rows.push_back(
        {escape_html(a.datasets[capture.dataset].id), diameter_text(capture.diameter),
         capture.found ? digits(capture.value, 4) : "none found", interval_cell(capture.interval),
         capture.interval.available() ? "" : prose_html(capture.interval.why)});
  }
  drop_empty_columns(table);
  return table_html(table);
}

std::string two_point_tables(const Analysis& a) {
  const FitResult& f = a.fitted;
  std::string out;
  for (const TwoPointComparison& comparison : a.uncertainty.two_point) {
    const TwoPointResult& two = comparison.result;
    const bool answered = two.status != TwoPointStatus::too_few_points;
    const auto point = [&](std::size_t i) {
      if (!answered || i >= a.fitted.data.points.size()) return std::string(none);
      return fmt::format("e = {} at {} m/s", number(a.fitted.data.points[i].restitution, 3),
                         number(a.fitted.data.points[i].velocity, 3));
    };
    HtmlTable table;
    table.caption = fmt::format("{}, two points calibrated at d = {} um: {} and {}",
                                a.datasets[comparison.dataset].id, diameter_text(two.diameter),
                                point(two.high_point), point(two.low_point));
    table.head = {"", "two points", "all points"};
    for (const std::size_t s :
         {f.model.slot_C_H[comparison.dataset], f.model.slot_C_A[comparison.dataset]}) {
      const ParameterSlot& slot = f.model.slots[s];
      table.rows.push_back({quantity(slot.parameter->name, slot.parameter->unit),
                            number_at(two.theta, s), number_at(f.theta, s)});
      table.rows.push_back({prose_html(slot.parameter->name) + ", spread under resampling",
                            number_at(comparison.spread, s, 2),
                            number_at(comparison.full_spread, s, 2)});
    }
    table.rows.push_back({"rms of <i>e</i>, all points", answered ? number(comparison.rmse) : none,
                          number(comparison.full_rmse)});
    table.rows.push_back({"rms of <i>e</i>, diameters not seen",
                          optional_number(comparison.held_out_rmse),
                          optional_number(comparison.full_held_out_rmse)});
    table.rows.push_back(
        {"replicates without an answer",
         fmt::format("{} of {}", comparison.failed, a.uncertainty.bootstrap.two_point_replicates),
         ""});
    out += table_html(table);
    std::string words = fmt::format("Two-point iteration: {}. {}", words_of(to_string(two.status)),
                                    as_sentence(two_point_words(f, comparison.dataset, two)));
    if (comparison.full_held_out_rmse) {
      words +=
          " For the diameters not seen, all points of the calibration diameter alone were "
          "fitted.";
    }
    if (!comparison.held_out_why.empty()) words += " " + as_sentence(comparison.held_out_why);
    out += fmt::format("<p>{}</p>\n", prose_html(words));
  }
  return out;
}

std::string bootstrap_table(const Analysis& a) {
  const BootstrapResult& bootstrap = a.uncertainty.bootstrap;
  if (bootstrap.replicates == 0) return "<p>No replicates were asked for.</p>\n";
  HtmlTable table;
  table.rows = {{"scheme", escape_html(bootstrap.scheme)},
                {"replicates", fmt::format("{}", bootstrap.replicates)},
                {"failed refits", fmt::format("{}", bootstrap.failed)},
                {"seed", fmt::format("{}", bootstrap.seed)}};
  std::string out = table_html(table);
  for (const std::string& words :
       {bootstrap.scheme_why, chance_text(bootstrap), bootstrap.failures.text}) {
    if (!words.empty()) out += fmt::format("<p>{}</p>\n", prose_html(as_sentence(words)));
  }
  return out;
}

std::string starts_table(const Analysis& a) {
  if (a.fitted.starts.empty()) return "";
  HtmlTable table;
  table.caption = "Where the minimisation began and ended";
  table.head = {"start"};
  std::vector<std::size_t> free;
  for (std::size_t s = 0; s < a.fitted.model.slots.size(); ++s) {
    if (!a.fitted.model.slots[s].free) continue;
    free.push_back(s);
    table.head.push_back(parameter_html(a.fitted.model.slots[s].label()) + ", start");
    table.head.push_back("end");
  }
  table.head.insert(table.head.end(), {"chi-square", "outcome"});
  table.words = {table.head.size() - 1};
  for (std::size_t i = 0; i < a.fitted.starts.size(); ++i) {
    const StartSummary& start = a.fitted.starts[i];
    std::vector<std::string> row = {fmt::format("{}", i + 1)};
    for (const std::size_t s : free) {
      row.push_back(number_at(start.start, s, 3));
      row.push_back(number_at(start.end, s, 6));
    }
    row.push_back(number(start.chi2, 7));
    row.push_back(start.converged ? "converged" : "failed: " + prose_html(start.message));
    table.rows.push_back(std::move(row));
  }
  return table_html(table);
}

}  // namespace recoil
