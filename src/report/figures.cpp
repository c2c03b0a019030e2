#include "report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_style.hpp"
#include "report/format.hpp"
#include "report/svg_plot.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_panels = 24;  // per page, so that it stays under 1 MB
constexpr std::size_t most_curve_points = 120;
constexpr std::size_t most_points = 400;  // drawn per panel

/// One diameter of one dataset.
struct Panel {
  std::size_t dataset = 0;
  double diameter = 0.0;
  std::string series;
  const RestitutionCurve* curve = nullptr;
  const CaptureEstimate* capture = nullptr;
  std::vector<std::size_t> points;
};

/// Every point goes to the panel of its dataset with the nearest diameter and, among equals, its
/// own series.
void distribute_points(const Analysis& analysis, std::vector<Panel>& panels) {
  const auto& points = analysis.data.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Panel* nearest = nullptr;
    double smallest = INFINITY;
    for (Panel& panel : panels) {
      if (panel.dataset != points[i].dataset) continue;
      const auto& names = analysis.datasets[panel.dataset].series;
      const bool own = points[i].series < names.size() && names[points[i].series] == panel.series;
      const double distance =
          std::abs(std::log(points[i].diameter / panel.diameter)) + (own ? 0.0 : 1e-6);
      if (distance < smallest) {
        smallest = distance;
        nearest = &panel;
      }
    }
    if (nearest != nullptr) nearest->points.push_back(i);
  }
}

std::vector<Panel> panels_of(const Analysis& analysis) {
  std::vector<Panel> panels;
  for (const RestitutionCurve& curve : analysis.uncertainty.curves) {
    panels.push_back({curve.dataset, curve.diameter, curve.series, &curve, nullptr, {}});
  }
  if (panels.empty()) {
    for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
      for (const double diameter : distinct_diameters(analysis.datasets[k])) {
        panels.push_back({k, diameter, "", nullptr, nullptr, {}});
      }
    }
  }
  for (Panel& panel : panels) {
    for (const CaptureEstimate& capture : analysis.uncertainty.capture) {
      if (capture.dataset == panel.dataset && capture.found &&
          std::abs(std::log(capture.diameter / panel.diameter)) < 1e-6) {
        panel.capture = &capture;
      }
    }
  }
  distribute_points(analysis, panels);
  if (panels.size() > most_panels) panels.resize(most_panels);
  return panels;
}

/// Common axes of the panels of one dataset, so that they can be compared.
struct Axes {
  style::Range velocity;
  double top = 1.05;
};

Axes axes_of(const Analysis& analysis, const std::vector<Panel>& panels, std::size_t dataset) {
  double lower = INFINITY;
  double upper = 0.0;
  Axes axes;
  for (const Observation& point : analysis.data.points) {
    if (point.dataset != dataset) continue;
    lower = std::min(lower, point.velocity);
    upper = std::max(upper, point.velocity);
    const double sd = analysis.data.sd_stated ? point.sd : 0.0;
    axes.top = std::max(axes.top, std::min(1.5, 1.03 * (point.restitution + sd)));
  }
  const double slowest = lower;
  for (const Panel& panel : panels) {
    if (panel.dataset != dataset || panel.capture == nullptr) continue;
    const double edge = panel.capture->interval.lower.value_or(panel.capture->value);
    // A capture velocity far below the data would squeeze them to the right edge.
    lower = std::min(lower, std::max(std::min(edge, panel.capture->value), slowest / 10.0));
  }
  axes.velocity = {lower / 1.35, upper * 1.25};
  return axes;
}

std::vector<std::vector<double>> curve_rows(const RestitutionCurve& curve) {
  const std::size_t count = std::min(curve.velocity.size(), curve.restitution.size());
  const std::size_t stride =
      std::max<std::size_t>(1, (count + most_curve_points - 1) / most_curve_points);
  const auto at = [](const std::vector<double>& values, std::size_t i) {
    return i < values.size() ? values[i] : NAN;
  };
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < count; ++i) {
    // Where the curve rises from capture every point is needed; the plateau can be thinned.
    const bool steep =
        i + 1 < count &&
        std::abs(curve.restitution[i + 1] - curve.restitution[i]) +
                std::abs(i > 0 ? curve.restitution[i] - curve.restitution[i - 1] : 0.0) >
            0.02;
    if (i % stride != 0 && i + 1 != count && !steep) continue;
    rows.push_back({curve.velocity[i], curve.restitution[i], at(curve.lower, i), at(curve.upper, i),
                    at(curve.two_point, i)});
  }
  return rows;
}

