#include "report/experiment_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/units.hpp"

namespace recoil {
namespace {

/// Bars whose areas are shares, so that two rules can stand on one axis [% per unit].
plot::Boxes density_bars(const Histogram& histogram, double unit, std::size_t total) {
  plot::Boxes bars;
  const double width = histogram.width / unit;
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const double share = 100.0 * static_cast<double>(histogram.counts[i]) /
                         static_cast<double>(std::max<std::size_t>(total, 1));
    bars.add(histogram.edge(i) / unit, histogram.edge(i + 1) / unit, 0.0, share / width);
  }
  return bars;
}

/// The line around the bars.
plot::Line outline_of(const plot::Boxes& bars) {
  plot::Line line;
  const auto go = [&line](double x, double y) {
    line.x.push_back(x);
    line.y.push_back(y);
  };
  for (std::size_t i = 0; i < bars.size(); ++i) {
    if (i == 0) go(bars.left[i], 0.0);
    go(bars.left[i], bars.top[i]);
    go(bars.right[i], bars.top[i]);
    if (i + 1 == bars.size()) go(bars.right[i], 0.0);
  }
  return line;
}

plot::Picture histogram_picture(const std::string& name, const std::string& title,
                                const std::string& remark, const std::vector<double>& values,
                                double unit, const plot::Axis& axis) {
  const Histogram coarse = sturges(values);
  const Histogram fine = freedman_diaconis(values);
  plot::Boxes bars = density_bars(coarse, unit, values.size());
  bars.fill = {std::string(plot::sky), 0.55, true};
  bars.name = fmt::format("Sturges' rule, {} bins", coarse.counts.size());
  plot::Line line = outline_of(density_bars(fine, unit, values.size()));
  line.stroke = {plot::vermillion, 1.3};
  line.name = fmt::format("Freedman-Diaconis, {} bins", fine.counts.size());

  plot::Plot shown;
  shown.heading = title;
  shown.remark = remark;
  shown.x = axis;
  shown.y = {"share", "% per " + axis.unit};
  shown.y.from = 0.0;
  shown.key = {plot::KeyPlace::below, 1};
  shown.layers = {std::move(bars), std::move(line)};
  return {name, title, 560, 360, {std::move(shown)}};
}

plot::Picture restitution_picture(const Averages& averages, const std::string& remark) {
  constexpr double normal_95 = 1.96;
  struct Series {
    plot::Points points;
    std::vector<double> half_widths;
  };
  std::map<std::string, Series> by_series;
  std::vector<double> velocities;
  plot::Points captured;
  captured.marker.mark = plot::Mark::cross;
  captured.size = 1.0;
  captured.name = "all captured";
  for (const PointMean& point : averages.points) {
    velocities.push_back(point.velocity);
    if (point.rebounds == 0) {
      captured.x.push_back(point.velocity);
      captured.y.push_back(0.0);
      continue;
    }
    Series& series = by_series[point.series];
    series.points.x.push_back(point.velocity);
    series.points.y.push_back(point.restitution);
    series.half_widths.push_back(normal_95 * point.restitution_sd);
  }
  plot::Plot shown;
  shown.heading = "Coefficient of restitution against incident velocity";
  shown.remark = remark;
  shown.x = {"incident normal velocity at the surface", "m/s"};
  shown.x.logarithmic = true;
  shown.x.set_range(plot::log_range_of(velocities, 0.05));
  shown.y = {"mean restitution of the rebounds"};
  shown.y.set_range({0.0, 1.05});
  shown.y.about = 5;
  shown.key = {plot::KeyPlace::below, static_cast<int>(by_series.size() + 2) / 3};
  std::size_t index = 0;
  for (auto& [name, series] : by_series) {
    series.points.with_sd(series.half_widths);
    series.points.marker = plot::marker(index++);
    series.points.size = 0.6;
    series.points.name = name;
    shown.layers.push_back(std::move(series.points));
  }
  if (!captured.x.empty() || shown.layers.empty()) shown.layers.push_back(std::move(captured));
  return {"restitution", shown.heading, 560, 380, {shown}};
}

}  // namespace

std::vector<plot::Picture> experiment_pictures(const Distributions& distributions,
                                               const Averages& averages,
                                               const std::string& remark) {
  const plot::Axis velocity{"normal velocity at the plane, towards the surface positive", "m/s"};
  return {
      histogram_picture(
          "sizes", fmt::format("Sizes of {} incoming spheres", distributions.incoming_sizes.size()),
          remark, distributions.incoming_sizes, units::um, {"diameter", "µm"}),
      histogram_picture("velocities-raw",
                        fmt::format("Normal velocities, {} passages as recorded",
                                    distributions.raw_velocities.size()),
                        remark, distributions.raw_velocities, 1.0, velocity),
      histogram_picture("velocities-paired",
                        fmt::format("Normal velocities, {} paired impacts",
                                    distributions.paired_velocities.size() / 2),
                        remark, distributions.paired_velocities, 1.0, velocity),
      restitution_picture(averages, remark)};
}

}  // namespace recoil
