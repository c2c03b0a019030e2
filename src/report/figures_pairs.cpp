#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "report/figure_style.hpp"
#include "report/figures.hpp"
#include "report/format.hpp"
#include "report/pair_words.hpp"
#include "report/svg_plot.hpp"

namespace recoil {
namespace {

constexpr double picture_width = 860.0;
constexpr double row_height = 205.0;
constexpr double key_height = 58.0;
constexpr double foot_height = 62.0;
constexpr std::size_t most_pictures = 4;  // per page, so that it stays under 1 MB
constexpr std::size_t columns = 2;

// From dark to light, after viridis, without the yellow that fades on white.
constexpr std::array<style::Marker, 5> shades = {
    {{"#440154", 7}, {"#3b528b", 5}, {"#21908d", 9}, {"#5dc863", 13}, {"#b8c431", 11}}};

using Value = std::function<std::optional<double>(const PairQuality&)>;

/// One panel: a number of each pair against the lower velocity.
struct Quantity {
  std::string label;
  Value value;
  std::optional<double> full;  ///< the full fit's, a line
  bool log_scale = false;
  bool from_zero = false;
};

std::optional<double> in_percent(std::optional<double> value) {
  if (value) *value *= 100.0;
  return value;
}

std::vector<Quantity> quantities(const PairStudy& study) {
  const auto figure = [&study](std::optional<double> PairFigures::*member) {
    return [&study, member](const PairQuality& pair) { return figures_of(study, pair).*member; };
  };
  const auto percent_of = [](const Value& value) {
    return [value](const PairQuality& pair) { return in_percent(value(pair)); };
  };
  std::vector<Quantity> all;
  all.push_back({"bias of C_{H}  [%]", percent_of(figure(&PairFigures::bias_C_H)), 0.0});
  all.push_back({"bias of C_{A}  [%]", percent_of(figure(&PairFigures::bias_C_A)), 0.0});
  all.push_back(
      {"spread of C_{H} over that of the full fit", figure(&PairFigures::spread_C_H), 1.0, true});
  all.push_back(
      {"spread of C_{A} over that of the full fit", figure(&PairFigures::spread_C_A), 1.0, true});
  all.push_back({"data sets without an answer  [%]",
                 [](const PairQuality& pair) -> std::optional<double> {
                   return 100.0 * pair.without_answer();
                 },
                 0.0, false, true});
  all.push_back({"held-out error of e, same diameter",
                 [](const PairQuality& pair) { return pair.held_out.series; },
                 study.held_out.series, false, true});
  if (study.held_out.diameters) {
    all.push_back({"held-out error of e, other diameters",
                   [](const PairQuality& pair) { return pair.held_out.diameters; },
                   study.held_out.diameters, false, true});
  }
  return all;
}

/// Up to `shades.size()` of the upper velocities, evenly spaced, the highest among them.
std::vector<double> drawn_upper(const Analysis& a, const PairStudy& study) {
  std::set<double> all;
  for (const PairQuality& pair : study.pairs) {
    all.insert(a.fitted.data.points[pair.high_point].velocity);
  }
  const std::vector<double> sorted(all.begin(), all.end());
  if (sorted.size() <= shades.size()) return sorted;
  std::vector<double> drawn;
  for (std::size_t k = 1; k <= shades.size(); ++k) {
    drawn.push_back(sorted[k * (sorted.size() - 1) / shades.size()]);
  }
  return drawn;
}

/// Tick commands without their texts.
std::string bare(const std::string& ticks) {
  std::string out;
  bool inside = false;
  for (const char c : ticks) {
    if (c == '\'') {
      inside = !inside;
      out += c;
    } else if (!inside) {
      out += c;
    }
  }
  return out;
}

struct Picture {
  const Analysis& analysis;
  const PairStudy& study;
  double unit;  // of velocity: V*, or 1 m/s
  std::vector<double> upper;
  style::Range x;
  std::vector<Quantity> all;

  double low(const PairQuality& pair) const {
    return analysis.fitted.data.points[pair.low_point].velocity / unit;
  }
  double high(const PairQuality& pair) const {
    return analysis.fitted.data.points[pair.high_point].velocity;
  }

