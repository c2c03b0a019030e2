#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/density.hpp"
#include "report/figure_style.hpp"
#include "report/figures.hpp"
#include "report/format.hpp"
#include "report/svg_plot.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_parameters = 6;
constexpr std::size_t most_points = 2400;  // in all panels together
constexpr double inner_share = 0.5;        // of the replicates within the contours
constexpr double outer_share = 0.95;

/// One axis of the corner plot.
struct Axis {
  std::size_t slot = 0;
  style::Scale scale;
  std::string label;
  int lines = 1;               // of the label
  std::vector<double> values;  // of the replicates
  double estimate = 0.0;
  style::Range range;
};

Axis make_axis(const Analysis& analysis, std::size_t slot) {
  const ParameterSlot& parameter = analysis.fitted.model.slots[slot];
  Axis axis;
  axis.slot = slot;
  axis.scale = style::scale_for(std::abs(analysis.fitted.theta[slot]), parameter.unit);
  axis.label = fmt::format("{}  [{}]", style::symbol(parameter.name), axis.scale.unit);
  if (!parameter.dataset.empty()) {
    axis.label = fmt::format("{}\\n{}", parameter.dataset, axis.label);
    axis.lines = 2;
  }
  axis.values = column(analysis.uncertainty.bootstrap.theta, slot, axis.scale.factor);
  axis.estimate = analysis.fitted.theta[slot] * axis.scale.factor;
  const style::Range bulk = style::quantile_range(axis.values, 0.003, 0.997);
  std::vector<double> shown = {bulk.lower, bulk.upper, axis.estimate};
  const Interval interval = intervals_of(analysis, slot)[IntervalKind::profile];
  if (interval.available()) {
    shown.push_back(*interval.lower * axis.scale.factor);
    shown.push_back(*interval.upper * axis.scale.factor);
  }
  axis.range = style::range_of(shown, 0.05);
  if (parameter.lower >= 0.0) axis.range.lower = std::max(axis.range.lower, 0.0);
  return axis;
}

/// Where the panels are, in fractions of the picture.
struct Layout {
  double width, height, left, bottom, step_x, step_y, panel_x, panel_y;

  Layout(std::size_t count, int label_lines) {
    const double n = static_cast<double>(count);
    width = count == 1 ? 480.0 : count == 2 ? 620.0 : 220.0 * n + 110.0;
    height = count == 1 ? 340.0 : 0.86 * width;
    left = (52.0 + 32.0 * label_lines) / width;
    bottom = (44.0 + 18.0 * label_lines) / height;
    step_x = (1.0 - left - 14.0 / width) / n;
    step_y = (1.0 - bottom - (count == 1 ? 44.0 : 14.0) / height) / n;
    panel_x = step_x - 12.0 / width;
    panel_y = step_y - 12.0 / height;
  }

  std::string margins(std::size_t row, std::size_t column, std::size_t count) const {
    const double x = left + step_x * static_cast<double>(column);
    const double y = bottom + step_y * static_cast<double>(count - 1 - row);
    return fmt::format(
        "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
        "set bmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n",
        x, x + panel_x, y, y + panel_y);
  }
};

/// Axes of a panel: ticks and labels only where the panel stands at the rim.
std::string panel_axes(const Axis& x, bool bottom) {
  return fmt::format("set xrange [{:.6g}:{:.6g}]\n", x.range.lower, x.range.upper) +
         style::few_ticks('x', x.range, 3) +
         (bottom ? fmt::format("set format x '%g'\nset xlabel \"{}\" offset 0,0.4\n", x.label)
                 : std::string("set format x ''\nunset xlabel\n"));
}

