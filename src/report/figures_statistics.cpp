#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.hpp"
#include "report/density.hpp"
#include "report/figure_style.hpp"
#include "report/figures.hpp"
#include "report/format.hpp"
#include "report/svg_plot.hpp"
#include "report/words_intervals.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_residuals = 500;
constexpr std::size_t most_histograms = 16;

struct ResidualRow {
  double velocity;
  double diameter;
  double residual;
  bool censored;
};

std::vector<ResidualRow> residual_rows(const Analysis& analysis, std::size_t dataset) {
  std::vector<ResidualRow> rows;
  const double unit = residual_unit(analysis);
  const auto& points = analysis.data.points;
  for (std::size_t i = 0; i < points.size() && i < analysis.fitted.residuals.size(); ++i) {
    if (points[i].dataset != dataset) continue;
    rows.push_back({points[i].velocity, points[i].diameter, analysis.fitted.residuals[i] / unit,
                    points[i].censored});
  }
  return rows;
}

/// The residual axis, symmetric about zero, and the lines at two standard deviations.
std::string residual_axis(const std::vector<ResidualRow>& rows) {
  double largest = 3.2;
  for (const ResidualRow& row : rows) {
    if (std::isfinite(row.residual)) largest = std::max(largest, 1.1 * std::abs(row.residual));
  }
  return fmt::format(
      "set yrange [{:.4g}:{:.4g}]\nset ylabel 'residual  [sd]' offset 1.2,0\n"
      "set arrow 11 from graph 0, first 2 to graph 1, first 2 nohead lc rgb '{}' dt (4,4) back\n"
      "set arrow 12 from graph 0, first -2 to graph 1, first -2 nohead lc rgb '{}' dt (4,4) back\n"
      "set arrow 13 from graph 0, first 0 to graph 1, first 0 nohead lc rgb '{}' lw 1.2 back\n",
      -largest, largest, style::grey, style::grey, style::ink);
}

std::string residual_words(const Analysis& analysis) {
  return analysis.data.sd_stated
             ? "Residuals in standard deviations of each point (data minus fit)."
             : "Residuals in units of the noise level estimated from this fit (data minus fit), "
               "because no standard deviation is stated for every point.";
}

std::string beyond_two(const std::vector<ResidualRow>& rows) {
  const auto outside = std::count_if(rows.begin(), rows.end(), [](const ResidualRow& row) {
    return std::abs(row.residual) > 2.0;
  });
  return fmt::format(" {} of {} lie beyond the dashed lines at 2; about {:.0f} would by chance.",
                     outside, rows.size(), 0.0455 * static_cast<double>(rows.size()));
}

/// Residuals of one dataset against velocity, told apart by diameter while there are few.
PlotScript residual_velocity_script(const std::vector<ResidualRow>& rows) {
  std::map<double, std::vector<std::vector<double>>> by_diameter;
  std::vector<std::vector<double>> captured;
  std::vector<double> logs;
  const std::size_t stride = rows.size() / most_residuals + 1;
  for (std::size_t i = 0; i < rows.size(); i += stride) {
    logs.push_back(std::log10(rows[i].velocity));
    if (rows[i].censored) {
      captured.push_back({rows[i].velocity, rows[i].residual});
    } else {
      by_diameter[rows[i].diameter].push_back({rows[i].velocity, rows[i].residual});
    }
  }
  const style::Range range = style::range_of(logs, 0.05);
  const double lower = std::pow(10.0, range.lower);
  const double upper = std::pow(10.0, range.upper);
  PlotScript script;
  script.height = 320;
  std::string& c = script.commands;
  c = style::preamble() + residual_axis(rows) +
      fmt::format("set logscale x\nset xrange [{:.6g}:{:.6g}]\n", lower, upper) +
      log_ticks('x', lower, upper) + "set xlabel 'incident velocity V  [m/s]' offset 0,0.4\n" +
      style::key_above();
  std::vector<std::string> layers;
  const bool told_apart = by_diameter.size() <= style::markers.size();
  std::size_t index = 0;
  for (const auto& [diameter, block] : by_diameter) {
    const style::Marker marker = told_apart ? style::markers[index] : style::markers[0];
    c += data_block(fmt::format("r{}", index), block);
    layers.push_back(fmt::format("$r{} using 1:2 with points lc rgb '{}' pt {} ps 0.65 {}", index,
                                 marker.colour, marker.point,
                                 told_apart
                                     ? "title " + gnuplot_text(diameter_text(diameter) + " µm")
                                     : std::string("notitle")));
    ++index;
  }
  if (!captured.empty()) {
    c += data_block("captured", captured);
    layers.push_back(fmt::format(
        "$captured using 1:2 with points lc rgb '{}' pt 10 ps 0.9 title 'captured'", style::ink));
  }
  c += fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  return script;
}

