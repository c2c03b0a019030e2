#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "report/figure_style.hpp"
#include "report/format.hpp"
#include "report/prediction.hpp"
#include "report/svg_plot.hpp"
#include "report/words_predict.hpp"

namespace recoil {
namespace {

constexpr std::array<const char*, 5> colours = {style::blue, style::ink, style::vermillion,
                                                style::green, style::purple};
constexpr std::array<const char*, 5> dashes = {"", "dt (10,4)", "dt (3,3)", "dt (10,4,3,4)",
                                               "dt (6,3)"};

/// d ln V* / d ln d of a curve, from its ends; nothing where it is not positive.
std::optional<double> slope(const std::vector<double>& diameter, const CaptureCurve& curve) {
  if (diameter.size() < 2 || !(curve.velocity.front() > 0.0) || !(curve.velocity.back() > 0.0)) {
    return std::nullopt;
  }
  return std::log(curve.velocity.back() / curve.velocity.front()) /
         std::log(diameter.back() / diameter.front());
}

Figure figure_of(const Analysis& analysis, const CaptureComparison& comparison) {
  const Dataset& dataset = analysis.datasets[comparison.dataset];
  double lowest = INFINITY;
  double highest = 0.0;
  const auto widen = [&](double v) {
    if (!(v > 0.0) || !std::isfinite(v)) return;
    lowest = std::min(lowest, v);
    highest = std::max(highest, v);
  };
  for (const CaptureCurve& curve : comparison.curves) {
    for (const auto* values : {&curve.velocity, &curve.lower, &curve.upper}) {
      for (const double v : *values) widen(v);
    }
  }
  for (const PublishedCapture& one : comparison.published) widen(one.velocity);
  lowest /= 1.3;
  highest *= 1.3;
  const double smallest = comparison.diameter.front() / units::um;
  const double largest = comparison.diameter.back() / units::um;

  PlotScript script;
  script.name = fmt::format("capture-models-{}", comparison.dataset + 1);
  script.title = fmt::format("Capture velocity against diameter, {}", dataset.id);
  script.height = 430;
  std::string& c = script.commands;
  c = style::preamble() +
      style::title(
          fmt::format("{} on {}", dataset.system.particle.name, dataset.system.surface.name)) +
      fmt::format("set logscale xy\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n",
                  smallest, largest, lowest, highest) +
      log_ticks('x', smallest, largest) + log_ticks('y', lowest, highest) +
      "set xlabel 'diameter d  [µm]' offset 0,0.4\n"
      "set ylabel 'capture velocity V*  [m/s]' offset 1,0\n" +
      style::key_below(4);
  std::vector<std::string> layers;
  std::vector<std::string> words;
  for (std::size_t i = 0; i < comparison.curves.size(); ++i) {
    const CaptureCurve& curve = comparison.curves[i];
    std::vector<std::vector<double>> rows;
    for (std::size_t k = 0; k < comparison.diameter.size(); ++k) {
      rows.push_back({comparison.diameter[k] / units::um, curve.velocity[k],
                      curve.lower.empty() ? std::nan("") : curve.lower[k],
                      curve.upper.empty() ? std::nan("") : curve.upper[k]});
    }
    c += data_block(fmt::format("curve{}", i), rows);
    if (!curve.lower.empty()) {
      layers.push_back(
          fmt::format("$curve{} using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.2 "
                      "noborder notitle",
                      i, colours[i % colours.size()]));
    }
    layers.push_back(fmt::format("$curve{} using 1:2 with lines lc rgb '{}' lw 2 {} title {}", i,
                                 colours[i % colours.size()], dashes[i % dashes.size()],
                                 gnuplot_text(words_of(curve.model))));
    const auto falls = slope(comparison.diameter, curve);
    words.push_back(fmt::format("{}: {}{}", words_of(curve.model),
                                rests_on_words(comparison, curve.model),
                                falls ? fmt::format(", V* ~ d^{:.2f}", *falls) : std::string()));
  }
  std::vector<std::vector<double>> measured;
  std::vector<std::vector<double>> modelled;
  for (const PublishedCapture& one : comparison.published) {
    (one.measured ? measured : modelled).push_back({one.diameter / units::um, one.velocity});
    words.push_back(fmt::format("published, {} at {} um: {} m/s, {}", one.what,
                                diameter_text(one.diameter), number(one.velocity, 3), one.source));
  }
  const auto add_published = [&](const char* name, const auto& rows, int mark, const char* title) {
    if (rows.empty()) return;
    c += data_block(name, rows);
    layers.push_back(
        fmt::format("${} using 1:2 with points lc rgb '{}' pt {} ps 1.1 lw 1.6 title '{}'", name,
                    style::ink, mark, title));
  };
  add_published("measured", measured, 7, "published, measured");
  add_published("modelled", modelled, 6, "published, of a model");
  c += fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  for (const std::string& note : capture_notes(comparison, dataset)) words.push_back(note);
  const std::string caption =
      fmt::format("{}, with the {} band of the fit. {}.", dataset.id,
                  percent(analysis.uncertainty.options.level), fmt::join(words, "; "));
  return {script.name, script.title, caption, draw_svg(script)};
}

}  // namespace

std::vector<Figure> capture_comparison_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  for (const CaptureComparison& comparison : analysis.captures) {
    if (comparison.diameter.size() < 2 || comparison.curves.empty()) continue;
    figures.push_back(figure_of(analysis, comparison));
  }
  return figures;
}

}  // namespace recoil
