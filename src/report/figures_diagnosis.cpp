#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.hpp"
#include "report/diagnosis_report.hpp"
#include "report/figure_style.hpp"
#include "report/format.hpp"
#include "report/svg_plot.hpp"
#include "report/words_diagnosis.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_bars = 12;
constexpr int curve_points = 80;
constexpr double largest_z = 6.0;  // of the colour scale

std::string in_dataset(const Diagnosis& d, std::size_t dataset) {
  return d.datasets.size() > 1 ? ", " + d.datasets[dataset].id : std::string();
}

struct Rows {
  std::vector<double> velocities, diameters;
  std::vector<std::vector<double>> misses;  // V, d [size_unit], e - e_model, standardised, sd
};

/// Spheres are told in um, balls in mm.
struct SizeUnit {
  double metres;
  const char* name;
};
SizeUnit size_unit(const Diagnosis& d) {
  const auto& points = d.base.data.points;
  const bool balls = std::all_of(points.begin(), points.end(),
                                 [](const Observation& point) { return point.diameter >= 1e-3; });
  return balls ? SizeUnit{1e-3, "mm"} : SizeUnit{units::um, "µm"};
}

std::string size_text(const Diagnosis& d, double diameter) {
  const SizeUnit unit = size_unit(d);
  return diameter_text(diameter * units::um / unit.metres) + " " + unit.name;
}

Rows rows_of(const Diagnosis& d, std::size_t dataset) {
  Rows rows;
  const double unit = size_unit(d).metres;
  for (std::size_t i = 0; i < d.base.data.points.size(); ++i) {
    const Observation& point = d.base.data.points[i];
    if (point.dataset != dataset) continue;
    const double miss = (point.censored ? 0.0 : point.restitution) -
                        expected_restitution(point, d.base.prediction_squared[i]);
    rows.velocities.push_back(point.velocity);
    rows.diameters.push_back(point.diameter / unit);
    rows.misses.push_back({point.velocity, rows.diameters.back(), miss,
                           point.sd > 0.0 ? miss / point.sd : 0.0, point.sd});
  }
  return rows;
}

std::pair<double, double> log_range(const std::vector<double>& values, double margin) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double factor = std::pow(std::max(*high / *low, 1.5), margin);
  return {*low / factor, *high * factor};
}

/// Ticks at the diameters themselves, where they are few and far enough apart to be read.
std::string size_ticks(std::vector<double> diameters, double small, double big) {
  constexpr std::size_t most = 8;
  const double nearest = std::pow(big / small, 0.07);
  std::sort(diameters.begin(), diameters.end());
  std::vector<std::string> ticks;
  double last = 0.0;
  for (const double d : diameters) {
    if (d < last * nearest) continue;
    ticks.push_back(fmt::format("'{0:.6g}' {0:.6g}", d));
    last = d;
  }
  const std::string decimal = ticks.size() > most ? log_ticks('y', small, big) : std::string();
  return decimal.empty() ? fmt::format("set ytics ({})\n", fmt::join(ticks, ", ")) : decimal;
}

/// The axis of the diameters; of one diameter alone, that of the misses themselves.
std::string vertical_axis(const Diagnosis& d, const Rows& rows, bool one_size) {
  const char* unit = size_unit(d).name;
  if (!one_size) {
    const auto [small, big] = log_range(rows.diameters, 0.25);
    return fmt::format(
               "set logscale y\nset yrange [{:.6g}:{:.6g}]\nset ylabel 'd  [{}]' offset 1,0\n",
               small, big, unit) +
           size_ticks(rows.diameters, small, big);
  }
  std::vector<double> misses = {0.0};
  for (const std::vector<double>& row : rows.misses) misses.push_back(row[2]);
  const style::Range range = style::range_of(misses, 0.12);
  return fmt::format(
             "set yrange [{:.6g}:{:.6g}]\nset ylabel 'e - e_{{model}}' offset 1,0\n"
             "set xzeroaxis lt 1 lc rgb '{}' lw 1\n"
             "set label 1 'd = {:.4g} {}' at graph 0.03, graph 0.94 left\n",
             range.lower, range.upper, style::ink, rows.diameters.front(), unit) +
         style::few_ticks('y', range, 5);
}

