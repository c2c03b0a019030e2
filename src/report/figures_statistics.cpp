#include "report/figures_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/units.hpp"
#include "report/density.hpp"
#include "report/format.hpp"
#include "report/panels.hpp"
#include "report/parameter_axis.hpp"
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
  const auto& points = analysis.fitted.data.points;
  for (std::size_t i = 0; i < points.size() && i < analysis.fitted.residuals.size(); ++i) {
    if (points[i].dataset != dataset) continue;
    rows.push_back({points[i].velocity, points[i].diameter, analysis.fitted.residuals[i] / unit,
                    points[i].censored});
  }
  return rows;
}

/// Axes of residuals, symmetric about zero, with lines at two standard deviations.
plot::Plot residual_plot(const std::vector<ResidualRow>& rows) {
  double largest = 3.2;
  for (const ResidualRow& row : rows) {
    if (std::isfinite(row.residual)) largest = std::max(largest, 1.1 * std::abs(row.residual));
  }
  plot::Plot shown;
  shown.y = {"residual", "sd"};
  shown.y.set_range({-largest, largest});
  shown.key.place = plot::KeyPlace::above;
  for (const double at : {-2.0, 2.0}) {
    shown.layers.push_back(
        plot::Rule{plot::Direction::horizontal, at, {plot::grey, 1.0, plot::Dash::dashes}});
  }
  shown.layers.push_back(plot::Rule{plot::Direction::horizontal, 0.0, {plot::ink, 1.2}});
  return shown;
}

std::string residual_words(const Analysis& analysis) {
  return analysis.fitted.data.sd_stated
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
plot::Plot residuals_by_velocity(const std::vector<ResidualRow>& rows) {
  std::map<double, plot::Points> by_diameter;
  plot::Points captured;
  std::vector<double> velocities;
  const std::size_t stride = rows.size() / most_residuals + 1;
  for (std::size_t i = 0; i < rows.size(); i += stride) {
    velocities.push_back(rows[i].velocity);
    plot::Points& points = rows[i].censored ? captured : by_diameter[rows[i].diameter];
    points.x.push_back(rows[i].velocity);
    points.y.push_back(rows[i].residual);
  }
  plot::Plot shown = residual_plot(rows);
  shown.x = velocity_axis(plot::log_range_of(velocities, 0.05));
  const bool told_apart = by_diameter.size() <= plot::markers.size();
  std::size_t index = 0;
  for (auto& [diameter, points] : by_diameter) {
    points.marker = plot::marker(told_apart ? index++ : 0);
    points.size = 0.65;
    if (told_apart) points.name = diameter_label(diameter);
    shown.layers.push_back(std::move(points));
  }
  if (!captured.x.empty()) {
    captured.marker.mark = plot::Mark::open_triangle_down;
    captured.size = 0.9;
    captured.name = "captured";
    shown.layers.push_back(std::move(captured));
  }
  return shown;
}

/// Residuals of one dataset against diameter, with the mean of each and its standard error; none
/// where there is one diameter.
std::optional<plot::Plot> residuals_by_diameter(const std::vector<ResidualRow>& rows) {
  std::map<double, std::vector<double>> by_diameter;
  plot::Points cloud;
  cloud.marker = {plot::sky, plot::Mark::circle};
  cloud.size = 0.6;
  cloud.width = 1.0;
  cloud.name = "points";
  std::vector<double> diameters;
  for (const ResidualRow& row : rows) diameters.push_back(row.diameter);
  const SizeUnit unit = size_unit(diameters);
  diameters.clear();
  const std::size_t stride = rows.size() / most_residuals + 1;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double size = rows[i].diameter / unit.metres;
    by_diameter[size].push_back(rows[i].residual);
    diameters.push_back(size);
    if (i % stride != 0) continue;
    cloud.x.push_back(size);
    cloud.y.push_back(rows[i].residual);
  }
  if (by_diameter.size() == 1) return std::nullopt;
  plot::Points means;
  std::vector<double> errors;
  for (const auto& [size, residuals] : by_diameter) {
    const double count = static_cast<double>(residuals.size());
    double sum = 0.0;
    for (const double residual : residuals) sum += residual;
    means.x.push_back(size);
    means.y.push_back(sum / count);
    errors.push_back(1.0 / std::sqrt(count));
  }
  means.with_sd(errors);
  means.size = 0.8;
  means.width = 2.0;
  means.name = "mean ± 1 sd";
  plot::Plot shown = residual_plot(rows);
  shown.x = {"diameter d", unit.sign};
  shown.x.set_range(plot::range_of(diameters, 0.08));
  shown.layers.push_back(std::move(cloud));
  shown.layers.push_back(std::move(means));
  return shown;
}

