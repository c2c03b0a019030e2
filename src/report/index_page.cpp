#include "report/index_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/program.hpp"
#include "core/units.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "document/html.hpp"
#include "plot/draw.hpp"
#include "plot/plot.hpp"
#include "report/fit_figures.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_sizes_listed = 4;
constexpr int thumbnail_width = 420;   // [px]
constexpr int thumbnail_height = 270;  // [px]

/// A value of `json`, or null: a key may be missing in files of another version.
Json at(const Json& json, const char* pointer) {
  const Json::json_pointer path(pointer);
  return json.contains(path) ? json.at(path) : Json();
}

std::string text_at(const Json& json, const char* pointer) {
  const Json value = at(json, pointer);
  return value.is_string() ? value.get<std::string>() : std::string();
}

double number_at(const Json& json, const char* pointer) {
  const Json value = at(json, pointer);
  return value.is_number() ? value.get<double>() : NAN;
}

Cell interval_cell(const Json& ends) {
  if (!ends.is_array() || ends.size() != 2 || !ends[0].is_number() || !ends[1].is_number()) {
    return {};
  }
  return NumberRange{ends[0].get<double>(), ends[1].get<double>(), padded(3)};
}

Json parsed(const std::string& page, const std::string& content, const std::string& file) {
  Json json = Json::parse(content, nullptr, false);
  if (!json.is_object()) {
    throw InputError({page}, fmt::format("its {} is not a JSON object", file),
                     "the index is made from it", "run the fit again");
  }
  return json;
}

/// A sign for each verdict, so that no verdict is told by its colour alone.
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

/// Capture velocities of the first sizes, and all free parameters.
Table summary_table(const Json& fit) {
  Table table;
  table.columns = {{"quantity"}, {"estimate"}, {"interval"}};
  std::map<std::string, std::vector<Json>> captures;  // by dataset
  for (const Json& capture : at(fit, "/derived/capture_velocity")) {
    if (!std::isfinite(number_at(capture, "/value"))) continue;
    captures[text_at(capture, "/dataset")].push_back(capture);
  }
  for (auto& [dataset, all] : captures) {
    const bool several = captures.size() > 1;
    if (several) all = {all[all.size() / 2]};  // the middle size of each
    if (all.size() > most_sizes_listed) all.resize(most_sizes_listed);
    for (const Json& capture : all) {
      Sentence name = say("{V*} at {} [m/s]",
                          diameter_sentence(number_at(capture, "/diameter_um") * units::um));
      if (several) name += ", " + dataset;
      table.rows.push_back({std::move(name), Number{number_at(capture, "/value"), padded(3)},
                            interval_cell(at(capture, "/interval"))});
    }
  }
  const Json parameters = at(fit, "/parameters");
  for (const auto& [label, parameter] : parameters.items()) {
    if (!parameter.is_object() || !parameter.value("free", false)) continue;
    const std::string kind = text_at(parameter, "/recommended/interval");
    table.rows.push_back({symbol(label) + " [" + unit(text_at(parameter, "/unit")) + "]",
                          Number{number_at(parameter, "/value"), significant(3)},
                          interval_cell(at(parameter, ("/intervals/" + kind).c_str()))});
  }
  return table;
}

/// "reconstruction": the origin of the points.
std::string origin_of(const Json& datasets) {
  std::vector<std::string> known;
  for (const Json& dataset : datasets) {
    std::string origin = text_at(dataset, "/provenance");
    if (std::find(known.begin(), known.end(), origin) == known.end()) {
      known.push_back(std::move(origin));
    }
  }
  return fmt::format("{}", fmt::join(known, ", "));
}

/// What the origins of all points mean, once.
void add_banners(const IndexEntry& entry, std::vector<Block>& blocks) {
  const Json fit = parsed(entry.page, entry.fit_json, "fit.json");
  for (const Json& dataset : at(fit, "/datasets")) {
    const std::string label = text_at(dataset, "/provenance");
    const bool known = std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) {
      const auto* const banner = std::get_if<Banner>(&block.content());
      return banner != nullptr && banner->label == label;
    });
    if (label.empty() || known) continue;
    blocks.emplace_back(Banner{label, text_at(dataset, "/provenance_sentence")});
  }
}

/// The verdict of the diagnosis with a link to its page; nothing without a diagnosis.
std::vector<Block> verdict_of(const IndexEntry& entry) {
  if (entry.diagnosis_json.empty()) return {};
  const Json diagnosis = parsed(entry.page, entry.diagnosis_json, "diagnosis.json");
  const auto verdict = value_named<Verdict>(text_at(diagnosis, "/verdict"));
  if (!verdict) return {};
  const std::string headline = text_at(diagnosis, "/headline");
  return {Remark{
      to_string(*verdict), sign_of(*verdict),
      link(headline.empty() ? words_of(to_string(*verdict)) : headline, entry.diagnosis_page)}};
}

Section card_of(const IndexEntry& entry) {
  const Json fit = parsed(entry.page, entry.fit_json, "fit.json");
  Json datasets = at(fit, "/datasets");
  if (!datasets.is_array()) datasets = Json::array({at(fit, "/dataset")});
  const std::string id = text_at(fit, "/fit/id");
  const std::string title = datasets.size() == 1 ? text_at(fit, "/dataset/title") : "";
  Section card{
      id,
      title.empty() ? id : title,
      say("{}: {:.0f} points, {}", id, number_at(fit, "/dataset/points"), origin_of(datasets)),
      {},
      entry.page};
  append(card.blocks, verdict_of(entry));
  if (!entry.picture.empty()) {
    Figure picture{"picture", "", {}, entry.picture};
    picture.csv = entry.picture_csv;
    card.blocks.emplace_back(Figures{{std::move(picture)}});
    if (at(fit, "/options/mixed_sizes") == true)
      card.blocks.emplace_back(Paragraph{mean_curve_words});
  }
  card.blocks.emplace_back(summary_table(fit));
  return card;
}

}  // namespace

std::string thumbnail(const Analysis& analysis) {
  plot::Picture picture = restitution_overview(analysis, thumbnail_width, thumbnail_height);
  picture.name = plot::plot_name("overview-" + analysis.spec.id);  // unique on the index
  return plot::draw_svg(picture);
}

std::string thumbnail_csv(const Analysis& analysis) {
  return plot::csv_of(restitution_overview(analysis, thumbnail_width, thumbnail_height));
}

Document index_document(const std::vector<IndexEntry>& entries) {
  Document page;
  page.title = "recoil: fits";
  page.heading = "Impact of microspheres with surfaces";
  page.foot = "recoil " + version();
  page.cards = true;
  page.foreword = {Paragraph{entries.empty()
                                 ? Sentence("There is no fit yet.")
                                 : say("One card per fit: does the model hold, below which {V*} "
                                       "do spheres stick, and the fitted parameters.")}};
  for (const IndexEntry& entry : entries) {
    add_banners(entry, page.foreword);
    page.sections.push_back(card_of(entry));
  }
  return page;
}

std::string html_index(const std::vector<IndexEntry>& entries) {
  return html_page(index_document(entries));
}

}  // namespace recoil
