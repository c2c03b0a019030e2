#include "report/figures_corner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/density.hpp"
#include "report/format.hpp"
#include "report/parameter_axis.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_parameters = 6;
constexpr std::size_t most_points = 2400;  // in all panels together
constexpr double inner_share = 0.5;        // of the replicates within the contours
constexpr double outer_share = 0.95;

/// One parameter, an axis of the corner plot.
struct CornerAxis {
  std::size_t slot = 0;
  double factor = 1.0;  // from values to the axis
  plot::Axis axis;
  int label_lines = 1;
  std::vector<double> values;  // of the replicates
  double estimate = 0.0;
  plot::Range range;
};

CornerAxis parameter_of(const Analysis& analysis, std::size_t slot) {
  const ParameterSlot& of = analysis.fitted.model.slots[slot];
  CornerAxis parameter;
  parameter.slot = slot;
  const ParameterAxis shown_as = parameter_axis(of, analysis.fitted.theta[slot]);
  const double factor = parameter.factor = shown_as.factor;
  parameter.axis = shown_as.axis;
  if (!of.dataset.empty()) {
    parameter.axis.label = of.dataset + "\n" + std::string(of.parameter->name);
    parameter.label_lines = 2;
  }
  parameter.values = column(analysis.uncertainty.bootstrap.theta, slot, factor);
  parameter.estimate = analysis.fitted.theta[slot] * factor;
  const plot::Range bulk = plot::quantile_range(parameter.values, 0.003, 0.997);
  std::vector<double> shown = {bulk.lower, bulk.upper, parameter.estimate};
  const Interval interval = intervals_of(analysis, slot)[IntervalKind::profile];
  if (interval.available()) {
    shown.push_back(*interval.lower * factor);
    shown.push_back(*interval.upper * factor);
  }
  parameter.range = plot::range_of(shown, 0.05);
  if (of.lower >= 0.0) parameter.range.lower = std::max(parameter.range.lower, 0.0);
  parameter.axis.set_range(parameter.range);
  parameter.axis.about = 3;
  return parameter;
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

  plot::Frame frame(std::size_t row, std::size_t column, std::size_t count) const {
    const double x = width * (left + step_x * static_cast<double>(column));
    const double y = height * (bottom + step_y * static_cast<double>(count - 1 - row));
    return {x, x + width * panel_x, y, y + height * panel_y};
  }
};

/// Replicates as bars and the relative profile likelihood exp(-rise / 2) as a line, both 1 at
/// their peak; dashed the height at which the profile interval ends.
plot::Plot diagonal_panel(const Analysis& analysis, const CornerAxis& parameter) {
  plot::Plot panel;
  panel.x = parameter.axis;
  panel.y = {"relative to the peak"};
  panel.y.set_range({0.0, 1.08});
  panel.y.about = 2;

  Bars bars = bars_of(parameter.values, parameter.range);
  for (double& top : bars.boxes.top) top /= std::max(bars.highest, 1.0);
  bars.boxes.fill = {std::string(plot::sky), 0.55};
  bars.boxes.name = "replicates";
  plot::Line profile{{}, {}, {plot::ink, 2.2}};
  profile.name = "profile";
  plot::Line ends{{}, {}, {plot::ink, 1.3, plot::Dash::dashes}};
  ends.name = "interval ends";
  if (analysis.uncertainty.intervals.size() > parameter.slot) {
    for (const ProfilePoint& point : analysis.uncertainty.intervals[parameter.slot].profile_curve) {
      profile.x.push_back(point.value * parameter.factor);
      profile.y.push_back(std::exp(-0.5 * point.rise));
      ends.y.push_back(std::exp(-0.5 * point.allowed));
    }
    ends.x = profile.x;
  }
  plot::Rule estimate{plot::Direction::vertical, parameter.estimate, {plot::vermillion, 1.5}, true};
  estimate.name = "estimate";
  panel.layers = {bars.boxes, ends, profile, estimate};
  return panel;
}

