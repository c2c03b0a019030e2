#include "validation/studies/coverage_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include "document/number.hpp"
#include "plot/draw.hpp"
#include "report/words_dataset.hpp"
#include "validation/studies/study.hpp"

namespace recoil {
namespace {

constexpr std::array other_intervals = {"profile",    "studentized", "bca",
                                        "percentile", "wald",        "delta"};

using Columns = std::vector<StudyColumn<ParameterCoverage>>;

Cell percent_cell(const std::optional<double>& share) {
  return share ? Cell(Sentence(fmt::format("{:.1f}", 100.0 * *share))) : Cell();
}

Cell width_cell(const std::optional<double>& width) {
  return width ? Cell(Number{*width, significant(3)}) : Cell();
}

/// A column for every kind of interval but the recommended one.
void add_kinds(Columns& columns, const std::function<Cell(const IntervalCoverage&)>& cell) {
  for (const char* kind : other_intervals) {
    columns.push_back({kind, [kind, cell](const ParameterCoverage& row) {
                         const IntervalCoverage* at = row.find(kind);
                         return at == nullptr ? Cell(Sentence()) : cell(*at);
                       }});
  }
}

Table table_of(const std::vector<ParameterCoverage>& rows) {
  using Row = const ParameterCoverage&;
  Columns columns = {
      {"design", [](Row row) { return word_cell(row.design); }, true},
      {"parameter", [](Row row) { return Cell(symbol(row.parameter)); }, true},
      {"well determined, %", [](Row row) { return percent_cell(row.share_identifiable()); }},
      {"actual error, %", [](Row row) { return percent_cell(row.actual_error); }},
      {"recommended, %", [](Row row) { return percent_cell(row.recommended().share()); }},
      {"where well determined, %",
       [](Row row) { return percent_cell(row.recommended().share_identifiable()); }}};
  add_kinds(columns, [](const IntervalCoverage& at) { return percent_cell(at.share()); });
  columns.push_back({"width / truth", [](Row row) { return width_cell(row.relative_width); }});
  columns.push_back(
      {"verdict", [](Row row) { return word_cell(to_string(verdict_of(row))); }, true});
  return study_table(rows, columns);
}

/// Median widths of every kind of interval over the truth; empty where no row has more than that
/// of the recommended one.
Table widths_of(const std::vector<ParameterCoverage>& rows) {
  using Row = const ParameterCoverage&;
  const auto has_more = [](Row row) {
    return std::any_of(row.intervals.begin(), row.intervals.end(), [](const auto& at) {
      return at.first != "recommended" && at.second.relative_width;
    });
  };
  if (std::none_of(rows.begin(), rows.end(), has_more)) return {};
  Columns columns = {{"width / truth", [](Row row) { return word_cell(row.design); }, true},
                     {"parameter", [](Row row) { return Cell(symbol(row.parameter)); }, true},
                     {"recommended", [](Row row) { return width_cell(row.relative_width); }}};
  add_kinds(columns, [](const IntervalCoverage& at) { return width_cell(at.relative_width); });
  return study_table(rows, columns);
}

Sentence truth_words(TruthOrigin origin) {
  return origin == TruthOrigin::recipe
             ? "truth and noise from the recipe, with a different seed for each data set"
             : "the fit's own estimate as truth, simulated independently of the fitter";
}

Sentence tally_words(const CoverageTally& tally) {
  return say(
      "of {} rows {} are nominal, in {} more the verdict warns, {} are too narrow and {} too "
      "wide",
      tally.rows, tally.nominal(), tally.of[CoverageVerdict::warned],
      tally.of[CoverageVerdict::too_narrow], tally.of[CoverageVerdict::too_wide]);
}

Sentence meaning_of_nominal() {
  return say(
      "Nominal: the interval contains the truth in {:.0f} to {:.0f} % of the data sets. Warned: "
      "the verdict called the parameter poorly determined in at least {:.0f} % of them. Where "
      "identifiable: of those in which it did not, which are those with a small estimate of the "
      "error; the level of an interval is that over all.",
      100.0 * least_nominal, 100.0 * most_nominal, 100.0 * least_warned);
}

/// Of the verdict's own coverage: none where no row has it.
std::optional<Sentence> verdict_words(const std::vector<ParameterCoverage>& rows) {
  int judged = 0;
  int misled = 0;
  double most = 0.0;
  for (const ParameterCoverage& row : rows) {
    if (!scatters_too_much(row)) continue;
    ++judged;
    misled += misleads(row) ? 1 : 0;
    most = std::max(most, row.share_identifiable());
  }
  if (judged == 0) return std::nullopt;
  return say(
      "The verdict has a coverage of its own: of {} parameters whose estimates scatter by more "
      "than a tenth of their scale (actual error), {} were called well determined in more than "
      "{:.0f} "
      "% of the data sets, in {:.1f} % at most.",
      judged, misled, 100.0 * most_misled, 100.0 * most);
}

/// What a heading adds where constants are uncertain elsewhere.
Sentence with_materials(const CoverageStudy& study) {
  return study.exact_materials ? Sentence(", constants of the materials taken as exact")
                               : Sentence();
}

Sentence study_words(const CoverageStudy& study) {
  Sentence words = say(
      "{} simulated data sets per design, {} bootstrap replicates each, seed {}, "
      "level {:.0f} %.",
      study.datasets, study.replicates, static_cast<long long>(study.seed), 100.0 * study.level);
  words += Sentence(study.exact_materials
                        ? " The constants of the materials are exact."
                        : " The constants of the materials are drawn anew for every data set from "
                          "what is stated of their errors, and the fits know these errors.");
  if (study.grid_of.has_value()) {
    words +=
        say(" The estimate for {} as truth, simulated independently of the fitter. One "
            "diameter, n points evenly in log V from 1.05 (with captures 0.85) to 50 times "
            "the capture velocity. Scatter: equal (0.02), near-capture (0.01 far above "
            "capture, five times that at it), 10 % of e; its size is stated with the points "
            "or has to be estimated.",
            code(*study.grid_of));
  }
  words += say(" One standard error of a coverage of {:.0f} % is {:.1f} %.", 100.0 * study.level,
               100.0 * std::sqrt(study.level * (1.0 - study.level) / std::max(1, study.datasets)));
  return words;
}

bool is_of_laws(const CoverageStudy& study) { return study.stamp.study == "coverage-laws"; }

/// Of studies that are not of a grid of designs.
Sentence subject_of(const CoverageStudy& study) {
  if (is_of_laws(study)) return "laws that are wrong";
  return study.sources.empty() ? Sentence("noise that is hard to know")
                               : Sentence("the designs of the fits") + with_materials(study);
}

/// How `bent_truth` makes the data sets.
Sentence laws_words() {
  return "The independent simulator makes the impacts at known dampings. It multiplies the loss of "
         "every impact by 1 + g, whose largest size is 1, 3 or 10 %. By velocity: g is a wave of "
         "ln "
         "V, the same for all sizes. By size: every size has a wave of its own. Near capture: g "
         "falls as 1 / V². Phase and sign are drawn for every data set. Or the impacts are those "
         "of "
         "JKR. True are the dampings of the simulator, and the capture velocity at which its "
         "spheres "
         "stick.";
}

Sentence failures_words(const CoverageStudy::Design& design, bool with_truth) {
  Sentence words = code(design.id) + Sentence(": ");
  if (with_truth) words += truth_words(design.truth) + Sentence("; ");
  return words + say("{} fits and {} refits failed", design.fits_failed, design.refits_failed);
}

bool is_warned(CoverageVerdict verdict) {
  return verdict == CoverageVerdict::warned || verdict == CoverageVerdict::nominal_warned;
}
bool is_miss(CoverageVerdict verdict) {
  return verdict == CoverageVerdict::too_narrow || verdict == CoverageVerdict::too_wide;
}

/// The smaller, the worse: misses come first, then rows without a warning, then those that are
/// furthest from the middle of what is wanted. Shares of so many data sets differ by more than
/// 1e-9.
std::tuple<bool, bool, double> badness(const ParameterCoverage& row) {
  constexpr double wanted = 0.5 * (least_nominal + most_nominal);
  const CoverageVerdict verdict = verdict_of(row);
  const double distance = std::abs(row.recommended().share().value_or(0.0) - wanted);
  return {!is_miss(verdict), is_warned(verdict), -std::round(1e9 * distance)};
}

/// One design with what is known of it.
struct GridRow {
  GridDesign design;
  int datasets = 0;
  std::vector<const ParameterCoverage*> rows;

