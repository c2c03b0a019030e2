#include "studies/coverage_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "document/html.hpp"
#include "document/number.hpp"

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

std::string mixed(const Colour& end, double part) {
  const auto channel = [part](double value) {
    return static_cast<int>(std::lround(255.0 + part * (value - 255.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(end.red), channel(end.green),
                     channel(end.blue));
}

/// 0 within what is tolerated, then from a first visible step to 1.
double depth(double share, double level) {
  const double off = std::abs(share - level);
  if (off <= tolerated + 1e-12) return 0.0;
  const double room = share < level ? deepest : 1.0 - level;
  constexpr double first = 0.25;
  const double part = (off - tolerated) / std::max(room - tolerated, 1e-9);
  return std::clamp(first + (1.0 - first) * part, 0.0, 1.0);
}

std::string text_at(double x, double y, const std::string& text, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, more,
                     escape_html(text));
}

std::string box(double x, double y, double width, const std::string& fill) {
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
      "fill=\"{}\"/>\n",
      x, y, width, cell_height, fill);
}

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
    for (const IntervalCoverage& at : row.intervals) {
      if (at.share()) kinds[static_cast<std::size_t>(group - groups.begin())].insert(at.interval);
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

std::string cells_of(const Group& group, const ParameterCoverage& row, double level, double y) {
  std::string out;
  double x = group.x;
  const double baseline = y + cell_height - 5.0;
  const bool warned = group.judged && row.share_identifiable() <= warned_at_most;
  const std::string middle = " text-anchor=\"middle\"";
  if (group.judged) {
    out += text_at(x + cell_width / 2.0, baseline,
                   fmt::format("{:.0f}", 100.0 * row.share_identifiable()),
                   middle + " fill=\"#777777\"");
    x += cell_width;
  }
  for (const std::string& kind : group.kinds) {
    const IntervalCoverage* at = row.find(kind);
    const std::optional<double> share = at == nullptr ? std::nullopt : at->share();
    if (share) {
      out += fmt::format("<g{}>", warned ? " opacity=\"0.45\"" : "");
      out += box(x, y, cell_width, coverage_colour(*share, level));
      out += text_at(x + cell_width / 2.0, baseline, fmt::format("{:.1f}", 100.0 * *share),
                     middle + (white_letters(*share, level) ? " fill=\"#ffffff\"" : "") +
                         (kind == "recommended" ? " font-weight=\"bold\"" : ""));
      out += "</g>\n";
    }
    x += cell_width;
  }
  return out;
}

std::string heads(const std::vector<Group>& groups) {
  std::string out;
  double x = margin;
  for (const DesignColumn& column : design_columns) {
    out += text_at(x, head_height - 6.0, column.head, " fill=\"#555555\"");
    x += column.width;
  }
  for (const Group& group : groups) {
    out += text_at(group.x, head_height - 52.0, group.parameter,
                   " font-weight=\"bold\" font-size=\"13\"");
    double at = group.x + cell_width / 2.0;
    const auto slanted = [&](const std::string& words, const char* more) {
      out += fmt::format("<text transform=\"translate({:.1f},{:.1f}) rotate(-35)\"{}>{}</text>\n",
                         at - 8.0, head_height - 6.0, more, escape_html(words));
      at += cell_width;
    };
    if (group.judged) slanted("identif.", " fill=\"#555555\"");
    for (const std::string& kind : group.kinds) {
      const std::string name = kind == "recommended"   ? "recomm."
                               : kind == "percentile"  ? "percent."
                               : kind == "studentized" ? "student."
                               : kind == "bca"         ? "BCa"
                               : kind == "wald"        ? "Wald"
                                                       : kind;
      slanted(name, kind == "recommended" ? " font-weight=\"bold\"" : "");
    }
  }
  return out;
}

std::string legend(double y, double level) {
  std::string out = text_at(margin, y, "coverage:", " fill=\"#555555\"");
  double x = margin + 66.0;
  for (const double off : {-0.15, -0.10, -0.06, -0.03, 0.0, 0.03, 1.0}) {
    const double share = std::min(level + off, 1.0);
    out += box(x, y - 12.0, cell_width + 6.0, coverage_colour(share, level));
    out += text_at(x + cell_width / 2.0 + 3.0, y,
                   fmt::format("{}{:.0f}", off == -0.15 ? "≤ " : "", 100.0 * share),
                   fmt::format(" text-anchor=\"middle\"{}",
                               white_letters(share, level) ? " fill=\"#ffffff\"" : ""));
    x += cell_width + 6.0;
  }
  return out + text_at(margin, y + line_height,
                       "% of data sets whose interval contains the truth; identif.: % in which the "
                       "verdict calls the parameter identifiable; pale: 10 % or fewer",
                       " fill=\"#555555\"");
}

}  // namespace

std::string coverage_colour(double share, double level) {
  return mixed(share < level ? orange : blue, depth(share, level));
}

std::string coverage_picture(const CoverageStudy& study) {
  const std::string title = fmt::format(
      "Coverage of {} intervals by kind of data, {}: {} data sets per design, {} bootstrap "
      "replicates each",
      percent(study.level), study.grid_of, study.datasets, study.replicates);
  const CoverageStudy::Source& source = study.sources.front();
  return coverage_picture(study.rows, study.level, title,
                          fmt::format("{}: {}", source.id, provenance_sentence(source.provenance)));
}

std::string coverage_picture(const std::vector<ParameterCoverage>& rows, double level,
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
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" role=\"img\" font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, "
      "sans-serif\" font-size=\"11\" fill=\"#222222\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width, height, escape_html(title));
  out += text_at(margin, 20.0, title, " font-size=\"14\"") + heads(groups);
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const GridDesign& design = designs[i];
    const double y = head_height + cell_height * static_cast<double>(i);
    const bool new_size = i == 0 || designs[i - 1].points != design.points;
    const bool new_noise = new_size || designs[i - 1].noise != design.noise;
    if (new_noise) {
      out += fmt::format("<path d=\"M{:.1f},{:.1f}H{:.1f}\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
                         margin, y, x - group_gap, new_size ? "#555555" : "#cccccc",
                         new_size ? 1.2 : 0.8);
    }
    double at = margin;
    for (const DesignColumn& column : design_columns) {
      out += text_at(at, y + cell_height - 5.0, column.words(design));
      at += column.width;
    }
    for (const Group& group : groups) {
      for (const ParameterCoverage& row : rows) {
        if (row.design == design.name() && family(row.parameter) == group.parameter) {
          out += cells_of(group, row, level, y);
        }
      }
    }
  }
  out += legend(bottom + 26.0, level);
  out += text_at(margin, bottom + 26.0 + 2.0 * line_height, remark, " fill=\"#555555\"");
  return out + "</svg>\n";
}

}  // namespace recoil
