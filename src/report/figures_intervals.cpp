#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_style.hpp"
#include "report/figures.hpp"
#include "report/format.hpp"
#include "report/svg_plot.hpp"
#include "report/words_intervals.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_figures = 16;

/// A bound inside the picture: a thick line, and the forbidden side shaded.
std::string bound_commands(double bound, bool lower, style::Range range, int tag) {
  if (bound < range.lower || bound > range.upper) return "";
  return fmt::format(
             "set object {} rect from {:.6g}, graph 0 to graph {}, graph 1 fc rgb '#cccccc' fs "
             "transparent solid 0.55 noborder behind\n",
             tag, bound, lower ? 0 : 1) +
         fmt::format(
             "set arrow {0} from {1:.6g}, graph 0 to {1:.6g}, graph 1 nohead lc rgb '{2}' "
             "lw 3 front\n",
             tag, bound, style::ink) +
         fmt::format(
             "set label {} 'bound' at {:.6g}, graph 1 {} offset 0,0.5 font ',11' textcolor "
             "rgb '{}'\n",
             tag, bound, lower ? "left" : "right", style::ink);
}

Figure interval_figure(const Analysis& analysis, std::size_t slot) {
  const ParameterSlot& parameter = analysis.fitted.model.slots[slot];
  const IntervalSet set = intervals_of(analysis, slot);
  const double estimate = analysis.fitted.theta[slot];
  const style::Scale scale = style::scale_for(std::abs(estimate), parameter.unit);
  std::vector<double> shown = {estimate * scale.factor};
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    if (!set[kind].available()) continue;
    shown.push_back(*set[kind].lower * scale.factor);
    shown.push_back(*set[kind].upper * scale.factor);
  }
  style::Range range = style::range_of(shown, 0.08);
  const double lower = parameter.lower * scale.factor;
  const double upper = parameter.upper * scale.factor;
  // A bound that is near belongs into the picture: that none of the intervals reaches it is news.
  const double width = range.upper - range.lower;
  if (lower > range.lower - 0.35 * width) range.lower = lower - 0.06 * width;
  if (upper < range.upper + 0.35 * width) range.upper = upper + 0.06 * width;

  PlotScript script;
  script.name = fmt::format("intervals-{}", slot + 1);
  script.title = fmt::format("Intervals of {}", parameter.label());
  script.height = 250;
  std::vector<std::vector<double>> usual;
  std::vector<std::vector<double>> chosen;
  std::string ticks;
  std::string missing;
  int row = 0;
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    const Interval& interval = set[kind];
    const double y = -static_cast<double>(row++);
    const bool recommended = set.recommended == kind;
    ticks += fmt::format("{}'{}{}{}' {}", ticks.empty() ? "" : ", ", recommended ? "{/:Bold " : "",
                         words_of(kind), recommended ? "}" : "", y);
    if (interval.available()) {
      (recommended ? chosen : usual)
          .push_back({*interval.lower * scale.factor, y,
                      (*interval.upper - *interval.lower) * scale.factor});
    } else {
      missing += fmt::format(
          "set label {} 'none' at graph 0.02, first {} left font ',11' textcolor rgb '{}'\n",
          20 + row, y, style::grey);
    }
  }
  std::string& c = script.commands;
  c = style::preamble() +
      fmt::format("set lmargin 13\nset bmargin 3.6\nset xrange [{:.6g}:{:.6g}]\n", range.lower,
                  range.upper) +
      fmt::format("set yrange [-4.6:0.6]\nset ytics ({}) scale 0\nset grid noytics\n", ticks) +
      style::few_ticks('x', range, 7) + "set format x '%g'\n" +
      fmt::format("set xlabel '{}{}  [{}]' offset 0,0.4\n", style::symbol(parameter.name),
                  parameter.dataset.empty() ? "" : ", " + parameter.dataset, scale.unit) +
      style::key_above() + bound_commands(lower, true, range, 1) +
      bound_commands(upper, false, range, 2) + missing +
      fmt::format(
          "set arrow 3 from {0:.6g}, graph 0 to {0:.6g}, graph 1 nohead lc rgb '{1}' lw 2 "
          "back\n",
          estimate * scale.factor, style::vermillion) +
      data_block("usual", usual) + data_block("chosen", chosen);
  c += fmt::format(
      "plot $usual using 1:2:3:(0) with vectors heads size screen 0.008,90 lc rgb '{}' lw 2.5 "
      "notitle, \\\n"
      "  $chosen using 1:2:3:(0) with vectors heads size screen 0.012,90 lc rgb '{}' lw 5 "
      "notitle, \\\n"
      "  NaN with lines lc rgb '{}' lw 2 title 'estimate', \\\n"
      "  NaN with lines lc rgb '{}' lw 5 title 'recommended'\n",
      style::blue, style::green, style::vermillion, style::green);

  std::string caption = fmt::format("{} intervals of {}",
                                    percent(analysis.uncertainty.options.level), parameter.label());
  const Interval recommended = recommended_interval(set);
  caption += recommended.available()
                 ? fmt::format("; the {} one is recommended.", words_of(set.recommended))
                 : fmt::format(". None is recommended: {}.", missing_words(recommended));
  if (set.disagreement) {
    caption += " " + as_sentence(disagreement_words(analysis.fitted, slot, set));
  }
  return {script.name, script.title, caption, draw_svg(script)};
}

}  // namespace

std::vector<Figure> interval_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  if (analysis.uncertainty.intervals.empty()) return figures;
  const auto& slots = analysis.fitted.model.slots;
  for (std::size_t slot = 0; slot < slots.size() && figures.size() < most_figures; ++slot) {
    if (slots[slot].free) figures.push_back(interval_figure(analysis, slot));
  }
  return figures;
}

}  // namespace recoil