template <class MakePlot>
std::vector<Figure> per_dataset(const Analysis& analysis, const std::string& name,
                                const std::string& title, const std::string& extra,
                                MakePlot make_plot) {
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    const std::vector<ResidualRow> rows = residual_rows(analysis, k);
    if (rows.empty()) continue;
    std::optional<plot::Plot> shown = make_plot(rows);
    if (!shown) continue;
    plot::Picture picture;
    picture.name = fmt::format("{}-{}", name, k + 1);
    picture.title = fmt::format("{}, {}", title, analysis.datasets[k].id);
    picture.height = 320;
    picture.plots = {*std::move(shown)};
    figures.push_back(figure_of(
        std::move(picture),
        analysis.datasets[k].id + ". " + residual_words(analysis) + beyond_two(rows) + extra));
  }
  return figures;
}

Figure bootstrap_figure(const Analysis& analysis, std::size_t slot) {
  const ParameterSlot& parameter = analysis.fitted.model.slots[slot];
  const double estimate = analysis.fitted.theta[slot];
  const IntervalSet set = intervals_of(analysis, slot);
  const Interval interval = recommended_interval(set);
  const auto [factor, axis] = parameter_axis(parameter, estimate);
  const std::vector<double> values = column(analysis.uncertainty.bootstrap.theta, slot, factor);

  const plot::Range bulk = plot::quantile_range(values, 0.005, 0.995);
  std::vector<double> ends = {bulk.lower, bulk.upper, estimate * factor};
  if (interval.available()) {
    ends.push_back(*interval.lower * factor);
    ends.push_back(*interval.upper * factor);
  }
  plot::Range range = plot::range_of(ends, 0.06);
  range.lower = std::max(range.lower, parameter.lower >= 0.0 ? 0.0 : -INFINITY);
  Bars bars = bars_of(values, range);
  bars.boxes.fill = {std::string(plot::sky), 0.75};

  plot::Plot shown;
  shown.x = axis;
  shown.x.set_range(range);
  shown.y = {"replicates"};
  shown.y.from = 0.0;
  shown.key.place = plot::KeyPlace::above;
  shown.layers.push_back(std::move(bars.boxes));
  plot::Rule middle{plot::Direction::vertical, estimate * factor, {plot::vermillion, 2.0}, true};
  middle.name = "estimate";
  shown.layers.push_back(std::move(middle));
  if (interval.available()) {
    plot::Region inside{*interval.lower * factor, *interval.upper * factor};
    inside.name = fmt::format("{} interval ({})", percent(analysis.uncertainty.options.level),
                              words_of(set.recommended));
    shown.layers.push_back(std::move(inside));
  }
  plot::Picture picture;
  picture.name = fmt::format("bootstrap-{}", slot + 1);
  picture.title = fmt::format("Bootstrap distribution of {}", parameter.label());
  picture.height = 300;
  picture.plots = {std::move(shown)};

  std::string caption = fmt::format("{} usable replicates of {} ({} bootstrap).", values.size(),
                                    analysis.uncertainty.bootstrap.replicates,
                                    to_string(analysis.uncertainty.bootstrap.scheme));
  if (bars.outside > 0) {
    caption += fmt::format(" {} of them lie outside this picture.", bars.outside);
  }
  if (interval.available()) {
    caption += fmt::format(" Recommended interval {} {}.", interval_text(interval),
                           parameter.parameter->unit);
  } else {
    caption += fmt::format(" No recommended interval: {}.", missing_words(interval));
  }
  return figure_of(std::move(picture), caption);
}

}  // namespace

std::vector<Figure> residual_velocity_figures(const Analysis& analysis) {
  return per_dataset(analysis, "residual-velocity", "Weighted residuals against velocity",
                     " A trend along the axis is a misfit.", residuals_by_velocity);
}

std::vector<Figure> residual_diameter_figures(const Analysis& analysis) {
  return per_dataset(analysis, "residual-diameter", "Weighted residuals against diameter",
                     " Means away from zero show that the model gets the dependence on size wrong.",
                     residuals_by_diameter);
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
