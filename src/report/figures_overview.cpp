#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_style.hpp"
#include "report/figures.hpp"
#include "report/format.hpp"
#include "report/panels.hpp"
#include "report/svg_plot.hpp"

namespace recoil {

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
