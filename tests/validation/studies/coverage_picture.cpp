#include "validation/studies/coverage_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "document/number.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

constexpr double cell_width = 37.0;
constexpr double cell_height = 17.0;
constexpr double margin = 14.0;
constexpr double head_height = 92.0;
constexpr double foot_height = 84.0;
constexpr double line_height = 22.0;  // below the cells
constexpr double group_gap = 10.0;
constexpr double tolerated = 0.02;       // about the level: white
constexpr double deepest = 0.15;         // below it the colour gets no deeper
constexpr double warned_at_most = 0.10;  // identifiable: the verdict warned in nine of ten

struct Colour {
  double red, green, blue;
};
// Ends of the diverging scale, from Okabe & Ito (2008): told apart by colour-blind readers.
constexpr Colour orange = {213, 94, 0};
constexpr Colour blue = {0, 114, 178};

/// Something of the way from white to `end`.
std::string mixed(const Colour& end, double part) {
  const auto channel = [part](double value) {
    return static_cast<int>(std::lround(255.0 + part * (value - 255.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(end.red), channel(end.green),
                     channel(end.blue));
}

/// A cell whose verdict warned: paler.
constexpr double pale = 0.45;

/// 0 within what is tolerated, then from a first visible step to 1.
double depth(double share, double level) {
  const double off = std::abs(share - level);
  if (off <= tolerated + 1e-12) return 0.0;
  const double room = share < level ? deepest : 1.0 - level;
  constexpr double first = 0.25;
  const double part = (off - tolerated) / std::max(room - tolerated, 1e-9);
  return std::clamp(first + (1.0 - first) * part, 0.0, 1.0);
}

constexpr std::string_view soft = "#555555";

/// A table as a plot whose axes count pixels from the upper left.
struct Sheet {
  plot::Boxes cells;
  std::vector<plot::Layer> words;
  std::vector<plot::Layer> lines;

  plot::Words& say(double x, double y, const std::string& text,
                   std::string_view colour = plot::ink) {
    plot::Words one{text, plot::on_axis(x), plot::on_axis(y)};
    one.size = 11.0;
    one.colour = std::string(colour);
    words.push_back(std::move(one));
    return std::get<plot::Words>(words.back());
  }

  void cell(double x, double y, double width, const std::string& colour) {
    cells.add(x, x + width, y, y + cell_height);
    cells.colours.push_back(colour);
  }

  /// A cell with its number in the middle.
  void cell(double x, double y, double width, const std::string& colour, const std::string& number,
            std::string_view ink) {
    cell(x, y, width, colour);
    say(x + width / 2.0, y + cell_height / 2.0, number, ink).align = plot::Align::centre;
  }
};

/// White letters on the deep blue, dark ones on everything else (the orange included), whichever
/// contrasts more.
bool white_letters(double share, double level) {
  return share > level && depth(share, level) > 0.75;
}

/// What a parameter is called in every design: "V*" for "V*(4.90 um)".
std::string family(const std::string& parameter) {
  return parameter.substr(0, parameter.find('('));
}

/// One parameter's columns.
struct Group {
  std::string parameter;
  std::string unit;
  bool judged = false;  // does the verdict speak of it?
  std::vector<std::string> kinds;
  double x = 0.0;

  double width() const { return cell_width * static_cast<double>(kinds.size() + (judged ? 1 : 0)); }
};

const std::array<const char*, 6> all_kinds = {"recommended", "profile",    "studentized",
                                              "bca",         "percentile", "wald"};

std::vector<Group> groups_of(const std::vector<ParameterCoverage>& rows) {
  std::vector<Group> groups;
  std::vector<std::set<std::string>> kinds;
  for (const ParameterCoverage& row : rows) {
    const std::string name = family(row.parameter);
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.parameter == name; });
    if (group == groups.end()) {
      groups.push_back({name, row.unit, false, {}, 0.0});
      kinds.emplace_back();
      group = groups.end() - 1;
    }
    group->judged = group->judged || row.identifiable > 0;
    for (const auto& [kind, at] : row.intervals) {
      if (at.share()) kinds[static_cast<std::size_t>(group - groups.begin())].insert(kind);
    }
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const char* kind : all_kinds) {
      if (kinds[g].contains(kind)) groups[g].kinds.emplace_back(kind);
    }
  }
  // The capture velocity last: it is derived from the others.
  std::stable_partition(groups.begin(), groups.end(),
                        [](const Group& group) { return group.parameter != "V*"; });
  return groups;
}

struct DesignColumn {
  const char* head;
  double width;
  std::string (*words)(const GridDesign&);
};

const std::array<DesignColumn, 5> design_columns = {{
    {"points", 44.0, [](const GridDesign& d) { return fmt::format("{}", d.points); }},
    {"scatter", 80.0, [](const GridDesign& d) { return to_string(d.noise); }},
    {"its size", 66.0,
     [](const GridDesign& d) { return std::string(d.sd_stated ? "stated" : "estimated"); }},
    {"f0", 40.0,
     [](const GridDesign& d) { return std::string(d.adhesion_free ? "free" : "fixed"); }},
    {"captures", 62.0, [](const GridDesign& d) { return std::string(d.captures ? "with" : "–"); }},
}};