/// Replicates as bars and the relative profile likelihood exp(-rise / 2) as a line, both 1 at
/// their peak; dashed the height at which the profile interval ends.
std::string diagonal_panel(const Analysis& analysis, const Axis& axis, bool left, bool bottom) {
  Histogram h = histogram(axis.values, axis.range);
  double peak = 0.0;
  for (const auto& bar : h.bars) peak = std::max(peak, bar[1]);
  for (auto& bar : h.bars) bar[1] /= std::max(peak, 1.0);
  const std::vector<ProfilePoint>& profile =
      analysis.uncertainty.intervals.size() > axis.slot
          ? analysis.uncertainty.intervals[axis.slot].profile_curve
          : std::vector<ProfilePoint>();
  std::vector<std::vector<double>> rows;
  for (const ProfilePoint& point : profile) {
    rows.push_back({point.value * axis.scale.factor, std::exp(-0.5 * point.rise),
                    std::exp(-0.5 * point.allowed)});
  }
  std::string c = panel_axes(axis, bottom) + "set yrange [0:1.08]\n";
  c += left ? "set ytics 0.5\nset format y '%g'\nset ylabel 'relative to the peak' offset 0.6,0\n"
            : "set ytics 0.5\nset format y ''\nunset ylabel\n";
  c += data_block(fmt::format("h{}", axis.slot), h.bars) +
       data_block(fmt::format("p{}", axis.slot), rows);
  c += fmt::format(
      "set boxwidth {3:.6g}\nset arrow 1 from {4:.6g}, graph 0 to {4:.6g}, graph 1 nohead lc rgb "
      "'{5}' lw 1.5 front\n"
      "plot $h{0} using 1:2 with boxes fc rgb '{1}' fs solid 0.55 noborder notitle, \\\n"
      "  $p{0} using 1:3 with lines lc rgb '{6}' lw 1.3 dt (5,4) notitle, \\\n"
      "  $p{0} using 1:2 with lines lc rgb '{2}' lw 2.2 notitle\nunset arrow 1\n",
      axis.slot, style::sky, style::ink, 0.96 * h.width, axis.estimate, style::vermillion,
      style::ink);
  return c;
}

/// Replicates as points, with the lines within which half and 95 % of them lie.
std::string lower_panel(const Axis& x, const Axis& y, bool left, bool bottom, std::size_t stride) {
  const std::string id = fmt::format("{}x{}", x.slot, y.slot);
  std::vector<std::vector<double>> points;
  for (std::size_t i = 0; i < x.values.size(); i += stride) {
    const bool inside = x.values[i] >= x.range.lower && x.values[i] <= x.range.upper &&
                        y.values[i] >= y.range.lower && y.values[i] <= y.range.upper;
    if (inside) points.push_back({x.values[i], y.values[i]});
  }
  const DensityGrid grid = density(x.values, y.values, x.range, y.range);
  std::string c;
  std::string contours;
  for (const double share : {outer_share, inner_share}) {
    const std::string name = fmt::format("c{}n{}", id, share == inner_share ? 1 : 2);
    const std::string commands = contour_commands(name, grid, x.values, y.values, share);
    if (commands.empty()) continue;
    c += commands;
    contours += fmt::format(", \\\n  ${} using 1:2 with lines lc rgb '{}' lw {} notitle", name,
                            style::blue, share == inner_share ? 2.2 : 1.3);
  }
  c += panel_axes(x, bottom) +
       fmt::format("set yrange [{:.6g}:{:.6g}]\n", y.range.lower, y.range.upper) +
       style::few_ticks('y', y.range, 3) +
       (left ? fmt::format("set format y '%g'\nset ylabel \"{}\" offset {},0\n", y.label,
                           y.lines > 1 ? -0.7 : 0.6)
             : std::string("set format y ''\nunset ylabel\n")) +
       data_block("s" + id, points);
  c += fmt::format(
      "plot $s{0} using 1:2 with points lc rgb '{1}' pt 7 ps 0.2 notitle{2}, \\\n"
      "  '+' every ::0::0 using ({3:.7g}):({4:.7g}) with points lc rgb '{5}' pt 7 ps 0.9 notitle\n",
      id, style::sky, contours, x.estimate, y.estimate, style::vermillion);
  return c;
}