  std::size_t rows() const { return (all.size() + columns - 1) / columns; }

  double height() const {
    return key_height + row_height * static_cast<double>(rows()) + foot_height;
  }

  std::string margins(std::size_t panel) const {
    const double left = 56.0 / picture_width;
    const double step_x = (1.0 - 8.0 / picture_width) / columns;
    const double x0 = left + step_x * static_cast<double>(panel % columns);
    const std::size_t below = rows() - 1 - panel / columns;
    const double y0 = (foot_height + row_height * static_cast<double>(below)) / height();
    return fmt::format(
        "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
        "set bmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n",
        x0, x0 + step_x - 84.0 / picture_width, y0, y0 + (row_height - 44.0) / height());
  }

  std::string x_label() const {
    return unit == 1.0 ? "lower velocity  [m/s]" : "lower velocity / capture velocity V*";
  }

  std::string panel(std::size_t index) const {
    const Quantity& quantity = all[index];
    std::vector<double> values;
    std::vector<std::vector<double>> cloud;
    for (const PairQuality& pair : study.pairs) {
      const std::optional<double> value = quantity.value(pair);
      if (!value) continue;
      values.push_back(*value);
      cloud.push_back({low(pair), *value});
    }
    if (quantity.full) values.push_back(*quantity.full);
    const bool last_row = index + columns >= all.size();
    std::string c = margins(index) +
                    fmt::format("set logscale x\nset xrange [{:.6g}:{:.6g}]\n", x.lower, x.upper) +
                    (index + columns >= all.size() ? log_ticks('x', x.lower, x.upper)
                                                   : bare(log_ticks('x', x.lower, x.upper)));
    c += last_row ? fmt::format("set xlabel '{}' offset 0,0.4\n", x_label())
                  : std::string("unset xlabel\n");
    c += fmt::format("set label 1 '{}' at graph 0, graph 1 left offset 0,0.75 textcolor rgb '{}'\n",
                     quantity.label, style::ink) +
         y_axis(quantity, values);
    c += data_block(fmt::format("cloud{}", index), cloud);
    std::vector<std::string> layers;
    if (quantity.full) {
      layers.push_back(fmt::format("{:.6g} with lines lc rgb '{}' lw 2 notitle", *quantity.full,
                                   style::vermillion));
    }
    layers.push_back(
        fmt::format("$cloud{} using 1:2 with points lc rgb '#c4c4c4' pt 7 ps 0.35 "
                    "notitle",
                    index));
    for (std::size_t k = 0; k < upper.size(); ++k) {
      std::vector<std::vector<double>> line;
      for (const PairQuality& pair : study.pairs) {
        if (high(pair) != upper[k]) continue;
        line.push_back({low(pair), quantity.value(pair).value_or(NAN)});
      }
      const std::string name = fmt::format("l{}u{}", index, k);
      c += data_block(name, line);
      const style::Marker& shade = shades[shades.size() - upper.size() + k];
      layers.push_back(
          fmt::format("${} using 1:2 with linespoints lc rgb '{}' lw 1.8 pt {} ps 0.6 "
                      "notitle",
                      name, shade.colour, shade.point));
    }
    const PairQuality& paper = study.pairs[study.paper];
    if (const std::optional<double> value = quantity.value(paper)) {
      c += data_block(fmt::format("paper{}", index), {{low(paper), *value}});
      layers.push_back(
          fmt::format("$paper{} using 1:2 with points lc rgb '{}' pt 6 ps 2 lw 2 "
                      "notitle",
                      index, style::ink));
    }
    return c + fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  }

