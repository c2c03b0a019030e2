#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_style.hpp"
#include "report/format.hpp"
#include "report/panels.hpp"
#include "report/prediction.hpp"
#include "report/svg_plot.hpp"

namespace recoil {
namespace {

using Rows = std::vector<std::vector<double>>;

constexpr std::array<const char*, 3> average_colours = {style::blue, style::green,
                                                        style::vermillion};
constexpr std::array<const char*, 3> average_names = {"captured as e = 0", "captured left out",
                                                      "unseen left out"};
constexpr std::array<const char*, 3> average_dashes = {"", "dt (10,4)", "dt (3,3)"};

double or_nan(const std::optional<double>& value) { return value.value_or(std::nan("")); }

Rows banded_rows(const std::vector<double>& velocity, const std::vector<BandedValue>& values) {
  Rows rows;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    rows.push_back(
        {velocity[k], or_nan(values[k].value), or_nan(values[k].lower), or_nan(values[k].upper)});
  }
  return rows;
}

Rows curve_of(const PolydispersePrediction& mixture, const SizeCurve& size) {
  Rows rows;
  for (std::size_t k = 0; k < mixture.velocity.size(); ++k) {
    rows.push_back({mixture.velocity[k], size.restitution[k]});
  }
  return rows;
}

PlotScript script_of(const Analysis& analysis, const PolydispersePrediction& mixture,
                     const char* name, const std::string& title) {
  const std::string& id = analysis.datasets[mixture.dataset].id;
  PlotScript script;
  script.name = fmt::format("mixture-{}-{}", name, mixture.dataset + 1);
  script.title = fmt::format("{}, {}", title, id);
  script.height = 390;
  const double first = mixture.velocity.front();
  const double last = mixture.velocity.back();
  script.commands =
      style::preamble() + style::title(title, analysis.datasets.size() > 1 ? id : "") +
      fmt::format("set logscale x\nset xrange [{:.6g}:{:.6g}]\n", first, last) +
      log_ticks('x', first, last) + "set xlabel 'incident velocity V  [m/s]' offset 0,0.4\n";
  return script;
}

/// The points of the dataset: the data block and its layers.
void add_points(const Analysis& analysis, std::size_t dataset, std::string& commands,
                std::vector<std::string>& layers) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < analysis.fitted.data.points.size(); ++i) {
    if (analysis.fitted.data.points[i].dataset == dataset) indices.push_back(i);
  }
  commands += data_block("points", point_rows(analysis, indices).rebounds);
  if (analysis.fitted.data.sd_stated) {
    layers.push_back(fmt::format(
        "$points using 1:($2-$3):(0):(2*$3) with vectors nohead lc rgb '{}' lw 1.2 notitle",
        style::ink));
  }
  layers.push_back(fmt::format("$points using 1:2 with points lc rgb '{}' pt 7 ps 0.5 title {}",
                               style::ink,
                               gnuplot_text(to_string(analysis.datasets[dataset].provenance))));
}

Figure sizes_figure(const Analysis& analysis, const PolydispersePrediction& mixture) {
  PlotScript script =
      script_of(analysis, mixture, "sizes", "The smallest sphere, the mean one, the largest");
  std::string& c = script.commands;
  c += "set yrange [0:1.05]\nset ylabel 'restitution e' offset 1.2,0\n" + style::key_below(2);
  std::vector<std::string> layers;
  std::vector<std::string> captures;
  for (std::size_t i = 0; i < mixture.size_curves.size(); ++i) {
    const SizeCurve& size = mixture.size_curves[i];
    c += data_block(fmt::format("size{}", i), curve_of(mixture, size));
    layers.push_back(fmt::format("$size{} using 1:2 with lines lc rgb '{}' lw 2 {} title {}", i,
                                 average_colours[i], average_dashes[i],
                                 gnuplot_text(fmt::format("{} µm", diameter_text(size.diameter)))));
    captures.push_back(size.capture_velocity > 0.0
                           ? fmt::format("{} m/s ({} um)", number(size.capture_velocity, 3),
                                         diameter_text(size.diameter))
                           : fmt::format("none found ({} um)", diameter_text(size.diameter)));
  }
  add_points(analysis, mixture.dataset, c, layers);
  c += fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  const std::string caption = fmt::format(
      "{}. One curve for each of three sizes with the same C_H and C_A, f0 by eq. 12, as in Fig. "
      "10 "
      "of Li, Dunn & Brach (1999). Capture velocities: {}.",
      analysis.datasets[mixture.dataset].id, fmt::join(captures, ", "));
  return {script.name, script.title, caption, draw_svg(script)};
}

