#include "report/experiment_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "report/figure_style.hpp"
#include "report/svg_plot.hpp"

namespace recoil {
namespace {

/// Rows middle, share per unit of x in per cent, for bars; heights are densities so that both rules
/// share one axis.
std::vector<std::vector<double>> density_rows(const Histogram& histogram, double unit,
                                              std::size_t total) {
  std::vector<std::vector<double>> rows;
  const double width = histogram.width / unit;
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const double share = 100.0 * static_cast<double>(histogram.counts[i]) /
                         static_cast<double>(std::max<std::size_t>(total, 1));
    rows.push_back({histogram.middle(i) / unit, share / width, width});
  }
  return rows;
}

std::string histogram_svg(const std::string& name, const std::string& title,
                          const std::string& remark, const std::vector<double>& values, double unit,
                          const std::string& axis, const std::string& per) {
  const Histogram bars = sturges(values);
  const Histogram fine = freedman_diaconis(values);
  PlotScript script;
  script.name = plot_name(name);
  script.title = title;
  script.width = 560;
  script.height = 360;
  std::string& c = script.commands;
  c = style::preamble() + style::title(title, remark) +
      fmt::format("set xlabel {} offset 0,0.4\nset ylabel 'share  [% per {}]' offset 1.2,0\n",
                  gnuplot_text(axis), per) +
      "set yrange [0:*]\nset style fill solid 0.55 border rgb '#ffffff'\n" + style::key_below(1);
  c += data_block("bars", density_rows(bars, unit, values.size()));
  c += data_block("fine", density_rows(fine, unit, values.size()));
  c += fmt::format(
      "plot $bars using 1:2:3 with boxes lc rgb '{}' title \"Sturges' rule, {} bins\", "
      "$fine using 1:2 with histeps lc rgb '{}' lw 1.3 title 'Freedman-Diaconis, {} bins'\n",
      style::sky, bars.counts.size(), style::vermillion, fine.counts.size());
  return draw_svg(script);
}

std::string sizes_svg(const Distributions& distributions, const std::string& remark) {
  const std::string title =
      fmt::format("Sizes of {} incoming spheres", distributions.incoming_sizes.size());
  return histogram_svg("sizes", title, remark, distributions.incoming_sizes, units::um,
                       "diameter  [um]", "um");
}

std::string restitution_svg(const Averages& averages, const std::string& remark) {
  std::map<std::string, std::vector<std::vector<double>>> by_series;
  std::vector<double> logs;
  std::vector<std::vector<double>> captured;
  for (const PointMean& point : averages.points) {
    logs.push_back(std::log10(point.velocity));
    if (point.rebounds == 0) {
      captured.push_back({point.velocity, 0.0});
      continue;
    }
    by_series[point.series].push_back(
        {point.velocity, point.restitution, 1.96 * point.restitution_sd});
  }
  const style::Range range = style::range_of(logs, 0.05);
  const double lower = std::pow(10.0, range.lower);
  const double upper = std::pow(10.0, range.upper);
  PlotScript script;
  script.name = "restitution";
  script.title = "Coefficient of restitution against incident velocity";
  script.width = 560;
  script.height = 380;
  std::string& c = script.commands;
  c = style::preamble() + style::title(script.title, remark) +
      fmt::format("set logscale x\nset xrange [{:.6g}:{:.6g}]\nset yrange [0:1.05]\n", lower,
                  upper) +
      log_ticks('x', lower, upper) +
      "set xlabel 'incident normal velocity at the surface  [m/s]' offset 0,0.4\n"
      "set ylabel 'mean restitution of the rebounds' offset 1.2,0\n" +
      style::key_below(static_cast<int>(by_series.size() + 2) / 3);
  std::vector<std::string> layers;
  std::size_t index = 0;
  for (const auto& [name, rows] : by_series) {
    const style::Marker marker = style::markers[index % style::markers.size()];
    c += data_block(fmt::format("s{}", index), rows);
    layers.push_back(
        fmt::format("$s{} using 1:2:3 with yerrorbars lc rgb '{}' pt {} ps 0.6 title {}", index,
                    marker.colour, marker.point, gnuplot_text(name)));
    ++index;
  }
  if (!captured.empty() || layers.empty()) {
    c += data_block("captured", captured);
    layers.push_back(fmt::format(
        "$captured using 1:2 with points lc rgb '{}' pt 1 title 'all captured'", style::ink));
  }
  c += fmt::format("plot {}\n", fmt::join(layers, ", "));
  return draw_svg(script);
}

}  // namespace

std::map<std::string, std::string> experiment_figures(const Distributions& distributions,
                                                      const Averages& averages,
                                                      const std::string& remark) {
  return {
      {"sizes.svg", sizes_svg(distributions, remark)},
      {"velocities-raw.svg",
       histogram_svg("velocities-raw",
                     fmt::format("Normal velocities, {} passages as recorded",
                                 distributions.raw_velocities.size()),
                     remark, distributions.raw_velocities, 1.0,
                     "normal velocity at the plane, towards the surface positive  [m/s]", "m/s")},
      {"velocities-paired.svg",
       histogram_svg("velocities-paired",
                     fmt::format("Normal velocities, {} paired impacts",
                                 distributions.paired_velocities.size() / 2),
                     remark, distributions.paired_velocities, 1.0,
                     "normal velocity at the plane, towards the surface positive  [m/s]", "m/s")},
      {"restitution.svg", restitution_svg(averages, remark)},
  };
}

}  // namespace recoil