  /// The parameters of which the verdict is so, with `words` of it.
  Cell parameters(bool (*of)(CoverageVerdict), bool with_verdict, const char* none) const {
    std::vector<std::string> list;
    for (const ParameterCoverage* row : rows) {
      const CoverageVerdict verdict = verdict_of(*row);
      if (!of(verdict)) continue;
      list.push_back(row->family() + (with_verdict ? " " + to_string(verdict) : ""));
    }
    if (list.empty()) return *none == '\0' ? Cell() : word_cell(none);
    return word_cell(fmt::format("{}", fmt::join(list, ", ")));
  }
};

Table grid_table(const std::vector<GridRow>& rows) {
  using Row = const GridRow&;
  return study_table<GridRow>(
      rows,
      {{"n", [](Row row) { return word_cell(fmt::format("{}", row.design.points)); }},
       {"scatter", [](Row row) { return word_cell(to_string(row.design.noise)); }, true},
       {"its size",
        [](Row row) { return word_cell(row.design.sd_stated ? "stated" : "estimated"); }, true},
       {"f0", [](Row row) { return word_cell(row.design.adhesion_free ? "free" : "fixed"); }, true},
       {"captures", [](Row row) { return row.design.captures ? word_cell("with") : Cell(); }, true},
       {"data sets", [](Row row) { return word_cell(fmt::format("{}", row.datasets)); }},
       {"worst parameter: truth contained, %",
        [](Row row) {
          const ParameterCoverage& worst = worst_of(row.rows);
          const Cell share = percent_cell(worst.recommended().share());
          return Cell(symbol(worst.family()) + say(": {}", words_of_cell(share)));
        },
        true},
       {"warned, %",
        [](Row row) {
          return word_cell(
              fmt::format("{:.0f}", 100.0 * (1.0 - worst_of(row.rows).share_identifiable())));
        }},
       {"warned of", [](Row row) { return row.parameters(is_warned, false, ""); }, true},
       {"verdict", [](Row row) { return row.parameters(is_miss, true, "nominal"); }, true}});
}

Sentence link_to(const CoverageStudy& study) {
  return link(study.stamp.study + ".md", study.stamp.study + ".md");
}

Section grid_section(const std::vector<const CoverageStudy*>& studies) {
  List tallies;
  CoverageTally all;
  std::vector<GridRow> rows;
  for (const GridDesign& design : coverage_grid()) rows.push_back({design, 0, {}});
  for (const CoverageStudy* study : studies) {
    tallies.entries.push_back(link_to(*study) + say(": {} data sets per design; {}.",
                                                    study->datasets,
                                                    tally_words(tally_of(study->rows))));
    for (const ParameterCoverage& row : study->rows) {
      all.add(row);
      for (GridRow& own : rows) {
        if (own.design.name() != row.design) continue;
        own.datasets = study->datasets;
        own.rows.push_back(&row);
      }
    }
  }
  std::erase_if(rows, [](const GridRow& row) { return row.rows.empty(); });
  Section section{"grid", "Other kinds of data"};
  section.blocks = {
      Paragraph{"One diameter, n points evenly in log V from just above the capture velocity (with "
                "captures below it) to 50 times that; the tables of every parameter and interval:"},
      tallies,
      Paragraph{say("Together, {}. Below, one row per design: its worst parameter with the share "
                    "of the data sets whose recommended interval contains the truth, how often the "
                    "verdict warned of that parameter, and the parameters of which it warned in "
                    "nine of ten.",
                    tally_words(all))},
      Figures{{{"coverage", "Coverage", "Coverage of the recommended intervals", "-"}}},
      grid_table(rows)};
  return section;
}

// ---- the picture -----------------------------------------------------------------------------

constexpr double cell_width = 37.0;  // [px]
constexpr double cell_height = 17.0;
constexpr double left = 270.0, right = 90.0, top = 60.0, bottom = 130.0;
constexpr double tolerated = 0.02;       // about the level: white
constexpr double deepest = 0.15;         // below it the colour gets no deeper
constexpr double warned_at_most = 0.10;  // identifiable: the verdict warned in nine of ten
constexpr const char* judged = "identifiable";

/// A column: of one parameter the coverage of one kind of interval, or how often it is
/// identifiable.
struct PictureColumn {
  std::string parameter, kind;
};

std::vector<PictureColumn> columns_of(const std::vector<ParameterCoverage>& rows) {
  std::vector<std::string> parameters;
  std::set<std::pair<std::string, std::string>> shown;
  for (const ParameterCoverage& row : rows) {
    const std::string name = row.family();
    if (!std::count(parameters.begin(), parameters.end(), name)) parameters.push_back(name);
    if (row.identifiable > 0) shown.insert({name, judged});
    for (const auto& [kind, at] : row.intervals) {
      if (at.share()) shown.insert({name, kind});
    }
  }
  // The capture velocity last: it is derived from the others.
  std::stable_partition(parameters.begin(), parameters.end(),
                        [](const std::string& name) { return name != "V*"; });
  std::vector<PictureColumn> columns;
  for (const std::string& name : parameters) {
    for (const char* kind :
         {judged, "recommended", "profile", "studentized", "bca", "percentile", "wald"}) {
      if (shown.contains({name, kind})) columns.push_back({name, kind});
    }
  }
  return columns;
}

plot::Layer number_at(std::size_t row, std::size_t column, const std::string& number,
                      std::string_view colour) {
  plot::Words words{number, plot::on_axis(static_cast<double>(column)),
                    plot::on_axis(static_cast<double>(row)), plot::Align::centre};
  words.size = 11.0;
  words.colour = std::string(colour);
  return words;
}

}  // namespace

void CoverageTally::add(const ParameterCoverage& row) {
  ++rows;
  ++of[verdict_of(row)];
}

int CoverageTally::nominal() const {
  return of[CoverageVerdict::nominal] + of[CoverageVerdict::nominal_warned];
}

CoverageTally tally_of(const std::vector<ParameterCoverage>& rows) {
  CoverageTally tally;
  for (const ParameterCoverage& row : rows) tally.add(row);
  return tally;
}

const ParameterCoverage& worst_of(const std::vector<const ParameterCoverage*>& rows) {
  return **std::min_element(rows.begin(), rows.end(),
                            [](const auto* a, const auto* b) { return badness(*a) < badness(*b); });
}

Document page_of(const CoverageStudy& study) {
  Document page;
  page.heading = study.grid_of ? Sentence("Coverage by kind of data: ") + code(*study.grid_of)
                               : Sentence("Coverage for ") + subject_of(study);
  page.foreword.emplace_back(Paragraph{study_words(study)});
  if (is_of_laws(study)) page.foreword.emplace_back(Paragraph{laws_words()});
  page.foreword.emplace_back(
      Paragraph{as_sentence(tally_words(tally_of(study.rows))) + " " + meaning_of_nominal()});
  if (const auto words = verdict_words(study.rows)) {
    page.foreword.emplace_back(Paragraph{*words});
  }
  if (!study.grid_of) {
    List designs;
    for (const CoverageStudy::Design& design : study.designs) {
      if (is_of_laws(study) && design.fits_failed + design.refits_failed == 0) continue;
      designs.entries.push_back(failures_words(design, !is_of_laws(study)));
    }
    page.foreword.emplace_back(std::move(designs));
  }
  if (study.grid_of && !study.stamp.study.empty()) {
    page.foreword.emplace_back(
        Figures{{{study.stamp.study, "Coverage", "Coverage by kind of data", "-"}}});
  }
  page.foreword.emplace_back(table_of(study.rows));
  page.foreword.emplace_back(widths_of(study.rows));
  List sources;
  for (const CoverageStudy::Source& source : study.sources) {
    sources.entries.push_back(code(source.id) +
                              Sentence(": " + provenance_sentence(source.provenance)));
  }
  page.foreword.emplace_back(std::move(sources));
  append(page.foreword, stamp_blocks(study.stamp));
  return page;
}

Document coverage_summary(const std::vector<CoverageStudy>& studies) {
  Document page;
  page.heading = "Coverage of the intervals";
  page.foreword.emplace_back(Paragraph{meaning_of_nominal()});
  std::vector<const CoverageStudy*> grids;
  for (const CoverageStudy& study : studies) {
    if (study.grid_of.has_value()) {
      grids.push_back(&study);
      continue;
    }
    Section section{study.stamp.study.substr(std::string("coverage-").size()),
                    is_of_laws(study) ? Sentence("Laws that are wrong")
                    : study.sources.empty()
                        ? Sentence("Noise that is hard to know")
                        : Sentence("The shipped designs") + with_materials(study)};
    section.blocks = {Paragraph{say("{} data sets each (", study.datasets) +
                                link("how they were made", study.stamp.study + ".md") +
                                say("); {}.", tally_words(tally_of(study.rows)))},
                      table_of(study.rows)};
    page.sections.push_back(std::move(section));
  }
  if (!grids.empty()) page.sections.push_back(grid_section(grids));
  return page;
}

plot::ColourScale coverage_colours(double level) {
  const plot::Range range{level - deepest, 1.0};
  const auto at = [&](double share) { return (share - range.lower) / range.width(); };
  constexpr double step = 1e-9;  // from white to the first visible colour
  return {"coverage",
          range,
          {{0.0, plot::vermillion},
           {at(level - tolerated) - 2.0 * step, "#f5d6bf"},
           {at(level - tolerated) - step, "#ffffff"},
           {at(level + tolerated) + step, "#ffffff"},
           {at(level + tolerated) + 2.0 * step, "#bfdceb"},
           {1.0, plot::blue}},
          ""};
}

plot::Picture coverage_picture(const CoverageStudy& study) {
  const std::string title = fmt::format(
      "Coverage of {} intervals by kind of data, {}: {} data sets per design, {} bootstrap "
      "replicates each",
      percent(study.level), study.grid_of.value_or(""), study.datasets, study.replicates);
  const CoverageStudy::Source& source = study.sources.front();
  return coverage_picture(study.rows, study.level, title,
                          source.provenance == Provenance::reconstruction
                              ? source.id + ": a reconstruction, no point of it was measured"
                              : source.id + ": " + to_string(source.provenance));
}

plot::Picture coverage_picture(const std::vector<ParameterCoverage>& rows, double level,
                               const std::string& title, const std::string& remark) {
  const std::vector<PictureColumn> columns = columns_of(rows);
  std::vector<std::string> designs, labels;
  for (const GridDesign& design : coverage_grid()) {
    if (std::any_of(rows.begin(), rows.end(),
                    [&](const ParameterCoverage& row) { return row.design == design.name(); })) {
      designs.push_back(design.name());
    }
  }
  for (const PictureColumn& column : columns)
    labels.push_back(column.parameter + " " + column.kind);
  plot::Plot panel = table_plot(designs, labels, 11.0);
  panel.heading = title;
  panel.remark =
      "% of data sets whose interval contains the truth; pale: the verdict warned in "
      "nine of ten. " +
      remark;
  panel.colours = coverage_colours(level);
  plot::Boxes veil;  // over what the verdict warned of
  veil.fill = {"#ffffff", 0.55};
  std::vector<plot::Layer> numbers;
  for (const ParameterCoverage& row : rows) {
    const auto design = std::find(designs.begin(), designs.end(), row.design);
    if (design == designs.end()) continue;
    const auto r = static_cast<std::size_t>(design - designs.begin());
    bool warned = false;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (columns[c].parameter != row.family()) continue;
      if (columns[c].kind == judged) {
        warned = row.share_identifiable() <= warned_at_most;
        numbers.push_back(
            number_at(r, c, fmt::format("{:.0f}", 100.0 * row.share_identifiable()), plot::grey));
        continue;
      }
      const IntervalCoverage* at = row.find(columns[c].kind);
      const std::optional<double> share = at == nullptr ? std::nullopt : at->share();
      if (!share) continue;
      add_cell(std::get<plot::Boxes>(panel.layers.front()), r, c).values.push_back(*share);
      if (warned) add_cell(veil, r, c);
      const bool on_blue = !warned && *share > 0.5 * (1.0 + level + tolerated);
      numbers.push_back(number_at(r, c, fmt::format("{:.1f}", 100.0 * *share),
                                  on_blue ? std::string_view("#ffffff") : plot::ink));
    }
  }
  panel.layers.emplace_back(std::move(veil));
  std::move(numbers.begin(), numbers.end(), std::back_inserter(panel.layers));
  plot::Picture picture{"coverage", title};
  picture.width = static_cast<int>(
      std::max(left + cell_width * static_cast<double>(columns.size()) + right, 980.0));
  picture.height =
      static_cast<int>(top + cell_height * static_cast<double>(designs.size()) + bottom);
  panel.frame = plot::Frame{left, picture.width - right, bottom, picture.height - top};
  picture.plots.push_back(std::move(panel));
  return picture;
}

}  // namespace recoil
