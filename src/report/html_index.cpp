#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "report/format.hpp"
#include "report/html_page.hpp"
#include "report/report.hpp"

namespace recoil {
namespace {

using Json = nlohmann::ordered_json;  // parameters in the order of the fit

/// fit.json at a JSON pointer; null when it is not there, so that an index never fails on a key
/// that a later version drops.
Json at(const Json& fit, const Json::json_pointer& path) {
  return fit.contains(path) ? fit.at(path) : Json();
}

Json at(const Json& fit, const char* pointer) { return at(fit, Json::json_pointer(pointer)); }

std::string text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::string number_cell(const Json& value, int digits = 3) {
  return value.is_number() ? number(value.get<double>(), digits) : "–";
}

std::string interval_cell(const Json& interval) {
  if (!interval.is_array() || interval.size() != 2) return "–";
  return fmt::format("[{}, {}]", number_cell(interval[0]), number_cell(interval[1]));
}

std::string recommended_cell(const Json& parameter) {
  const std::string kind = text(at(parameter, "/recommended/interval"));
  return kind.empty() ? "–" : interval_cell(at(parameter, Json::json_pointer("/intervals") / kind));
}

/// The values of `pointer` in the two-point comparison of every dataset that has it: one number, or
/// the range that they span.
std::string two_point_cell(const Json& fit, const Json::json_pointer& pointer) {
  double lower = INFINITY;
  double upper = -INFINITY;
  const Json comparisons = at(fit, "/two_point_by_dataset");
  for (const Json& comparison : comparisons) {
    const Json value = at(comparison, pointer);
    if (!value.is_number()) continue;
    lower = std::min(lower, value.get<double>());
    upper = std::max(upper, value.get<double>());
  }
  if (!(lower <= upper)) return "–";
  const std::string first = number(lower, 3);
  const std::string last = number(upper, 3);
  return first == last ? first : fmt::format("{} to {}", first, last);
}

std::string numbers_table(const Json& fit) {
  HtmlTable table;
  table.head = {"", "all points", "interval", "two points"};
  const Json parameters = at(fit, "/parameters");
  for (const auto& [label, parameter] : parameters.items()) {
    if (!parameter.is_object()) continue;
    const bool free = parameter.value("free", false);
    const bool damping = label.starts_with("C_");
    if (!free && !damping) continue;
    table.rows.push_back(
        {fmt::format("{} [{}]", parameter_html(label), prose_html(parameter.value("unit", ""))),
         number_cell(at(parameter, "/value")), free ? recommended_cell(parameter) : "fixed",
         two_point_cell(fit, Json::json_pointer("/parameters") / label / "value")});
  }
  table.rows.push_back({"rms of <i>e</i>", number_cell(at(fit, "/goodness/rmse")), "",
                        two_point_cell(fit, Json::json_pointer("/rmse"))});
  const Json chi2 = at(fit, "/goodness/chi2");
  const Json dof = at(fit, "/goodness/dof");
  if (chi2.is_number() && dof.is_number() && dof.get<double>() > 0.0) {
    const Json p = at(fit, "/goodness/p_value");
    table.rows.push_back({"chi² / dof",
                          fmt::format("{} / {}", number_cell(chi2, 4), number_cell(dof, 6)),
                          p.is_number() ? "p " + escape_html((p.get<double>() < 1e-6 ? "" : "= ") +
                                                             p_value_text(p.get<double>()))
                                        : "",
                          ""});
  }
  return table_html(table);
}

std::string provenance_of(const Json& fit) {
  std::vector<std::pair<std::string, std::string>> list;
  const Json datasets = at(fit, "/datasets");
  for (const Json& dataset : datasets.is_array() ? datasets : Json::array({at(fit, "/dataset")})) {
    const std::pair entry{text(at(dataset, "/provenance")),
                          text(at(dataset, "/provenance_sentence"))};
    if (std::find(list.begin(), list.end(), entry) == list.end()) list.push_back(entry);
  }
  return provenance_html(list);
}

Json parsed(const IndexEntry& entry, const std::string& content, const std::string& file) {
  const auto refuse = [&](const char* problem) {
    throw InputError({entry.page}, fmt::format("its {} {}", file, problem),
                     "the index is made from it", "run the fit again");
  };
  Json json;
  try {
    json = Json::parse(content);
  } catch (const Json::exception&) {
    refuse("is not JSON");
  }
  if (!json.is_object()) refuse("is not an object");
  return json;
}

/// A mark that says a verdict to those who cannot see its colour.
struct VerdictMark {
  const char* verdict;
  const char* mark;
};
constexpr VerdictMark verdict_marks[] = {
    {"adequate", "✓"}, {"cause_named", "◆"}, {"not_separable", "?"}, {"unexplained", "✗"}};

std::string verdict_line(const IndexEntry& entry) {
  if (entry.diagnosis_json.empty()) return "";
  const Json diagnosis = parsed(entry, entry.diagnosis_json, "diagnosis.json");
  const std::string verdict = text(at(diagnosis, "/verdict"));
  const auto* const found =
      std::find_if(std::begin(verdict_marks), std::end(verdict_marks),
                   [&](const VerdictMark& mark) { return verdict == mark.verdict; });
  if (found == std::end(verdict_marks)) return "";
  const std::string words = text(at(diagnosis, "/headline"));
  return fmt::format(
      "<p class=\"verdict {}\"><span class=\"mark\" aria-hidden=\"true\">{}</span> "
      "<a href=\"{}\">{}</a></p>\n",
      found->verdict, found->mark, escape_html(entry.diagnosis_page),
      escape_html(words.empty() ? words_of(verdict) : words));
}

std::string card(const IndexEntry& entry) {
  const Json fit = parsed(entry, entry.fit_json, "fit.json");
  const Json datasets = at(fit, "/datasets");
  const bool joint = datasets.is_array() && datasets.size() > 1;
  const std::string id = text(at(fit, "/fit/id"));
  const std::string title = text(at(fit, "/dataset/title"));
  const std::string heading = joint || title.empty() ? id : title;
  std::string subtitle = fmt::format("{} points", number_cell(at(fit, "/dataset/points"), 9));
  if (joint) {
    subtitle = text(at(fit, "/dataset/id")) + ", " + subtitle;
  } else if (heading != id) {
    subtitle = id + ", " + subtitle;
  }
  for (std::size_t i = 0; (i = subtitle.find('+', i)) != std::string::npos;) {
    subtitle.replace(i, 1, " + ");
    i += 3;
  }
  const std::string page = escape_html(entry.page);
  std::string out = fmt::format(
      "<article class=\"card\">\n<h2><a href=\"{}\">{}</a></h2>\n<p class=\"subtitle\">{}</p>\n",
      page, escape_html(heading), escape_html(subtitle));
  out += provenance_of(fit);
  out += verdict_line(entry);
  if (!entry.picture.empty())
    out += fmt::format("<div class=\"picture\">{}</div>\n", entry.picture);
  out += numbers_table(fit);
  out += fmt::format("<p class=\"more\"><a href=\"{}\">All plots and numbers</a></p>\n</article>\n",
                     page);
  return out;
}

}  // namespace

std::string html_index(const std::vector<IndexEntry>& entries) {
  std::string body =
      "<header>\n<h1>Impact of microspheres with surfaces</h1>\n"
      "<p class=\"summary\">Each card is one fit: the damping of the contact (C<sub>H</sub>) and "
      "of the adhesion (C<sub>A</sub>) from all points, beside the calibration by two "
      "points, and whether the model holds.</p>\n</header>\n<main class=\"cards\">\n";
  for (const IndexEntry& entry : entries) body += card(entry);
  if (entries.empty()) body += "<p>There is no fit yet.</p>\n";
  return page_html("recoil: fits", body + "</main>\n");
}

}  // namespace recoil