  std::string y_axis(const Quantity& quantity, const std::vector<double>& values) const {
    if (quantity.log_scale) {
      std::vector<double> logs;
      for (const double value : values) {
        if (value > 0.0) logs.push_back(std::log10(value));
      }
      const style::Range range = style::range_of(logs, 0.08);
      const double lower = std::pow(10.0, range.lower);
      const double upper_end = std::pow(10.0, range.upper);
      return fmt::format("set logscale y\nset yrange [{:.6g}:{:.6g}]\n", lower, upper_end) +
             log_ticks('y', lower, upper_end);
    }
    style::Range range = style::range_of(values, 0.08);
    if (quantity.from_zero) {
      range.lower = -0.04 * range.upper;
    }
    return fmt::format("unset logscale y\nset yrange [{:.6g}:{:.6g}]\n", range.lower, range.upper) +
           style::few_ticks('y', range, 5);
  }

  /// The key in a strip above all panels.
  std::string key() const {
    std::string c = fmt::format(
        "unset label 1\nunset tics\nunset border\nunset xlabel\nunset ylabel\nunset grid\nunset "
        "logscale\n"
        "set lmargin at screen 0\nset rmargin at screen 1\nset bmargin at screen 0\n"
        "set tmargin at screen 1\nset xrange [0:1]\nset yrange [0:1]\n"
        "set key at screen 0.5, screen 0.995 center top horizontal Left reverse samplen 1.6 "
        "maxrows 2 width 1\n");
    std::vector<std::string> layers = {
        fmt::format("NaN with lines lc rgb '{}' lw 2 title 'fit to all points'", style::vermillion),
        fmt::format("NaN with points lc rgb '{}' pt 6 ps 2 lw 2 title 'the paper''s pair'",
                    style::ink)};
    for (std::size_t k = 0; k < upper.size(); ++k) {
      const style::Marker& shade = shades[shades.size() - upper.size() + k];
      layers.push_back(fmt::format("NaN with linespoints lc rgb '{}' lw 1.8 pt {} ps 0.8 title {}",
                                   shade.colour, shade.point,
                                   gnuplot_text(fmt::format("upper {} m/s", number(upper[k], 3)))));
    }
    layers.emplace_back("NaN with points lc rgb '#c4c4c4' pt 7 ps 0.5 title 'other pairs'");
    return c + fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  }
};

Figure pair_figure(const Analysis& analysis, const PairStudy& study) {
  Picture picture{analysis,
                  study,
                  capture_of(analysis, study).value_or(1.0),
                  drawn_upper(analysis, study),
                  {},
                  quantities(study)};
  std::vector<double> logs;
  for (const PairQuality& pair : study.pairs) logs.push_back(std::log10(picture.low(pair)));
  const style::Range range = style::range_of(logs, 0.06);
  picture.x = {std::pow(10.0, range.lower), std::pow(10.0, range.upper)};

  PlotScript script;
  script.name = fmt::format("pairs-{}", study.dataset + 1);
  script.title = fmt::format("What two points cost, by which two are taken, {}",
                             analysis.datasets[study.dataset].id);
  script.width = static_cast<int>(picture_width);
  script.height = static_cast<int>(picture.height());
  std::string& c = script.commands;
  c = style::preamble() + "unset key\nset multiplot\n";
  for (std::size_t i = 0; i < picture.all.size(); ++i) c += picture.panel(i);
  c += picture.key() + "unset multiplot\n";

  std::string caption = fmt::format(
      "{}, d = {} um. Each mark is a pair of points on which C_H and C_A are calibrated, in {} "
      "data "
      "sets simulated from the fit to all points. Bias: median over the true value; spread: robust "
      "standard deviation over that of the full fit on the same data; both of the data sets that "
      "have an answer. Error: root mean square miss of a new measurement of the points that the "
      "pair did not use, noise included.",
      analysis.datasets[study.dataset].id, diameter_text(study.diameter), study.simulations);
  if (study.taken < study.points) {
    caption += fmt::format(" {} of the {} points are tried.", study.taken, study.points);
  }
  Figure figure{script.name, script.title, caption, draw_svg(script)};
  figure.large = true;
  return figure;
}

}  // namespace

std::vector<Figure> pair_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  for (const PairStudy& study : analysis.uncertainty.pairs) {
    if (figures.size() == most_pictures) break;
    if (!study.pairs.empty()) figures.push_back(pair_figure(analysis, study));
  }
  return figures;
}

}  // namespace recoil