void add_cells(Sheet& sheet, const Group& group, const ParameterCoverage& row, double level,
               double y) {
  double x = group.x;
  const double middle = y + cell_height / 2.0;
  const bool warned = group.judged && row.share_identifiable() <= warned_at_most;
  if (group.judged) {
    sheet
        .say(x + cell_width / 2.0, middle, fmt::format("{:.0f}", 100.0 * row.share_identifiable()),
             plot::grey)
        .align = plot::Align::centre;
    x += cell_width;
  }
  for (const std::string& kind : group.kinds) {
    const IntervalCoverage* at = row.find(kind);
    const std::optional<double> share = at == nullptr ? std::nullopt : at->share();
    if (share) {
      const double strength = warned ? pale : 1.0;
      const Colour& end = *share < level ? orange : blue;
      const std::string_view ink = warned                         ? "#9a9a9a"
                                   : white_letters(*share, level) ? "#ffffff"
                                                                  : plot::ink;
      sheet.cell(x, y, cell_width, mixed(end, strength * depth(*share, level)),
                 fmt::format("{:.1f}", 100.0 * *share), ink);
      std::get<plot::Words>(sheet.words.back()).bold = kind == "recommended";
    }
    x += cell_width;
  }
}

void add_heads(Sheet& sheet, const std::vector<Group>& groups) {
  double x = margin;
  for (const DesignColumn& column : design_columns) {
    sheet.say(x, head_height - 10.0, column.head, soft);
    x += column.width;
  }
  for (const Group& group : groups) {
    plot::Words& name = sheet.say(group.x, head_height - 56.0, group.parameter);
    name.bold = true;
    name.size = 13.0;
    double at = group.x + cell_width / 2.0;
    const auto slanted = [&](const std::string& words) -> plot::Words& {
      plot::Words& head = sheet.say(at - 8.0, head_height - 9.0, words);
      head.turned = 35.0;
      at += cell_width;
      return head;
    };
    if (group.judged) slanted("identif.").colour = soft;
    for (const std::string& kind : group.kinds) {
      const std::string short_name = kind == "recommended"   ? "recomm."
                                     : kind == "percentile"  ? "percent."
                                     : kind == "studentized" ? "student."
                                     : kind == "bca"         ? "BCa"
                                     : kind == "wald"        ? "Wald"
                                                             : kind;
      slanted(short_name).bold = kind == "recommended";
    }
  }
}

void add_legend(Sheet& sheet, double y, double level, const std::string& remark) {
  const double middle = y + cell_height / 2.0;
  sheet.say(margin, middle, "coverage:", soft);
  double x = margin + 66.0;
  for (const double off : {-0.15, -0.10, -0.06, -0.03, 0.0, 0.03, 1.0}) {
    const double share = std::min(level + off, 1.0);
    sheet.cell(x, y, cell_width + 6.0, coverage_colour(share, level),
               fmt::format("{}{:.0f}", off == -0.15 ? "≤ " : "", 100.0 * share),
               white_letters(share, level) ? std::string_view("#ffffff") : plot::ink);
    x += cell_width + 6.0;
  }
  sheet.say(margin, middle + line_height,
            "% of data sets whose interval contains the truth; identif.: % in which the verdict "
            "calls the parameter identifiable; pale: 10 % or fewer",
            soft);
  sheet.say(margin, middle + 2.0 * line_height, remark, soft);
}

}  // namespace

std::string coverage_colour(double share, double level) {
  return mixed(share < level ? orange : blue, depth(share, level));
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
  std::vector<Group> groups = groups_of(rows);
  double x = margin;
  for (const DesignColumn& column : design_columns) x += column.width;
  for (Group& group : groups) {
    group.x = x;
    x += group.width() + group_gap;
  }
  std::vector<GridDesign> designs;
  for (const GridDesign& design : coverage_grid()) {
    if (std::any_of(rows.begin(), rows.end(),
                    [&](const ParameterCoverage& row) { return row.design == design.name(); })) {
      designs.push_back(design);
    }
  }
  constexpr double narrowest = 980.0;  // of the legend
  const double width = std::max(x + margin, narrowest);
  const double bottom = head_height + cell_height * static_cast<double>(designs.size());
  const double height = bottom + foot_height;
  Sheet sheet;
  sheet.say(margin, 16.0, title).size = 14.0;
  add_heads(sheet, groups);
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const GridDesign& design = designs[i];
    const double y = head_height + cell_height * static_cast<double>(i);
    const bool new_size = i == 0 || designs[i - 1].points != design.points;
    const bool new_noise = new_size || designs[i - 1].noise != design.noise;
    if (new_noise) {
      sheet.lines.push_back(
          plot::Line{{margin, x - group_gap},
                     {y, y},
                     {new_size ? soft : std::string_view("#cccccc"), new_size ? 1.2 : 0.8}});
    }
    double at = margin;
    for (const DesignColumn& column : design_columns) {
      sheet.say(at, y + cell_height / 2.0, column.words(design));
      at += column.width;
    }
    for (const Group& group : groups) {
      for (const ParameterCoverage& row : rows) {
        if (row.design == design.name() && family(row.parameter) == group.parameter) {
          add_cells(sheet, group, row, level, y);
        }
      }
    }
  }
  add_legend(sheet, bottom + 14.0, level, remark);

  plot::Plot shown;
  shown.bare = true;
  shown.frame = plot::Frame{0.0, width, 0.0, height};
  shown.x.set_range({0.0, width});
  shown.y.set_range({height, 0.0});
  shown.layers.push_back(std::move(sheet.cells));
  for (auto* layers : {&sheet.lines, &sheet.words}) {
    std::move(layers->begin(), layers->end(), std::back_inserter(shown.layers));
  }
  return {"coverage", title, static_cast<int>(width), static_cast<int>(height), {std::move(shown)}};
}

}  // namespace recoil