/// Replicates as points, with the lines within which half and 95 % of them lie.
plot::Plot lower_panel(const CornerAxis& x, const CornerAxis& y, std::size_t stride) {
  plot::Plot panel;
  panel.x = x.axis;
  panel.y = y.axis;
  plot::Points cloud;
  cloud.marker.colour = plot::sky;
  cloud.size = 0.2;
  for (std::size_t i = 0; i < x.values.size(); i += stride) {
    if (!x.range.holds(x.values[i]) || !y.range.holds(y.values[i])) continue;
    cloud.x.push_back(x.values[i]);
    cloud.y.push_back(y.values[i]);
  }
  panel.layers.push_back(std::move(cloud));
  for (const double share : {outer_share, inner_share}) {
    const bool inner = share == inner_share;
    auto contour = contour_around(x.values, y.values, x.range, y.range, share,
                                  {plot::blue, inner ? 2.2 : 1.3});
    if (!contour) continue;
    contour->name = inner ? "half of them" : "95 % of them";
    panel.layers.push_back(std::move(*contour));
  }
  plot::Points estimate{{x.estimate}, {y.estimate}};
  estimate.marker.colour = plot::vermillion;
  estimate.size = 0.9;
  panel.layers.push_back(std::move(estimate));
  return panel;
}

}  // namespace

std::vector<Figure> corner_figures(const Analysis& analysis) {
  std::vector<CornerAxis> parameters;
  std::size_t free = 0;
  const auto& slots = analysis.fitted.model.slots;
  const bool any = !analysis.uncertainty.bootstrap.theta.empty();
  for (std::size_t slot = 0; slot < slots.size() && any; ++slot) {
    if (slots[slot].free && ++free <= most_parameters)
      parameters.push_back(parameter_of(analysis, slot));
  }
  if (parameters.empty()) return {};
  const std::size_t count = parameters.size();
  int label_lines = 1;
  for (const CornerAxis& parameter : parameters) {
    label_lines = std::max(label_lines, parameter.label_lines);
  }
  const Layout layout(count, label_lines);
  const std::size_t panels = count * (count - 1) / 2;
  const std::size_t replicates = parameters.front().values.size();
  const std::size_t stride = replicates * std::max<std::size_t>(panels, 1) / most_points + 1;

  plot::Picture picture;
  picture.name = "corner-1";
  picture.title = "Replicates of every two parameters, with the profile likelihood";
  picture.width = static_cast<int>(layout.width);
  picture.height = static_cast<int>(layout.height);
  // The key stands in the empty corner, above the panel of a single parameter.
  picture.key.place = count == 1 ? plot::KeyPlace::above : plot::KeyPlace::upper_right;
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      plot::Plot panel = row == column ? diagonal_panel(analysis, parameters[row])
                                       : lower_panel(parameters[column], parameters[row], stride);
      // Numbers and names only where the panel stands at the rim.
      panel.x.shown = row + 1 == count;
      panel.y.shown = column == 0;
      panel.frame = layout.frame(row, column, count);
      picture.plots.push_back(std::move(panel));
    }
  }

  std::string caption = fmt::format(
      "The {} usable replicates of the {} bootstrap. On the diagonal their histogram and the "
      "profile likelihood, both relative to their peaks: where the two differ, so do the intervals "
      "that rest on them. The dashed line is the height at which the profile interval ends.",
      replicates, to_string(analysis.uncertainty.bootstrap.scheme));
  if (panels > 0) {
    caption +=
        " Below it, every two parameters against each other, with contours that contain half and "
        "95 % of the replicates: a narrow oblique cloud is a combination that the data determine "
        "better than either parameter.";
    if (stride > 1) caption += fmt::format(" One replicate in {} is drawn.", stride);
  }
  if (free > count) caption += fmt::format(" The first {} of {} parameters.", count, free);
  return {figure_of(std::move(picture), caption, count > 1)};
}

}  // namespace recoil