/// Residuals of one dataset against diameter, with the mean of each and its standard error.
PlotScript residual_diameter_script(const std::vector<ResidualRow>& rows) {
  std::map<double, std::vector<double>> by_diameter;
  std::vector<std::vector<double>> cloud;
  std::vector<double> diameters;
  const std::size_t stride = rows.size() / most_residuals + 1;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double um = rows[i].diameter / units::um;
    by_diameter[um].push_back(rows[i].residual);
    diameters.push_back(um);
    if (i % stride == 0) cloud.push_back({um, rows[i].residual});
  }
  std::vector<std::vector<double>> means;
  for (const auto& [um, residuals] : by_diameter) {
    const double count = static_cast<double>(residuals.size());
    double sum = 0.0;
    for (const double residual : residuals) sum += residual;
    means.push_back({um, sum / count, 1.0 / std::sqrt(count)});
  }
  style::Range range = style::range_of(diameters, 0.08);
  if (by_diameter.size() == 1) range = {0.5 * diameters.front(), 1.5 * diameters.front()};
  PlotScript script;
  script.height = 320;
  std::string& c = script.commands;
  c = style::preamble() + residual_axis(rows) +
      fmt::format("set xrange [{:.6g}:{:.6g}]\n", range.lower, range.upper) +
      "set xlabel 'diameter d  [µm]' offset 0,0.4\n" + style::key_above() +
      data_block("cloud", cloud) + data_block("means", means);
  c += fmt::format(
      "plot $cloud using 1:2 with points lc rgb '{}' pt 6 ps 0.6 title 'points', \\\n"
      "  $means using 1:2:3 with yerrorbars lc rgb '{}' lw 2 pt 7 ps 0.8 title 'mean ± 1 sd '\n",
      style::sky, style::ink);
  return script;
}

template <class MakeScript>
std::vector<Figure> per_dataset(const Analysis& analysis, const std::string& id,
                                const std::string& title, const std::string& extra,
                                MakeScript make_script) {
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    const std::vector<ResidualRow> rows = residual_rows(analysis, k);
    if (rows.empty()) continue;
    PlotScript script = make_script(rows);
    script.name = fmt::format("{}-{}", id, k + 1);
    script.title = fmt::format("{}, {}", title, analysis.datasets[k].id);
    figures.push_back(
        {script.name, script.title,
         analysis.datasets[k].id + ". " + residual_words(analysis) + beyond_two(rows) + extra,
         draw_svg(script)});
  }
  return figures;
}

