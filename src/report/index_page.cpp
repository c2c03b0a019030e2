#include "report/index_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/program.hpp"
#include "core/quoting.hpp"
#include "core/units.hpp"
#include "data/text.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "document/html.hpp"
#include "json/fit_file.hpp"
#include "report/fit_report.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_sizes_listed = 4;
constexpr int thumbnail_width = 420;   // [px]
constexpr int thumbnail_height = 270;  // [px]

/// The key of diagnosis.json that a card shows.
struct ShownDiagnosis {
  std::string headline;
  RECOIL_FIELDS(headline)
};

/// Parses a fit.json or diagnosis.json.
/// @param page, file for messages
template <class File>
File contents_of(const std::string& page, const std::string& json, const std::string& file) {
  try {
    const Json read = parse_json(json);
    if (read.is_object()) return value_from<File>(read);
  } catch (const JsonMismatch&) {
  }
  throw InputError({page}, fmt::format("its {} is not the JSON of a result", file),
                   "the index is made from it", "run the fit again");
}

Cell ends_cell(const std::optional<Ends>& ends) {
  return ends ? Cell(NumberRange{(*ends)[0], (*ends)[1], padded(3)}) : Cell();
}

/// A sign for each verdict, so that its meaning does not depend on colour.
const char* sign_of(ModelVerdict verdict) {
  using enum ModelVerdict;
  static constexpr Phrase<ModelVerdict> phrases[] = {{fits, "✓"},
                                                     {fits_with_moved_constants, "✓"},
                                                     {fits_within_law_error, "≈"},
                                                     {does_not_fit, "✗"},
                                                     {untested, "?"}};
  return phrase_for(phrases, verdict).words;
}

/// Capture velocities of some sizes, and all free parameters.
Table summary_table(const FitFile& fit) {
  using Capture = FitFile::CaptureVelocity;
  Table table;
  table.columns = {{"quantity"}, {"estimate"}, {"interval"}};
  std::map<std::string, std::vector<Capture>> captures;  // by dataset
  for (const Capture& capture : fit.derived.capture_velocity) {
    if (capture.value.value) captures[capture.dataset].push_back(capture);
  }
  for (auto& [dataset, all] : captures) {
    const bool several = captures.size() > 1;
    if (several) all = {all[all.size() / 2]};  // the middle size
    if (all.size() > most_sizes_listed) all.resize(most_sizes_listed);
    for (const Capture& capture : all) {
      Sentence name =
          say("{V*} at {} [m/s]", diameter_sentence(capture.diameter_um.value_or(NAN) * units::um));
      if (several) name += ", " + dataset;
      table.rows.push_back(
          {std::move(name), Number{*capture.value.value, padded(3)}, ends_cell(capture.interval)});
    }
  }
  for (const auto& [label, parameter] : fit.parameters) {
    if (!parameter.free) continue;
    table.rows.push_back({name_with_unit(symbol(label), parameter.unit),
                          Number{parameter.value.value.value_or(NAN), significant(3)},
                          ends_cell(recommended_interval(parameter))});
  }
  return table;
}

/// The provenances of the datasets: "measured, reconstruction".
std::string provenances_of(const std::vector<DatasetEntry>& datasets) {
  std::vector<std::string_view> known;
  for (const DatasetEntry& dataset : datasets) {
    const std::string_view name = name_of(dataset.provenance);
    if (std::ranges::find(known, name) == known.end()) known.push_back(name);
  }
  return fmt::format("{}", fmt::join(known, ", "));
}

/// Adds a banner for each provenance that has none yet.
void add_banners(const FitFile& fit, Blocks& blocks) {
  for (const DatasetEntry& dataset : fit.datasets) {
    const std::string label = to_string(dataset.provenance);
    const bool known = std::ranges::any_of(blocks, [&](const Block& block) {
      const auto* const banner = std::get_if<Banner>(&block.content());
      return banner != nullptr && banner->label == label;
    });
    if (!known) blocks.emplace_back(Banner{label, dataset.provenance_sentence});
  }
}

/// The verdict on the model; with a diagnosis also the cause, and a link to its page.
Blocks verdict_of(const IndexEntry& entry, const FitFile& fit) {
  const ModelVerdict verdict = fit.model_verdict.verdict;
  Sentence text = fit.model_verdict.text;
  if (!entry.diagnosis_json.empty()) {
    text = link(
        contents_of<ShownDiagnosis>(entry.page, entry.diagnosis_json, "diagnosis.json").headline,
        entry.diagnosis_page);
  }
  return {Remark{to_string(verdict), sign_of(verdict), text}};
}

