#include "validation/studies/paper_fit.hpp"

#include <algorithm>

#include "experiment/pairing_files.hpp"
#include "report/fit_report.hpp"
#include "report/format.hpp"

namespace recoil::paper {
namespace {

std::string contact_words(const Fit& fit) {
  return fit.data().system.particle.name + " on " + fit.data().system.surface.name;
}

}  // namespace

Figure figure(const std::string& name, const std::string& title, plot::Plot plot,
              const Sentence& caption, int height) {
  plot::Picture picture{.name = "picture-" + name, .title = title, .height = height, .plots = {}};
  picture.plots.push_back(std::move(plot));
  return figure_of(std::move(picture), caption);
}

plot::Plot histogram_plot(const std::vector<double>& values, const std::string& label,
                          const std::string& unit_name, double unit_size) {
  const Histogram histogram = sturges(values);
  plot::Boxes bars;
  double highest = 0.0;
  for (std::size_t k = 0; k < histogram.counts.size(); ++k) {
    const auto count = static_cast<double>(histogram.counts[k]);
    bars.add(histogram.edge(k) / unit_size, histogram.edge(k + 1) / unit_size, 0.0, count);
    highest = std::max(highest, count);
  }
  plot::Plot shown;
  shown.x = {label, unit_name};
  shown.x.set_range({bars.left.front(), bars.right.back()});
  shown.y = {"count"};
  shown.y.set_range({0.0, 1.08 * highest});
  shown.layers.push_back(std::move(bars));
  return shown;
}

plot::Plot restitution_plot(plot::Range velocity) {
  plot::Plot shown;
  shown.x = velocity_axis(velocity);
  shown.y = restitution_axis({0.0, 1.05});
  shown.key = plot::KeyPlace::below;
  return shown;
}

plot::Points points_of(const Fit& fit, double diameter, plot::Marker marker,
                       const std::string& name) {
  plot::Points points;
  points.marker = marker;
  points.name = name;
  std::vector<double> sd;
  for (const Observation& point : fit.a.fitted.data.points) {
    if (diameter > 0.0 && point.diameter != diameter) continue;
    points.x.push_back(point.velocity);
    points.y.push_back(point.restitution);
    sd.push_back(point.sd);
  }
  return points.with_sd(sd);
}

Figure calibrations_figure(const Fit& fit, const std::string& name, plot::Range velocity) {
  plot::Plot shown = restitution_plot(velocity);
  shown.heading = contact_words(fit);
  const auto& curves = fit.a.uncertainty.curves;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const plot::Marker& marker = plot::marker(k);
    const CurveColumns columns = curve_columns(curves[k]);
    shown.layers.push_back(plot::Line{columns.velocity, columns.restitution, {marker.colour, 1.7}});
    shown.layers.push_back(
        plot::Line{columns.velocity, columns.two_point, {marker.colour, 1.7, plot::dashes}});
    shown.layers.push_back(
        points_of(fit, curves[k].diameter, marker, diameter_label(curves[k].diameter)));
  }
  return figure(name, "Restitution, " + contact_words(fit), std::move(shown),
                say("Solid: all points. Dashed: two points. Points: {} {+/-} 1 sd.",
                    to_string(fit.data().provenance)),
                375);
}

Table calibration_table(const Fit& fit) {
  Table table = two_point_table(fit.a, fit.two_point());
  table.caption = contact_words(fit);
  table.compact = false;
  return table;
}

Sentence capture_words(const Fit& fit) {
  const CaptureEstimate* capture = reference_capture(fit.a, 0);
  return capture == nullptr ? Sentence("unknown")
                            : with_interval(capture->value, capture->interval, padded(3)).words();
}

Number estimate_of(const Fit& fit, const std::vector<std::size_t>& slots) {
  const std::size_t slot = slots.at(0);
  return {fit.a.fitted.theta.at(slot), significant(3), fit.a.fitted.std_error.at(slot)};
}

}  // namespace recoil::paper