Figure bootstrap_figure(const Analysis& analysis, std::size_t slot) {
  const ParameterSlot& parameter = analysis.fitted.model.slots[slot];
  const double estimate = analysis.fitted.theta[slot];
  const IntervalSet set = intervals_of(analysis, slot);
  const Interval interval = recommended_interval(set);
  const style::Scale scale = style::scale_for(std::abs(estimate), parameter.unit);
  const std::vector<double> values =
      column(analysis.uncertainty.bootstrap.theta, slot, scale.factor);

  const style::Range bulk = style::quantile_range(values, 0.005, 0.995);
  std::vector<double> shown = {bulk.lower, bulk.upper, estimate * scale.factor};
  if (interval.available()) {
    shown.push_back(*interval.lower * scale.factor);
    shown.push_back(*interval.upper * scale.factor);
  }
  style::Range range = style::range_of(shown, 0.06);
  range.lower = std::max(range.lower, parameter.lower >= 0.0 ? 0.0 : -INFINITY);
  const Histogram h = histogram(values, range);

  PlotScript script;
  script.name = fmt::format("bootstrap-{}", slot + 1);
  script.title = fmt::format("Bootstrap distribution of {}", parameter.label());
  script.height = 300;
  std::string& c = script.commands;
  c = style::preamble() +
      fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [0:*]\nset boxwidth {:.6g}\n",
                  range.lower, range.upper, 0.92 * h.width) +
      fmt::format("set xlabel '{}{}  [{}]' offset 0,0.4\n", style::symbol(parameter.name),
                  parameter.dataset.empty() ? "" : ", " + parameter.dataset, scale.unit) +
      "set bmargin 3.6\nset ylabel 'replicates' offset 1,0\nset format x '%g'\nset xtics "
      "autofreq\n" +
      style::key_above();
  if (interval.available()) {
    c += fmt::format(
        "set object 1 rect from {:.6g}, graph 0 to {:.6g}, graph 1 fc rgb '{}' fs transparent "
        "solid 0.16 noborder behind\n",
        *interval.lower * scale.factor, *interval.upper * scale.factor, style::green);
  }
  c += fmt::format(
      "set arrow 1 from {:.6g}, graph 0 to {:.6g}, graph 1 nohead lc rgb '{}' lw 2 front\n",
      estimate * scale.factor, estimate * scale.factor, style::vermillion);
  c += data_block("bars", h.bars);
  c += fmt::format(
      "plot $bars using 1:2 with boxes fc rgb '{}' fs solid 0.75 noborder notitle, \\\n"
      "  NaN with lines lc rgb '{}' lw 2 title 'estimate'",
      style::sky, style::vermillion);
  if (interval.available()) {
    c += fmt::format(
        ", \\\n  NaN with filledcurves fc rgb '{}' fs transparent solid 0.16 title {}",
        style::green,
        gnuplot_text(fmt::format("{} interval ({})", percent(analysis.uncertainty.options.level),
                                 words_of(set.recommended))));
  }
  c += '\n';

  std::string caption = fmt::format("{} usable replicates of {} ({} bootstrap).", values.size(),
                                    analysis.uncertainty.bootstrap.replicates,
                                    to_string(analysis.uncertainty.bootstrap.scheme));
  if (h.outside > 0) {
    caption += fmt::format(" {} of them lie outside this picture.", h.outside);
  }
  if (interval.available()) {
    caption += fmt::format(" Recommended interval {} {}.", interval_text(interval), parameter.unit);
  } else {
    caption += fmt::format(" No recommended interval: {}.", missing_words(interval));
  }
  return {script.name, script.title, caption, draw_svg(script)};
}

}  // namespace

std::vector<Figure> residual_velocity_figures(const Analysis& analysis) {
  return per_dataset(analysis, "residual-velocity", "Weighted residuals against velocity",
                     " A trend along the axis is a misfit.", residual_velocity_script);
}

std::vector<Figure> residual_diameter_figures(const Analysis& analysis) {
  return per_dataset(analysis, "residual-diameter", "Weighted residuals against diameter",
                     " Means that wander from zero say that the model misjudges size.",
                     residual_diameter_script);
}

std::vector<Figure> bootstrap_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  if (analysis.uncertainty.bootstrap.theta.empty()) return figures;
  const auto& slots = analysis.fitted.model.slots;
  for (std::size_t slot = 0; slot < slots.size() && figures.size() < most_histograms; ++slot) {
    if (slots[slot].free) figures.push_back(bootstrap_figure(analysis, slot));
  }
  return figures;
}

}  // namespace recoil