Figure averages_figure(const Analysis& analysis, const PolydispersePrediction& mixture) {
  PlotScript script = script_of(analysis, mixture, "average", "Weighted averages over the sizes");
  std::string& c = script.commands;
  c += "set yrange [0:1.05]\nset ylabel 'restitution e' offset 1.2,0\n" + style::key_below(3);
  std::vector<std::string> lines;
  std::vector<std::string> layers;
  for (std::size_t k = 0; k < all_conventions.size(); ++k) {
    c += data_block(fmt::format("average{}", k), banded_rows(mixture.velocity, mixture.average[k]));
    layers.push_back(
        fmt::format("$average{} using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.2 "
                    "noborder notitle",
                    k, average_colours[k]));
    lines.push_back(fmt::format("$average{} using 1:2 with lines lc rgb '{}' lw 2 {} title {}", k,
                                average_colours[k], average_dashes[k],
                                gnuplot_text(average_names[k])));
  }
  layers.insert(layers.end(), lines.begin(), lines.end());
  c += data_block("single", curve_of(mixture, mixture.size_curves[1]));
  layers.push_back(
      fmt::format("$single using 1:2 with lines lc rgb '{}' lw 1.4 title {}", style::grey,
                  gnuplot_text(fmt::format("d10 = {} µm alone",
                                           diameter_text(mixture.size_curves[1].diameter)))));
  add_points(analysis, mixture.dataset, c, layers);
  c += fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  const std::string caption = fmt::format(
      "{}. The average over {} sizes under three conventions, with pointwise {} bands{}, beside "
      "the "
      "simulation of d10 alone (Figs. 11 and 12 of Li, Dunn & Brach 1999). Too slow to be seen: "
      "below {} m/s, which does not climb {} mm.",
      analysis.datasets[mixture.dataset].id, mixture.simulated, percent(mixture.level),
      mixture.replicates == 0 ? " (none: no bootstrap)" : "", number(mixture.slowest_seen, 3),
      number(1e3 * mixture.probe_height, 3));
  return {script.name, script.title, caption, draw_svg(script)};
}

Figure captured_figure(const Analysis& analysis, const PolydispersePrediction& mixture) {
  PlotScript script =
      script_of(analysis, mixture, "captured", "How many spheres stay, or are not seen again");
  std::string& c = script.commands;
  c += "set yrange [0:1.05]\nset ylabel 'part of the spheres' offset 1.2,0\n" + style::key_below(1);
  c += data_block("captured", banded_rows(mixture.velocity, mixture.captured));
  c += data_block("unseen", banded_rows(mixture.velocity, mixture.unseen));
  c += fmt::format(
      "plot $captured using 1:3:4 with filledcurves fc rgb '{0}' fs transparent solid 0.2 noborder "
      "notitle, \\\n"
      "  $unseen using 1:3:4 with filledcurves fc rgb '{1}' fs transparent solid 0.2 noborder "
      "notitle, \\\n"
      "  $captured using 1:2 with lines lc rgb '{0}' lw 2 title 'captured', \\\n"
      "  $unseen using 1:2 with lines lc rgb '{1}' lw 2 dt (3,3) title 'captured or too slow'\n",
      style::blue, style::vermillion);
  const std::string caption = fmt::format(
      "{}. Part of the spheres by number, with pointwise {} bands. Steps are those of the {} "
      "sizes.",
      analysis.datasets[mixture.dataset].id, percent(mixture.level), mixture.simulated);
  return {script.name, script.title, caption, draw_svg(script)};
}

}  // namespace

std::vector<Figure> mixture_figures(const Analysis& analysis,
                                    const PolydispersePrediction& mixture) {
  return {averages_figure(analysis, mixture), sizes_figure(analysis, mixture),
          captured_figure(analysis, mixture)};
}

std::vector<Figure> mixture_figures(const Analysis& analysis) {
  std::vector<Figure> all;
  for (const PolydispersePrediction& mixture : analysis.mixtures) {
    for (Figure& figure : mixture_figures(analysis, mixture)) all.push_back(std::move(figure));
  }
  return all;
}

}  // namespace recoil
