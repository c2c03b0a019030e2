#include "validation/studies/coverage_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "document/number.hpp"
#include "plot/draw.hpp"
#include "report/words_dataset.hpp"
#include "validation/studies/study_tables.hpp"

namespace recoil {
namespace {

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