Figure misfit_figure(const Diagnosis& d, std::size_t dataset) {
  const Rows rows = rows_of(d, dataset);
  const auto [slow, fast] = log_range(rows.velocities, 0.06);
  const bool one_size = std::all_of(rows.diameters.begin(), rows.diameters.end(),
                                    [&](double size) { return size == rows.diameters.front(); });
  PlotScript script;
  script.name = fmt::format("misfit-{}", dataset);
  script.title = "Where the base model misses, over velocity and diameter";
  script.height = 300;
  std::string& c = script.commands;
  c = style::preamble() +
      fmt::format(
          "set logscale x\nset xrange [{:.6g}:{:.6g}]\nset xlabel 'V  [m/s]' offset 0,0.4\n"
          "set palette defined (-1 '{}', 0 '#EEEEEE', 1 '{}')\nset cbrange [{:.3g}:{:.3g}]\n"
          "set cblabel '(e - e_{{model}}) / sd' offset 1,0\nunset key\n",
          slow, fast, style::blue, style::vermillion, -largest_z, largest_z) +
      log_ticks('x', slow, fast) + vertical_axis(d, rows, one_size);
  c += data_block("misses", rows.misses);
  // The area of a disc grows with the size of the miss, and is never nothing.
  c += fmt::format(
      "plot $misses using 1:{0}:(0.5+0.35*sqrt(abs($4))):4 with points pt 7 ps variable lc "
      "palette, "
      "$misses using 1:{0}:(0.5+0.35*sqrt(abs($4))) with points pt 6 ps variable lc rgb '#777777' "
      "lw 0.5\n",
      one_size ? 3 : 2);
  return {
      "misfit-" + std::to_string(dataset),
      "Where the model is too low or too high" + in_dataset(d, dataset),
      std::string("Every disc is a point. Orange: the measured e is higher than the fitted base "
                  "model; blue: lower. The larger, the more standard deviations. Patches of one "
                  "colour are structure; a mixture is noise.") +
          (one_size ? " There is one diameter: the height of a disc is its miss." : ""),
      draw_svg(script), false};
}

/// Is it the extended model, or one that cannot be told from it?
bool is_answer(const Diagnosis& d, const CandidateResult& c) {
  return d.extended && c.explains() && c.delta_aicc <= d.extended->delta_aicc + d.options.margin;
}

/// The base curve and the extended one of one diameter, as rows V, base, extended.
std::vector<std::vector<double>> curves_of(const Diagnosis& d, std::size_t dataset, double diameter,
                                           std::size_t series, double slow, double fast) {
  std::vector<PointConditions> points;
  for (int k = 0; k < curve_points; ++k) {
    points.push_back({dataset, diameter,
                      slow * std::pow(fast / slow, static_cast<double>(k) / (curve_points - 1)),
                      series});
  }
  const std::vector<Prediction> base = predict(d.base.model, d.base.theta, points, false);
  const std::vector<Prediction> extended =
      predict(d.extended_fit->model, d.extended_fit->theta, points, false);
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < points.size(); ++k) {
    rows.push_back({points[k].velocity, base[k].usable() ? base[k].restitution() : NAN,
                    extended[k].usable() ? extended[k].restitution() : NAN});
  }
  return rows;
}

Figure before_after_figure(const Diagnosis& d, std::size_t dataset) {
  const Rows rows = rows_of(d, dataset);
  const auto [slow, fast] = log_range(rows.velocities, 0.04);
  std::map<double, std::vector<std::vector<double>>> points;
  std::map<double, std::size_t> series;
  double top = 0.0;
  double bottom = 1.0;
  for (const Observation& point : d.base.data.points) {
    if (point.dataset != dataset) continue;
    points[point.diameter].push_back(
        {point.velocity, point.censored ? 0.0 : point.restitution, point.sd});
    series[point.diameter] = point.series;
    top = std::max(top, point.restitution + 2.0 * point.sd);
    bottom = std::min(bottom, point.censored ? 0.0 : point.restitution - 2.0 * point.sd);
  }
  // The axis begins at nothing, unless all points lie high above.
  const bool high = bottom > 0.7;
  top = high ? top + 0.3 * (top - bottom) : 1.03 * std::max(top, 1.0);
  bottom = high ? bottom - 0.3 * (top - bottom) : 0.0;
  PlotScript script;
  script.name = fmt::format("extended-{}", dataset);
  script.title = "Restitution against velocity under the base and the extended model";
  script.width = 720;
  script.height = 420;
  std::string& c = script.commands;
  c = style::preamble() +
      fmt::format(
          "set logscale x\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.4g}:{:.4g}]\n"
          "set xlabel 'V  [m/s]' offset 0,0.4\nset ylabel 'e' offset 1,0\n",
          slow, fast, bottom, top) +
      style::key_above() + log_ticks('x', slow, fast);
  std::vector<std::string> layers;
  std::size_t k = 0;
  for (const auto& [diameter, rebounds] : points) {
    const style::Marker marker = style::markers[k % style::markers.size()];
    c += data_block(fmt::format("points{}", k), rebounds);
    c += data_block(fmt::format("curve{}", k),
                    curves_of(d, dataset, diameter, series[diameter], slow, fast));
    layers.push_back(fmt::format(
        "$curve{} using 1:2 with lines lc rgb '{}' lw 1.2 dt (5,4) notitle", k, marker.colour));
    layers.push_back(
        fmt::format("$curve{} using 1:3 with lines lc rgb '{}' lw 2 notitle", k, marker.colour));
    layers.push_back(
        fmt::format("$points{} using 1:2:3 with yerrorbars lc rgb '{}' pt {} ps 0.7 lw 1 {}", k,
                    marker.colour, marker.point,
                    points.size() <= 7 ? "title " + gnuplot_text(size_text(d, diameter))
                                       : std::string("notitle")));
    ++k;
  }
  c += fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  return {"before-after-" + std::to_string(dataset),
          "The fit before and after" + in_dataset(d, dataset),
          fmt::format("Dashed: the base model fitted to all points. Solid: extended by {}. Error "
                      "bars are one standard deviation.",
                      d.extended->candidate.name()),
          draw_svg(script), true};
}

}  // namespace

