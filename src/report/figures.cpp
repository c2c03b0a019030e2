#include "report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "estimate/model.hpp"
#include "report/explore.hpp"
#include "report/format.hpp"
#include "report/panels.hpp"

namespace recoil {
namespace {

constexpr int panel_key_rows = 2;
constexpr int key_row_height = 20;  // [px]
// Where the axes stand, which what explores the picture has to know [px].
constexpr plot::Frame restitution_frame = {73.0, 462.0, 108.0, 299.0};
constexpr double hidden_sd = 0.012;  // an error bar within the mark's radius [1]
constexpr std::string_view dark_green = "#00684c";

/// The capture velocity as a line with its interval as a strip; `capture_words` labels it.
void add_capture(const CaptureEstimate& capture, const Axes& axes, plot::Plot& shown) {
  const Interval& interval = capture.interval;
  const auto inside = [&](double v) {
    return std::clamp(v, axes.velocity.lower, axes.velocity.upper);
  };
  if (interval.available()) {
    shown.layers.push_back(plot::Region{inside(*interval.lower), inside(*interval.upper)});
  }
  if (capture.value > axes.velocity.lower && capture.value < axes.velocity.upper) {
    shown.layers.push_back(
        plot::Rule{plot::Direction::vertical, capture.value, {plot::green, 1.4}});
  }
}

std::string capture_words(const CaptureEstimate& capture, const Axes& axes) {
  std::string words = fmt::format("capture below V* = {} m/s", digits(capture.value, 3));
  if (capture.interval.available()) words += " " + interval_text(capture.interval, 3);
  if (capture.value <= axes.velocity.lower) words = "← " + words;
  return words;
}

std::string points_name(const Dataset& dataset, bool sd_stated) {
  const std::string name = to_string(dataset.provenance);
  return sd_stated ? name + " ± 1 sd" : name;
}

void add_curve(const Analysis& analysis, const RestitutionCurve& curve, plot::Plot& shown) {
  const CurveColumns columns = curve_columns(curve);
  if (!columns.lower.empty()) {
    plot::Band band{columns.velocity, columns.lower, columns.upper};
    band.name = percent(analysis.uncertainty.options.level) + " band";
    shown.layers.push_back(std::move(band));
  }
  plot::Line fit{columns.velocity, columns.restitution, {plot::blue, 2.0}};
  fit.name = "fit to all points";
  shown.layers.push_back(std::move(fit));
  if (!columns.two_point.empty()) {
    plot::Line two{
        columns.velocity, columns.two_point, {plot::vermillion, 2.0, plot::Dash::long_dashes}};
    two.name = "two points";
    shown.layers.push_back(std::move(two));
  }
}

plot::Picture restitution_picture(const Analysis& analysis, const Panel& panel, const Axes& axes) {
  const Dataset& dataset = analysis.datasets[panel.dataset];
  plot::Plot shown;
  shown.heading = "d = " + diameter_label(panel.diameter);
  if (analysis.datasets.size() > 1) shown.heading += ", " + dataset.id;
  shown.x = velocity_axis(axes.velocity);
  shown.y = restitution_axis(axes.top);
  shown.key = {plot::KeyPlace::below, panel_key_rows};
  shown.frame = restitution_frame;
  if (panel.capture != nullptr) {
    shown.remark = capture_words(*panel.capture, axes);
    shown.remark_colour = dark_green;
    add_capture(*panel.capture, axes, shown);
  }
  if (panel.curve != nullptr) add_curve(analysis, *panel.curve, shown);

  const PointColumns columns = point_columns(analysis, panel.points);
  const auto points =
      rebound_layer(analysis, columns, points_name(dataset, analysis.fitted.data.sd_stated));
  if (points) shown.layers.push_back(*points);
  if (!columns.captured.empty()) {
    plot::Points captured{columns.captured, std::vector<double>(columns.captured.size(), 0.0)};
    captured.marker.mark = plot::Mark::open_triangle_down;
    captured.size = 0.9;
    captured.name = "captured";
    shown.layers.push_back(std::move(captured));
    ++shown.key.rows;  // a fifth entry: three columns of them would not fit
  }
  plot::Picture picture;
  picture.title = fmt::format("Restitution against incident velocity, {}", shown.heading);
  const int more = key_row_height * (shown.key.rows - panel_key_rows);
  shown.frame->bottom += more;
  shown.frame->top += more;
  picture.height = 365 + more;
  picture.plots = {std::move(shown)};
  return picture;
}

Sentence restitution_caption(const Analysis& analysis, const Panel& panel) {
  Sentence text = say("{}: {} point{}.", analysis.datasets[panel.dataset].id, panel.points.size(),
                      panel.points.size() == 1 ? "" : "s");
  const std::size_t drawn_every = panel.points.size() / most_panel_points + 1;
  if (drawn_every > 1) text += fmt::format(" One point in {} is drawn.", drawn_every);
  if (panel.capture == nullptr) {
    text += " No capture velocity was found at this diameter.";
  } else {
    text += say(" Capture below {V*} = {} m/s", digits(panel.capture->value, 3));
    if (panel.capture->interval.available()) {
      text += fmt::format(", {} interval {}", percent(analysis.uncertainty.options.level),
                          interval_text(panel.capture->interval, 3));
    }
    text += ".";
  }
  double largest_sd = 0.0;
  for (const std::size_t i : panel.points) {
    if (!analysis.fitted.data.points[i].censored) {
      largest_sd = std::max(largest_sd, analysis.fitted.data.points[i].weights.sd);
    }
  }
  if (analysis.fitted.data.sd_stated && largest_sd < hidden_sd) {
    text += " The error bars are hidden behind the marks.";
  }
  if (averages_over_sizes(analysis.fitted.model, panel.dataset)) {
    text +=
        " The curve is a mean over the sizes that rebound: where the smaller spheres stay, those "
        "that are left can raise it again.";
  }
  if (panel.curve != nullptr && panel.curve->two_point.empty()) {
    text += " The two-point calibration has no curve to show.";
  }
  return text;
}

}  // namespace

std::vector<Figure> restitution_figures(const Analysis& analysis) {
  const std::vector<Panel> panels = panels_of(analysis);
  std::vector<Figure> figures;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    plot::Picture picture =
        restitution_picture(analysis, panels[i], axes_of(analysis, panels, panels[i].dataset));
    picture.name = fmt::format("restitution-{}", i + 1);
    std::string explored = explored_panel(analysis, panels[i], picture);
    figures.push_back(figure_of(std::move(picture), restitution_caption(analysis, panels[i])));
    figures.back().explored = std::move(explored);
  }
  return figures;
}

}  // namespace recoil
