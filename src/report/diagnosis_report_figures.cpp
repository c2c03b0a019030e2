#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/diagnosis_result.hpp"
#include "estimate/observation.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "report/diagnosis_report.hpp"
#include "report/format.hpp"
#include "report/words_diagnosis.hpp"

namespace recoil {
namespace {

constexpr int curve_points = 80;
constexpr double largest_z = 6.0;  // most at the ends of the colour scale

std::string in_dataset(const Diagnosis& d, std::size_t dataset) {
  return d.datasets.size() > 1 ? ", " + d.datasets[dataset].id : std::string();
}

/// The deviations of the points of a dataset from the base model.
struct Deviations {
  std::vector<double> velocities, diameters;  ///< [m/s], [size_unit]
  std::vector<double> in_e;                   ///< e - e_model
  std::vector<double> in_sd;                  ///< `in_e` in standard deviations
};

std::string size_text(const Diagnosis& d, double diameter) {
  const SizeUnit unit = size_unit(d.datasets);
  return size_text(diameter, unit) + " " + unit.sign;
}

Deviations deviations_of(const Diagnosis& d, std::size_t dataset) {
  Deviations all;
  const double unit = size_unit(d.datasets).metres;
  for (std::size_t i = 0; i < d.base.data.points.size(); ++i) {
    const Observation& point = d.base.data.points[i];
    if (point.dataset != dataset || point.counts_only()) continue;
    const PointWeights& own = d.base.weights.points[i];
    const double deviation = (point.censored ? 0.0 : point.restitution) -
                             expected_restitution(point, own, d.base.prediction_squared[i]);
    all.velocities.push_back(point.velocity);
    all.diameters.push_back(point.diameter / unit);
    all.in_e.push_back(deviation);
    all.in_sd.push_back(own.sd > 0.0 ? deviation / own.sd : 0.0);
  }
  return all;
}

/// Did the dataset measure an e or a capture? Counts alone have no deviation to draw.
bool has_deviations(const Diagnosis& d, std::size_t dataset) {
  return !deviations_of(d, dataset).velocities.empty();
}

/// The range of the values for a logarithmic axis. The margin is a power of the ratio of largest
/// and smallest value, which counts as at least 1.5.
plot::Range log_range(const std::vector<double>& values, double margin) {
  const auto [low, high] = std::ranges::minmax_element(values);
  const double factor = std::pow(std::max(*high / *low, 1.5), margin);
  return {*low / factor, *high * factor};
}

plot::Axis velocity_axis_of(const Deviations& deviations, double margin) {
  plot::Axis axis{"V", "m/s"};
  axis.logarithmic = true;
  axis.set_range(log_range(deviations.velocities, margin));
  return axis;
}

/// Ticks at the diameters; empty if there are many. Diameters close to the previous tick have none.
std::vector<plot::Tick> size_ticks(std::vector<double> diameters, plot::Range range) {
  constexpr std::size_t most = 8;
  const double nearest = std::pow(range.upper / range.lower, 0.07);
  std::ranges::sort(diameters);
  std::vector<plot::Tick> ticks;
  for (const double d : diameters) {
    if (!ticks.empty() && d < ticks.back().at * nearest) continue;
    ticks.push_back({d, fmt::format("{:.6g}", d)});
  }
  if (ticks.size() > most) ticks.clear();
  return ticks;
}

/// The axis of the diameters or, for a single diameter, of the deviations.
plot::Axis vertical_axis(const Diagnosis& d, const Deviations& deviations, bool one_size) {
  plot::Axis axis;
  if (one_size) {
    axis.label = "e - e_model";
    std::vector<double> shown = deviations.in_e;
    shown.push_back(0.0);
    axis.set_range(plot::range_of(shown, 0.12));
    return axis;
  }
  axis = {"d", size_unit(d.datasets).sign};
  axis.logarithmic = true;
  const plot::Range range = log_range(deviations.diameters, 0.25);
  axis.set_range(range);
  axis.ticks = size_ticks(deviations.diameters, range);
  return axis;
}

Figure misfit_figure(const Diagnosis& d, std::size_t dataset) {
  const Deviations deviations = deviations_of(d, dataset);
  const bool one_size = std::ranges::all_of(
      deviations.diameters, [&](double size) { return size == deviations.diameters.front(); });
  plot::Plot shown;
  shown.x = velocity_axis_of(deviations, 0.06);
  shown.y = vertical_axis(d, deviations, one_size);
  double end = 2.0;  // of the colour scale
  for (const double z : deviations.in_sd)
    end = std::max(end, std::min(std::ceil(std::abs(z)), largest_z));
  shown.colours =
      plot::ColourScale{"(e - e_model) / sd",
                        {-end, end},
                        {{-1.0, plot::blue}, {0.0, "#EEEEEE"}, {1.0, plot::vermillion}}};
  if (one_size) {
    shown.layers.push_back(plot::Rule{.vertical = false, .at = 0.0, .stroke = {plot::ink, 1.0}});
    shown.layers.push_back(plot::Words{
        fmt::format("d = {:.4g} {}", deviations.diameters.front(), size_unit(d.datasets).sign),
        plot::share_of_plot(0.03), plot::share_of_plot(0.94)});
  }
  shown.layers.push_back(plot::Discs{
      deviations.velocities, one_size ? deviations.in_e : deviations.diameters, deviations.in_sd});
  return figure_of(
      {.name = fmt::format("misfit-{}", dataset),
       .title = "Misfit of the base model against velocity and diameter" + in_dataset(d, dataset),
       .height = 300,
       .plots = {std::move(shown)}},
      "Each disc is a point; larger discs deviate by more standard deviations. "
      "Orange: e is above the model; blue: below. Patches of one colour indicate "
      "structure, a mixture indicates noise.");
}

/// The curves of the base and the extended model for one diameter.
struct TwoCurves {
  std::vector<double> velocity, base, extended;
};

TwoCurves curves_of(const Diagnosis& d, std::size_t dataset, double diameter, std::size_t series,
                    plot::Range velocities) {
  TwoCurves curves;
  curves.velocity = log_spaced(velocities.lower, velocities.upper, curve_points);
  const auto curve_of = [&](const FitResult& fit) {
    return restitution_curve(fit.model, fit.theta, {dataset, diameter, 0.0, series},
                             curves.velocity);
  };
  curves.base = curve_of(d.base);
  curves.extended = curve_of(*d.extended()->fit);
  return curves;
}

/// The axis of e. It begins at 0 unless all points are above 0.7.
plot::Axis axis_around_points(const Diagnosis& d, std::size_t dataset) {
  double top = 0.0;
  double bottom = 1.0;
  for (std::size_t i = 0; i < d.base.data.points.size(); ++i) {
    const Observation& point = d.base.data.points[i];
    if (point.dataset != dataset) continue;
    const double sd = d.base.weights.points[i].sd;
    top = std::max(top, point.restitution + 2.0 * sd);
    bottom = std::min(bottom, point.censored ? 0.0 : point.restitution - 2.0 * sd);
  }
  const bool high = bottom > 0.7;
  const double room = 0.3 * (top - bottom);
  plot::Axis axis{"e"};
  if (high) {
    axis.set_range({bottom - room, top + room});
  } else {
    axis.set_range({0.0, 1.03 * std::max(top, 1.0)});
  }
  return axis;
}

Figure before_after_figure(const Diagnosis& d, std::size_t dataset) {
  struct Measured {
    std::vector<double> velocity, restitution, sd;
    std::size_t series = 0;
  };
  std::map<double, Measured> sizes;
  for (std::size_t i = 0; i < d.base.data.points.size(); ++i) {
    const Observation& point = d.base.data.points[i];
    if (point.dataset != dataset || point.counts_only()) continue;
    Measured& size = sizes[point.diameter];
    size.velocity.push_back(point.velocity);
    size.restitution.push_back(point.censored ? 0.0 : point.restitution);
    size.sd.push_back(d.base.weights.points[i].sd);
    size.series = point.series;
  }
  plot::Plot shown;
  shown.x = velocity_axis_of(deviations_of(d, dataset), 0.04);
  shown.y = axis_around_points(d, dataset);
  shown.key = plot::KeyPlace::above;
  std::size_t k = 0;
  for (const auto& [diameter, size] : sizes) {
    const plot::Marker& marker = plot::marker(k++);
    const TwoCurves curves =
        curves_of(d, dataset, diameter, size.series, {shown.x.from, shown.x.to});
    shown.layers.push_back(
        plot::Line{curves.velocity, curves.base, {marker.colour, 1.2, plot::dashes}});
    shown.layers.push_back(plot::Line{curves.velocity, curves.extended, {marker.colour, 2.0}});
    plot::Points points{size.velocity, size.restitution};
    points.with_sd(size.sd);
    points.marker = marker;
    points.size = 0.7;
    points.width = 1.0;
    if (sizes.size() <= plot::markers.size()) points.name = size_text(d, diameter);
    shown.layers.push_back(std::move(points));
  }
  return figure_of({.name = fmt::format("before-after-{}", dataset),
                    .title = "Restitution against velocity under the base and the extended model" +
                             in_dataset(d, dataset),
                    .width = 560,
                    .height = 380,
                    .plots = {std::move(shown)}},
                   fmt::format("Dashed: the model. Solid: extended by {}. Error bars are one "
                               "standard deviation.",
                               words_of(d.extended()->cause.candidate.name())));
}

}  // namespace

std::vector<Figure> misfit_figures(const Diagnosis& d) {
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < d.datasets.size(); ++k) {
    if (has_deviations(d, k)) figures.push_back(misfit_figure(d, k));
  }
  return figures;
}

std::vector<Figure> before_after_figures(const Diagnosis& d) {
  std::vector<Figure> figures;
  if (!d.extended() || !d.extended()->fit) return figures;
  for (std::size_t k = 0; k < d.datasets.size(); ++k) {
    if (has_deviations(d, k)) figures.push_back(before_after_figure(d, k));
  }
  return figures;
}

}  // namespace recoil
