#include "report/index_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/program.hpp"
#include "document/html.hpp"
#include "mechanism/parameter.hpp"
#include "report/diagnosis_headline.hpp"
#include "report/format.hpp"
#include "report/law_comparison.hpp"
#include "report/result_json.hpp"

namespace recoil {
namespace {

void widen(std::optional<Ends>& range, std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return;
  if (!range) range = {*value, *value};
  range = {std::min((*range)[0], *value), std::max((*range)[1], *value)};
}

/// The contents of one file of a page; a key that it does not have keeps its default.
template <class File>
File parsed(const std::string& page, const std::string& content, const std::string& file) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError({page}, fmt::format("its {}: {}", file, problem), "the index is made from it",
                     "run the fit again");
  };
  const Json json = Json::parse(content, nullptr, false);
  if (json.is_discarded()) refuse("it is not JSON");
  File read;
  try {
    read_json(json, read);
  } catch (const JsonMismatch& mismatch) {
    refuse(mismatch.what());
  }
  return read;
}

/// What the index shows of a diagnosis.json.
struct DiagnosisAnswer {
  std::optional<Verdict> verdict;
  std::string headline;
  RECOIL_FIELDS(verdict, headline)
};

FitSummary summary_of(const FitFile& fit) {
  FitSummary summary;
  summary.id = fit.fit.id;
  if (fit.datasets.size() == 1) summary.title = fit.dataset.title;
  for (const DatasetEntry& dataset : fit.datasets) {
    summary.datasets.push_back(dataset.id);
    const std::pair entry{to_string(dataset.provenance), dataset.provenance_sentence};
    auto& all = summary.provenances;
    if (std::find(all.begin(), all.end(), entry) == all.end()) all.push_back(entry);
  }
  summary.points = fit.dataset.points;
  for (const auto& [label, parameter] : fit.parameters) {
    ParameterSummary& own = summary.parameters.emplace_back();
    own.label = label;
    own.unit = parameter.unit;
    own.value = parameter.value.value.value_or(NAN);
    own.free = parameter.free;
    own.interval = recommended_interval(parameter);
    for (const auto& [id, two_point] : fit.two_point_by_dataset) {
      for (const auto& [name, damping] : two_point.parameters) {
        if (name == label) widen(own.two_point, damping.value.value);
      }
    }
  }
  for (const auto& [id, two_point] : fit.two_point_by_dataset) {
    widen(summary.two_point_rmse, two_point.rmse.value);
  }
  summary.rmse = fit.goodness.rmse.value.value_or(NAN);
  summary.chi2 = fit.goodness.chi2.value.value_or(NAN);
  summary.dof = fit.goodness.dof;
  summary.p_value = fit.goodness.p_value.value;
  return summary;
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

Cell range_cell(const std::optional<Ends>& range) {
  if (!range) return {};
  const std::string first = number((*range)[0], 3);
  const std::string last = number((*range)[1], 3);
  if (first == last) return Number{(*range)[0], significant(3)};
  return say("{} to {}", first, last);
}

Cell interval_cell(const ParameterSummary& parameter) {
  if (!parameter.free) return "fixed";
  if (!parameter.interval) return {};
  return NumberRange{(*parameter.interval)[0], (*parameter.interval)[1], significant(3)};
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

FitSummary summary_of(const Analysis& analysis) {
  FitSummary summary = summary_of(fit_file(analysis));
  summary.laws = compared_laws(analysis.laws, analysis.datasets);
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
  FitSummary summary = summary_of(parsed<FitFile>(page, fit_json, "fit.json"));
  if (diagnosis_json.empty()) return summary;
  const auto diagnosis = parsed<DiagnosisAnswer>(page, diagnosis_json, "diagnosis.json");
  summary.verdict = diagnosis.verdict;
  summary.headline = diagnosis.headline;
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