/// What the marks mean, in the empty corner (above the panel of a single parameter).
std::string key(std::size_t count) {
  std::string c = "unset tics\nunset border\nunset xlabel\nunset ylabel\nunset grid\n";
  c += "set lmargin at screen 0\nset rmargin at screen 1\nset bmargin at screen 0\n"
       "set tmargin at screen 1\nset xrange [0:1]\nset yrange [0:1]\n";
  c += count == 1 ? "set key at screen 0.5, screen 0.99 center top horizontal Left reverse "
                    "samplen 1.2\n"
                  : "set key at screen 0.985, screen 0.975 right top vertical Left reverse samplen "
                    "1.6\n";
  c += fmt::format(
      "plot NaN with lines lc rgb '{0}' lw 2 title 'estimate', \\\n"
      "  NaN with lines lc rgb '{1}' lw 2.2 title 'profile', \\\n"
      "  NaN with lines lc rgb '{1}' lw 1.3 dt (5,4) title 'interval ends', \\\n"
      "  NaN with boxes fc rgb '{2}' fs solid 0.55 noborder title 'replicates'",
      style::vermillion, style::ink, style::sky);
  if (count > 1) {
    c += fmt::format(
        ", \\\n  NaN with lines lc rgb '{0}' lw 2.2 title 'half of them', \\\n"
        "  NaN with lines lc rgb '{0}' lw 1.3 title '95 % of them'",
        style::blue);
  }
  return c + "\n";
}

}  // namespace

std::vector<Figure> corner_figures(const Analysis& analysis) {
  std::vector<Axis> axes;
  std::size_t free = 0;
  const auto& slots = analysis.fitted.model.slots;
  const bool any = !analysis.uncertainty.bootstrap.theta.empty();
  for (std::size_t slot = 0; slot < slots.size() && any; ++slot) {
    if (slots[slot].free && ++free <= most_parameters) axes.push_back(make_axis(analysis, slot));
  }
  if (axes.empty()) return {};
  const std::size_t count = axes.size();
  int label_lines = 1;
  for (const Axis& axis : axes) label_lines = std::max(label_lines, axis.lines);
  const Layout layout(count, label_lines);
  const std::size_t panels = count * (count - 1) / 2;
  const std::size_t replicates = axes.front().values.size();
  const std::size_t stride = replicates * std::max<std::size_t>(panels, 1) / most_points + 1;

  PlotScript script;
  script.name = "corner-1";
  script.title = "Replicates of every pair of parameters, with the profile likelihood";
  script.width = static_cast<int>(layout.width);
  script.height = static_cast<int>(layout.height);
  std::string& c = script.commands;
  c = style::preamble() + "unset key\nset multiplot\n";
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      c += layout.margins(row, column, count) +
           (row == column
                ? diagonal_panel(analysis, axes[row], column == 0, row + 1 == count)
                : lower_panel(axes[column], axes[row], column == 0, row + 1 == count, stride));
    }
  }
  c += key(count) + "unset multiplot\n";

  std::string caption = fmt::format(
      "The {} usable replicates of the {} bootstrap. On the diagonal their histogram and the "
      "profile likelihood, both relative to their peaks: where the two differ, so do the intervals "
      "that rest on them. The dashed line is the height at which the profile interval ends.",
      replicates, to_string(analysis.uncertainty.bootstrap.scheme));
  if (panels > 0) {
    caption +=
        " Below it each pair of parameters, with the lines within which half and 95 % of the "
        "replicates lie: a narrow oblique cloud is a combination that the data know better "
        "than its members.";
    if (stride > 1) caption += fmt::format(" One replicate in {} is drawn.", stride);
  }
  if (free > count) caption += fmt::format(" The first {} of {} parameters.", count, free);
  Figure figure{script.name, script.title, caption, draw_svg(script)};
  figure.large = count > 1;
  return {figure};
}

}  // namespace recoil