std::vector<Figure> misfit_figures(const Diagnosis& d) {
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < d.datasets.size(); ++k) figures.push_back(misfit_figure(d, k));
  return figures;
}

std::vector<Figure> before_after_figures(const Diagnosis& d) {
  std::vector<Figure> figures;
  if (!d.extended_fit) return figures;
  for (std::size_t k = 0; k < d.datasets.size(); ++k) figures.push_back(before_after_figure(d, k));
  return figures;
}

std::vector<Figure> ranking_figures(const Diagnosis& d) {
  std::vector<const CandidateResult*> shown;
  for (const CandidateResult& c : d.candidates) {
    if (c.delta_aicc < 0.0 && shown.size() < most_bars) shown.push_back(&c);
  }
  std::size_t pairs = 0;
  for (const CandidateResult& c : d.pairs) {
    if (c.delta_aicc < 0.0 && pairs++ < 4) shown.push_back(&c);
  }
  std::stable_sort(shown.begin(), shown.end(),
                   [](const auto* a, const auto* b) { return a->delta_aicc < b->delta_aicc; });
  if (shown.empty()) return {};
  PlotScript script;
  script.name = "ranking";
  script.title = "Candidates by what they gain over the base model";
  script.width = 720;
  script.height = 70 + 24 * static_cast<int>(shown.size());
  std::vector<std::vector<double>> taken, aside;
  std::vector<std::string> names, labels;
  double longest = 0.0;
  for (const CandidateResult* c : shown) longest = std::max(longest, -c->delta_aicc);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const CandidateResult& c = *shown[k];
    const auto row = static_cast<double>(k);
    (is_answer(d, c) ? taken : aside)
        .push_back({0.0, row, 0.0, -c.delta_aicc, row - 0.32, row + 0.32});
    names.push_back(fmt::format("{} {}", gnuplot_text(c.candidate.name()), row));
    const std::string label = short_set_aside_words(c);
    if (!label.empty()) {
      labels.push_back(
          fmt::format("set label {} at {:.6g},{} left offset 0.6,0 tc rgb '{}' "
                      "font ',9' front\n",
                      gnuplot_text(label), -c.delta_aicc, row, style::grey));
    }
  }
  std::string& c = script.commands;
  c = style::preamble() +
      fmt::format(
          "set xrange [0:{:.6g}]\nset yrange [{:.3g}:-0.6]\nset ytics ({}) nomirror\n"
          "set lmargin 34\nset xlabel 'gain of the corrected criterion (AICc)' offset 0,0.4\nunset "
          "key\nset style fill solid 0.85 noborder\n",
          1.75 * longest, static_cast<double>(shown.size()) - 0.4, fmt::join(names, ", "));
  for (const std::string& label : labels) c += label;
  std::vector<std::string> layers;
  const auto layer = [&](const char* name, const std::vector<std::vector<double>>& rows,
                         const char* colour) {
    if (rows.empty()) return;
    c += data_block(name, rows);
    layers.push_back(
        fmt::format("${} using 1:2:3:4:5:6 with boxxyerror lc rgb '{}'", name, colour));
  };
  layer("taken", taken, style::blue);
  layer("aside", aside, "#BBBBBB");
  c += fmt::format("plot {}\n", fmt::join(layers, ", "));
  return {
      {"ranking", "What could explain it",
       fmt::format(
           "The longer the bar, the better the whole model fits with this added, its "
           "parameters paid for. Blue: the answer. Grey: further behind, or set aside "
           "for the reason beside it. Bars within {:.0f} of each other ({:.0f} where two act at "
           "once) cannot be told apart.",
           d.options.margin, d.options.margin_in_pairs),
       draw_svg(script), true}};
}

}  // namespace recoil
