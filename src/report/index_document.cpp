#include "report/index_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/program.hpp"
#include "document/html.hpp"
#include "mechanism/parameter.hpp"
#include "report/diagnosis_headline.hpp"
#include "report/format.hpp"
#include "report/json_diagnosis.hpp"
#include "report/law_comparison.hpp"

namespace recoil {
namespace {

void widen(std::optional<TwoPointRange>& range, double value) {
  if (!std::isfinite(value)) return;
  if (!range) range = {value, value};
  range->lower = std::min(range->lower, value);
  range->upper = std::max(range->upper, value);
}

bool has_answer(const TwoPointComparison& comparison) {
  return comparison.result.status != TwoPointStatus::too_few_points;
}

/// fit.json at a JSON pointer; null when it is not there, so that an index never fails on a key
/// that a later version drops.
Json at(const Json& json, const Json::json_pointer& path) {
  return json.contains(path) ? json.at(path) : Json();
}

Json at(const Json& json, const char* pointer) { return at(json, Json::json_pointer(pointer)); }

std::string text_at(const Json& json, const char* pointer) {
  const Json value = at(json, pointer);
  return value.is_string() ? value.get<std::string>() : std::string();
}

double number_at(const Json& json, const Json::json_pointer& path) {
  const Json value = at(json, path);
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

double number_at(const Json& json, const char* pointer) {
  return number_at(json, Json::json_pointer(pointer));
}

std::optional<TwoPointRange> read_range(const Json& fit, const Json::json_pointer& pointer) {
  std::optional<TwoPointRange> range;
  const Json comparisons = at(fit, "/two_point_by_dataset");
  for (const Json& comparison : comparisons) widen(range, number_at(comparison, pointer));
  return range;
}

std::optional<NumberRange> read_recommended(const Json& parameter) {
  const std::string kind = text_at(parameter, "/recommended/interval");
  if (kind.empty()) return std::nullopt;
  const Json ends = at(parameter, Json::json_pointer("/intervals") / kind);
  if (!ends.is_array() || ends.size() != 2 || !ends[0].is_number() || !ends[1].is_number()) {
    return std::nullopt;
  }
  return NumberRange{ends[0].get<double>(), ends[1].get<double>()};
}

Json parsed(const std::string& page, const std::string& content, const std::string& file) {
  const auto refuse = [&](const char* problem) {
    throw InputError({page}, fmt::format("its {} {}", file, problem), "the index is made from it",
                     "run the fit again");
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

/// A sign that says a verdict to those who cannot see its colour.
const char* sign_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate:
      return "✓";
    case Verdict::cause_named:
      return "◆";
    case Verdict::not_separable:
      return "?";
    case Verdict::unexplained:
      return "✗";
  }
  return "";
}

/// Is it C_H or C_A, which are shown even where they are fixed?
bool is_damping(const std::string& label) {
  const std::string name = label.substr(0, label.find('['));
  const std::vector<Parameter>& base = base_parameters();
  return std::any_of(base.begin(), base.end(), [&](const Parameter& parameter) {
    return parameter.name == name && parameter.is_damping();
  });
}

Cell range_cell(const std::optional<TwoPointRange>& range) {
  if (!range) return {};
  const std::string first = number(range->lower, 3);
  const std::string last = number(range->upper, 3);
  if (first == last) return Number{range->lower, significant(3)};
  return say("{} to {}", first, last);
}

Cell interval_cell(const ParameterSummary& parameter) {
  if (!parameter.free) return "fixed";
  if (!parameter.interval) return {};
  return NumberRange{parameter.interval->lower, parameter.interval->upper, significant(3)};
}

/// The law of adhesion with the lowest AICc, and by how much the others are above it.
void add_laws(std::vector<ComparedFit> laws, Table& table) {
  std::erase_if(laws, [](const ComparedFit& law) { return !law.aicc(); });
  if (laws.size() < 2) return;
  std::stable_sort(laws.begin(), laws.end(), [](const ComparedFit& a, const ComparedFit& b) {
    return *a.aicc() < *b.aicc();
  });
  std::vector<std::string> others;
  for (const ComparedFit& law : laws) {
    if (&law == &laws.front()) continue;
    const double above = *law.aicc() - *laws.front().aicc();
    others.push_back(fmt::format("{} +{}", law.adhesion, number(above, 3)));
  }
  table.rows.push_back({"law of adhesion, AICc", Sentence(laws.front().adhesion),
                        Sentence(fmt::format("{}", fmt::join(others, ", "))), ""});
}

Sentence subtitle_of(const FitSummary& fit) {
  const std::string points = fmt::format("{} points", fit.points);
  if (fit.datasets.size() > 1) {
    return fmt::format("{}, {}", fmt::join(fit.datasets, " + "), points);
  }
  return fit.title.empty() ? points : fmt::format("{}, {}", fit.id, points);
}

Section card_of(const IndexEntry& entry) {
  const FitSummary& fit = entry.fit;
  Section card{fit.id, fit.title.empty() ? fit.id : fit.title, subtitle_of(fit), {}, entry.page};
  for (const auto& [label, sentence] : fit.provenances) {
    card.blocks.emplace_back(Banner{label, sentence});
  }
  if (fit.verdict) {
    const std::string name = to_string(*fit.verdict);
    card.blocks.emplace_back(
        Remark{name, sign_of(*fit.verdict),
               link(fit.headline.empty() ? words_of(name) : fit.headline, entry.diagnosis_page)});
  }
  if (!entry.picture.empty()) {
    Figure picture{"picture", "", {}, entry.picture};
    picture.csv = entry.picture_csv;
    card.blocks.emplace_back(Figures{{std::move(picture)}});
  }
  card.blocks.emplace_back(summary_table(fit));
  card.blocks.emplace_back(Paragraph{link("All plots and numbers", entry.page)});
  return card;
}

}  // namespace

FitSummary summary_of(const Analysis& a) {
  const FitResult& f = a.fitted;
  FitSummary summary;
  summary.id = a.spec.id;
  if (a.datasets.size() == 1) summary.title = a.datasets.front().title;
  for (const Dataset& dataset : a.datasets) {
    summary.datasets.push_back(dataset.id);
    summary.points += dataset.points.size();
  }
  summary.provenances = provenances(a.datasets);
  for (std::size_t s = 0; s < f.model.slots.size(); ++s) {
    const ParameterSlot& slot = f.model.slots[s];
    if (slot.is_constant()) continue;
    ParameterSummary parameter{
        slot.label(), std::string(slot.parameter->unit), f.theta[s], slot.free, {}, {}};
    const Interval interval = recommended_interval(intervals_of(a, s));
    if (interval.available()) parameter.interval = NumberRange{*interval.lower, *interval.upper};
    for (const TwoPointComparison& comparison : a.uncertainty.two_point) {
      const bool of_dataset =
          s == f.model.slot_C_H[comparison.dataset] || s == f.model.slot_C_A[comparison.dataset];
      if (of_dataset && has_answer(comparison) && s < comparison.result.theta.size()) {
        widen(parameter.two_point, comparison.result.theta[s]);
      }
    }
    summary.parameters.push_back(std::move(parameter));
  }
  summary.rmse = f.rmse;
  for (const TwoPointComparison& comparison : a.uncertainty.two_point) {
    if (has_answer(comparison)) widen(summary.two_point_rmse, comparison.rmse);
  }
  summary.chi2 = f.chi2;
  summary.dof = f.dof;
  if (f.data.sd_stated && f.dof > 0) summary.p_value = f.p_value;
  summary.laws = compared_laws(a.laws, a.datasets);
  return summary;
}

FitSummary summary_of(const Analysis& analysis, const Diagnosis& diagnosis) {
  FitSummary summary = summary_of(analysis);
  summary.verdict = diagnosis.verdict;
  summary.headline = headline(diagnosis);
  return summary;
}

FitSummary read_summary(const std::string& page, const std::string& fit_json,
                        const std::string& diagnosis_json) {
  const Json fit = parsed(page, fit_json, "fit.json");
  FitSummary summary;
  summary.id = text_at(fit, "/fit/id");
  Json datasets = at(fit, "/datasets");
  if (!datasets.is_array()) datasets = Json::array({at(fit, "/dataset")});
  for (const Json& dataset : datasets) {
    summary.datasets.push_back(text_at(dataset, "/id"));
    const std::pair entry{text_at(dataset, "/provenance"),
                          text_at(dataset, "/provenance_sentence")};
    const bool known = std::find(summary.provenances.begin(), summary.provenances.end(), entry) !=
                       summary.provenances.end();
    if (!known && !entry.first.empty()) summary.provenances.push_back(entry);
  }
  if (datasets.size() == 1) summary.title = text_at(fit, "/dataset/title");
  const double points = number_at(fit, "/dataset/points");
  summary.points = points >= 0.0 ? static_cast<std::size_t>(points) : 0;
  const Json parameters = at(fit, "/parameters");
  for (const auto& [label, parameter] : parameters.items()) {
    if (!parameter.is_object()) continue;
    summary.parameters.push_back(
        {label, parameter.value("unit", ""), number_at(parameter, "/value"),
         parameter.value("free", false), read_recommended(parameter),
         read_range(fit, Json::json_pointer("/parameters") / label / "value")});
  }
  summary.rmse = number_at(fit, "/goodness/rmse");
  summary.two_point_rmse = read_range(fit, Json::json_pointer("/rmse"));
  summary.chi2 = number_at(fit, "/goodness/chi2");
  const double dof = number_at(fit, "/goodness/dof");
  summary.dof = std::isfinite(dof) ? static_cast<int>(dof) : 0;
  const double p = number_at(fit, "/goodness/p_value");
  if (std::isfinite(p)) summary.p_value = p;
  if (diagnosis_json.empty()) return summary;
  const Json diagnosis = parsed(page, diagnosis_json, "diagnosis.json");
  summary.verdict = value_named<Verdict>(text_at(diagnosis, "/verdict"));
  summary.headline = text_at(diagnosis, "/headline");
  return summary;
}

Table summary_table(const FitSummary& fit) {
  Table table;
  table.columns = {{}, {"all points"}, {"interval"}, {"two points"}};
  for (const ParameterSummary& parameter : fit.parameters) {
    if (!parameter.free && !is_damping(parameter.label)) continue;
    table.rows.push_back({symbol(parameter.label) + " [" + unit(parameter.unit) + "]",
                          Number{parameter.value, significant(3)}, interval_cell(parameter),
                          range_cell(parameter.two_point)});
  }
  table.rows.push_back(
      {say("rms of {e}"), Number{fit.rmse, significant(3)}, "", range_cell(fit.two_point_rmse)});
  if (fit.dof > 0 && std::isfinite(fit.chi2)) {
    Cell p = "";
    if (fit.p_value) {
      p = say("{p} {}{}", *fit.p_value < 1e-6 ? "" : "= ", p_value_text(*fit.p_value));
    }
    table.rows.push_back(
        {"chi² / dof", say("{} / {}", number(fit.chi2, 4), fit.dof), std::move(p), ""});
  }
  add_laws(fit.laws, table);
  return table;
}

Document index_document(const std::vector<IndexEntry>& entries) {
  Document page;
  page.title = "recoil: fits";
  page.heading = "Impact of microspheres with surfaces";
  page.foot = "recoil " + version();
  page.cards = true;
  page.foreword = {Paragraph{
      say("Each card is one fit: the damping of the contact ({C_H}) and of the adhesion ({C_A}) "
          "from all points, beside the calibration by two points, and whether the model holds."),
      true}};
  if (entries.empty()) page.foreword.emplace_back(Paragraph{"There is no fit yet."});
  for (const IndexEntry& entry : entries) page.sections.push_back(card_of(entry));
  return page;
}

std::string html_index(const std::vector<IndexEntry>& entries) {
  return html_page(index_document(entries));
}

}  // namespace recoil
