#include "report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_style.hpp"
#include "report/format.hpp"
#include "report/panels.hpp"
#include "report/svg_plot.hpp"

namespace recoil {
namespace {

constexpr int panel_key_rows = 2;
constexpr double hidden_sd = 0.012;  // an error bar within the mark's radius [1]

/// The capture velocity as a line with its interval as a strip; `capture_words` labels it.
std::string capture_commands(const CaptureEstimate& capture, const Axes& axes) {
  const Interval& interval = capture.interval;
  const auto inside = [&](double v) {
    return std::clamp(v, axes.velocity.lower, axes.velocity.upper);
  };
  std::string out;
  if (interval.available()) {
    out += fmt::format(
        "set object 1 rect from {:.6g}, graph 0 to {:.6g}, graph 1 fc rgb '{}' fs transparent "
        "solid 0.18 noborder behind\n",
        inside(*interval.lower), inside(*interval.upper), style::green);
  }
  if (capture.value > axes.velocity.lower && capture.value < axes.velocity.upper) {
    out += fmt::format(
        "set arrow 1 from {0:.6g}, graph 0 to {0:.6g}, graph 1 nohead lc rgb '{1}' lw 1.4 back\n",
        capture.value, style::green);
  }
  return out;
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

PlotScript restitution_script(const Analysis& analysis, const Panel& panel, const Axes& axes) {
  const Dataset& dataset = analysis.datasets[panel.dataset];
  PlotScript script;
  script.height = 365;
  std::string heading = fmt::format("d = {} µm", diameter_text(panel.diameter));
  if (analysis.datasets.size() > 1) heading += ", " + dataset.id;
  script.title = fmt::format("Restitution against incident velocity, {}", heading);

  const PointRows rows = point_rows(analysis, panel.points);
  std::string& c = script.commands;
  c = style::preamble() + style::key_below(panel_key_rows) + "set logscale x\n";
  c += panel.capture == nullptr
           ? style::title(heading)
           : style::title(heading, capture_words(*panel.capture, axes), "#00684c");
  c += fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [0:{:.4g}]\nset ytics 0.2\n",
                   axes.velocity.lower, axes.velocity.upper, axes.top);
  c += log_ticks('x', axes.velocity.lower, axes.velocity.upper);
  c += "set xlabel 'incident velocity V  [m/s]' offset 0,0.4\n"
       "set ylabel 'restitution e' offset 1.2,0\n";
  if (panel.capture != nullptr) c += capture_commands(*panel.capture, axes);

  std::vector<std::string> layers;
  if (panel.curve != nullptr) {
    c += data_block("curve", curve_rows(*panel.curve));
    if (!panel.curve->lower.empty()) {
      layers.push_back(fmt::format(
          "$curve using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.2 noborder "
          "title {}",
          style::blue, gnuplot_text(percent(analysis.uncertainty.options.level) + " band")));
    }
    layers.push_back(fmt::format(
        "$curve using 1:2 with lines lc rgb '{}' lw 2 title 'fit to all points'", style::blue));
    if (!panel.curve->two_point.empty()) {
      layers.push_back(
          fmt::format("$curve using 1:5 with lines lc rgb '{}' lw 2 dt (8,5) title 'two points'",
                      style::vermillion));
    }
  }
  if (!rows.rebounds.empty()) {
    c += data_block("points", rows.rebounds);
    const std::string name = gnuplot_text(points_name(dataset, analysis.fitted.data.sd_stated));
    if (analysis.fitted.data.sd_stated) {
      layers.push_back(fmt::format(
          "$points using 1:($2-$3):(0):(2*$3) with vectors nohead lc rgb '{}' lw 1.2 notitle",
          style::ink));
    }
    layers.push_back(fmt::format("$points using 1:2 with points lc rgb '{}' pt 7 ps 0.5 title {}",
                                 style::ink, name));
  }
  if (!rows.captures.empty()) {
    c += data_block("captured", rows.captures);
    layers.push_back(fmt::format(
        "$captured using 1:2 with points lc rgb '{}' pt 10 ps 0.9 title 'captured'", style::ink));
  }
  if (layers.empty()) layers.emplace_back("NaN notitle");
  c += fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  return script;
}

std::string restitution_caption(const Analysis& analysis, const Panel& panel) {
  std::string text = fmt::format("{}: {} point{}.", analysis.datasets[panel.dataset].id,
                                 panel.points.size(), panel.points.size() == 1 ? "" : "s");
  const std::size_t drawn_every = panel.points.size() / most_panel_points + 1;
  if (drawn_every > 1) text += fmt::format(" One point in {} is drawn.", drawn_every);
  if (panel.capture == nullptr) {
    text += " No capture velocity was found at this diameter.";
  } else {
    text += fmt::format(" Capture below V* = {} m/s", digits(panel.capture->value, 3));
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
    PlotScript script =
        restitution_script(analysis, panels[i], axes_of(analysis, panels, panels[i].dataset));
    script.name = fmt::format("restitution-{}", i + 1);
    figures.push_back(
        {script.name, script.title, restitution_caption(analysis, panels[i]), draw_svg(script)});
  }
  return figures;
}

}  // namespace recoil