struct PointRows {
  std::vector<std::vector<double>> rebounds;  // V, e, sd
  std::vector<std::vector<double>> captures;  // V, 0
};

PointRows point_rows(const Analysis& analysis, const std::vector<std::size_t>& points) {
  PointRows rows;
  const std::size_t stride = points.size() / most_points + 1;
  for (std::size_t k = 0; k < points.size(); k += stride) {
    const Observation& point = analysis.data.points[points[k]];
    if (point.censored) {
      rows.captures.push_back({point.velocity, 0.0});
    } else {
      rows.rebounds.push_back({point.velocity, point.restitution, point.sd});
    }
  }
  return rows;
}

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
  std::string words = fmt::format("capture below V* = {} m/s", number(capture.value, 3));
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
  c = style::preamble() + style::key_below() + "set logscale x\n";
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
          style::blue,
          gnuplot_text(percent(analysis.uncertainty.options.level) + " band")));
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
    const std::string name = gnuplot_text(points_name(dataset, analysis.data.sd_stated));
    if (analysis.data.sd_stated) {
      layers.push_back(fmt::format(
          "$points using 1:($2-$3):(0):(2*$3) with vectors nohead lc rgb '{}' lw 1.2 notitle", style::ink));
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
  const std::size_t drawn_every = panel.points.size() / most_points + 1;
  if (drawn_every > 1) text += fmt::format(" One point in {} is drawn.", drawn_every);
  if (panel.capture == nullptr) {
    text += " No capture velocity was found at this diameter.";
  } else {
    text += fmt::format(" Capture below V* = {} m/s", number(panel.capture->value, 3));
    if (panel.capture->interval.available()) {
      text += fmt::format(", {} interval {}", percent(analysis.uncertainty.options.level),
                          interval_text(panel.capture->interval, 3));
    }
    text += ".";
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

std::string restitution_overview(const Analysis& analysis, const std::string& id) {
  const std::vector<Panel> panels = panels_of(analysis);
  PlotScript script;
  script.name = plot_name("overview-" + id);
  script.title = fmt::format("Restitution against incident velocity, {}", id);
  script.width = 420;
  script.height = 270;
  style::Range velocity{INFINITY, 0.0};
  double top = 1.05;
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    const Axes axes = axes_of(analysis, panels, k);
    if (!std::isfinite(axes.velocity.lower)) continue;
    velocity.lower = std::min(velocity.lower, axes.velocity.lower);
    velocity.upper = std::max(velocity.upper, axes.velocity.upper);
    top = std::max(top, axes.top);
  }
  std::string& c = script.commands;
  c = style::preamble() +
      fmt::format(
          "set logscale x\nset xrange [{:.6g}:{:.6g}]\nset yrange [0:{:.4g}]\n"
          "set ytics 0.2\nset lmargin 7\n"
          "set xlabel 'V  [m/s]' offset 0,0.6\nset ylabel 'e' offset 1,0\n",
          velocity.lower, velocity.upper, top) +
      style::key_above() + log_ticks('x', velocity.lower, velocity.upper);
  std::vector<std::string> layers;
  const bool by_dataset = analysis.datasets.size() > 1;
  std::vector<bool> named(analysis.datasets.size(), false);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Panel& panel = panels[i];
    const style::Marker marker =
        style::markers[(by_dataset ? panel.dataset : i) % style::markers.size()];
    const std::string name =
        by_dataset ? analysis.datasets[panel.dataset].id : diameter_text(panel.diameter) + " µm";
    const bool show = by_dataset ? !named[panel.dataset] : panels.size() <= 7;
    named[panel.dataset] = true;
    const std::string key = show ? "title " + gnuplot_text(name) : std::string("notitle");
    if (panel.curve != nullptr) {
      c += data_block(fmt::format("curve{}", i), curve_rows(*panel.curve));
      layers.push_back(fmt::format("$curve{} using 1:2 with lines lc rgb '{}' lw 1.6 notitle", i,
                                   marker.colour));
    }
    c += data_block(fmt::format("points{}", i), point_rows(analysis, panel.points).rebounds);
    layers.push_back(fmt::format("$points{} using 1:2 with points lc rgb '{}' pt {} ps 0.5 {}", i,
                                 marker.colour, marker.point, key));
  }
  if (layers.empty()) layers.emplace_back("NaN notitle");
  c += fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  return draw_svg(script);
}

}  // namespace recoil