/// All fits, one in a row.
Table fits_table(const std::vector<IndexEntry>& entries, const std::vector<FitFile>& fits) {
  Table table;
  table.compact = true;
  table.columns = {{"fit"},
                   {"points are", "", true},
                   {"points"},
                   {"model", "", true},
                   {say("{V*}"), "m/s"},
                   {symbol("C_H"), "s/m"},
                   {symbol("C_A"), "s/m"}};
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const FitFile& fit = fits[i];
    Cell capture;  // of the middle size
    const auto& captures = fit.derived.capture_velocity;
    if (!captures.empty()) {
      if (const auto& middle = captures[captures.size() / 2]; middle.value.value) {
        capture = say("{} at {}", number(*middle.value.value, 3),
                      diameter_sentence(middle.diameter_um.value_or(NAN) * units::um));
      }
    }
    const auto value = [&](std::string_view label) -> Cell {
      for (const auto& [name, parameter] : fit.parameters) {
        if (name == label && parameter.free && parameter.value.value) {
          return Number{*parameter.value.value, significant(3)};
        }
      }
      return {};
    };
    const ModelVerdict verdict = fit.model_verdict.verdict;
    table.rows.push_back({link(fit.fit.id, entries[i].page), Sentence(provenances_of(fit.datasets)),
                          whole(fit.dataset.points),
                          Sentence(sign_of(verdict) + (" " + words_of(to_string(verdict)))),
                          capture, value("C_H"), value("C_A")});
  }
  return table;
}

Section card_of(const IndexEntry& entry, const FitFile& fit) {
  const std::string title = fit.datasets.size() == 1 ? fit.datasets.front().title : "";
  Section card{fit.fit.id,
               title.empty() ? fit.fit.id : title,
               say("{}: {}, {}", fit.fit.id, counted(fit.dataset.points, "point"),
                   provenances_of(fit.datasets)),
               {},
               entry.page};
  append(card.blocks, verdict_of(entry, fit));
  if (!entry.picture.empty()) {
    Figure picture{"picture", "", {}, entry.picture};
    picture.csv = entry.picture_csv;
    card.blocks.emplace_back(Figures{{picture}});
    if (fit.options.mixed_sizes) card.blocks.emplace_back(Paragraph{mean_curve_words});
  }
  card.blocks.emplace_back(summary_table(fit));
  return card;
}

}  // namespace

plot::Picture thumbnail(const Analysis& analysis) {
  plot::Picture picture = restitution_overview(analysis, thumbnail_width, thumbnail_height);
  picture.name = plot::plot_name("overview-" + analysis.spec.id);  // unique on the index
  return picture;
}

std::string title_of_page(const std::string& html) {
  const std::string opening = "<title>";
  const std::size_t begin = html.find(opening);
  const std::size_t end = html.find("</title>");
  const bool ours = html.find("<footer>recoil ") != std::string::npos;
  if (!ours || begin == std::string::npos || end == std::string::npos) return "";
  std::string title = html.substr(begin + opening.size(), end - begin - opening.size());
  for (const char sign : {'<', '>', '"', '\'', '&'}) {
    replace_all(title, escape_html(std::string(1, sign)), std::string(1, sign));
  }
  return title;
}

Document index_document(const std::vector<IndexEntry>& entries,
                        const std::vector<Sentence>& others) {
  Document page;
  page.title = "recoil: fits";
  page.heading = "Impact of microspheres with surfaces";
  page.foot = "recoil " + version();
  page.cards = true;
  page.foreword = {Paragraph{
      entries.empty()
          ? Sentence("There is no fit yet.")
          : say("One card per fit: verdict, capture velocity {V*} and fitted parameters.")}};
  if (!others.empty())
    page.foreword.emplace_back(Paragraph{say("Also here: {}.", join(others, ", "))});
  std::vector<FitFile> fits;
  for (const IndexEntry& entry : entries) {
    fits.push_back(contents_of<FitFile>(entry.page, entry.fit_json, "fit.json"));
    add_banners(fits.back(), page.foreword);
    page.sections.push_back(card_of(entry, fits.back()));
  }
  if (fits.size() > 1) page.foreword.emplace_back(fits_table(entries, fits));
  return page;
}

}  // namespace recoil
