#include "report/panels.hpp"

#include <algorithm>
#include <cmath>

#include "report/format.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_panels = 24;  // limits the size of a page to about 1 MB
constexpr std::size_t most_curve_points = 120;
constexpr double farthest_capture = 5.0;  // slowest point over a capture velocity that is shown

/// Assigns every point to a panel (see `panels_of`).
void distribute_points(const Analysis& analysis, std::vector<Panel>& panels) {
  const auto& points = analysis.fitted.data.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Panel* nearest = nullptr;
    double smallest = INFINITY;
    for (Panel& panel : panels) {
      if (panel.dataset != points[i].dataset) continue;
      const auto& names = analysis.datasets[panel.dataset].series;
      const bool own = points[i].series < names.size() && names[points[i].series] == panel.series;
      const double distance =
          std::abs(std::log(points[i].diameter / panel.diameter)) + (own ? 0.0 : 1e-6);
      if (distance < smallest) {
        smallest = distance;
        nearest = &panel;
      }
    }
    if (nearest != nullptr) nearest->points.push_back(i);
  }
}

}  // namespace

std::vector<Panel> panels_of(const Analysis& analysis) {
  std::vector<Panel> panels;
  for (const RestitutionCurve& curve : analysis.uncertainty.curves) {
    panels.push_back({curve.dataset, curve.diameter, curve.series, &curve, nullptr, {}});
  }
  if (panels.empty()) {
    for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
      for (const double diameter : distinct_diameters(analysis.datasets[k])) {
        panels.push_back({k, diameter, "", nullptr, nullptr, {}});
      }
    }
  }
  for (Panel& panel : panels) {
    for (const CaptureEstimate& capture : analysis.uncertainty.capture) {
      if (capture.dataset == panel.dataset && capture.found &&
          !without_adhesion(analysis, capture.dataset) &&
          std::abs(std::log(capture.diameter / panel.diameter)) < 1e-6) {
        panel.capture = &capture;
      }
    }
  }
  distribute_points(analysis, panels);
  if (panels.size() > most_panels) panels.resize(most_panels);
  return panels;
}

Axes axes_of(const Analysis& analysis, const std::vector<Panel>& panels, std::size_t dataset) {
  Axes axes;
  double lower = INFINITY, upper = 0.0;
  double least = INFINITY, most = 0.0;  // of e
  bool captured = false;
  for (const Observation& point : analysis.fitted.data.points) {
    if (point.dataset != dataset) continue;
    lower = std::min(lower, point.velocity);
    upper = std::max(upper, point.velocity);
    captured |= point.censored;
    if (point.censored || point.counts_only()) continue;
    const double sd = analysis.fitted.data.noise.sd_stated ? point.sd : 0.0;
    least = std::min(least, point.restitution - sd);
    most = std::max(most, point.restitution + sd);
  }
  const double slowest = lower;
  for (const Panel& panel : panels) {
    if (panel.dataset != dataset || panel.capture == nullptr) continue;
    if (panel.capture->value < slowest / farthest_capture) continue;
    const double edge = panel.capture->interval.lower.value_or(panel.capture->value);
    lower =
        std::min(lower, std::max(std::min(edge, panel.capture->value), slowest / farthest_capture));
  }
  axes.velocity = {lower / 1.15, upper * 1.25};
  for (const Panel& panel : panels) {
    if (panel.dataset != dataset || panel.curve == nullptr) continue;
    for (std::size_t k = 0; k < panel.curve->restitution.size(); ++k) {
      if (!axes.velocity.holds(panel.curve->velocity[k])) continue;
      least = std::min(least, panel.curve->restitution[k]);
      most = std::max(most, panel.curve->restitution[k]);
    }
  }
  constexpr double lowest_start = 0.35, least_span = 0.05;
  const double margin = 0.15 * std::max(most - least, least_span);
  const bool from_zero = captured || !(least > lowest_start) || !std::isfinite(margin);
  axes.restitution = {
      from_zero ? 0.0 : least - margin,
      most > 0.0 ? std::clamp(from_zero ? 1.06 * most : most + margin, 0.1, 1.5) : 1.05};
  return axes;
}

plot::Axis velocity_axis(plot::Range range) {
  plot::Axis axis{"incident velocity V", "m/s"};
  axis.logarithmic = true;
  axis.set_range(range);
  return axis;
}

plot::Axis restitution_axis(plot::Range range) {
  plot::Axis axis{"restitution e"};
  axis.set_range(range);
  return axis;
}

CurveColumns curve_columns(const RestitutionCurve& curve) {
  const std::size_t count = std::min(curve.velocity.size(), curve.restitution.size());
  const std::size_t stride =
      std::max<std::size_t>(1, (count + most_curve_points - 1) / most_curve_points);
  CurveColumns columns;
  const auto take = [](const std::vector<double>& values, std::size_t i, std::vector<double>& to) {
    if (!values.empty()) to.push_back(i < values.size() ? values[i] : NAN);
  };
  for (std::size_t i = 0; i < count; ++i) {
    // All values are kept where the curve rises steeply above capture.
    const bool steep =
        i + 1 < count &&
        std::abs(curve.restitution[i + 1] - curve.restitution[i]) +
                std::abs(i > 0 ? curve.restitution[i] - curve.restitution[i - 1] : 0.0) >
            0.02;
    if (i % stride != 0 && i + 1 != count && !steep) continue;
    columns.velocity.push_back(curve.velocity[i]);
    columns.restitution.push_back(curve.restitution[i]);
    take(curve.lower, i, columns.lower);
    take(curve.upper, i, columns.upper);
    take(curve.two_point, i, columns.two_point);
  }
  return columns;
}

PointColumns point_columns(const Analysis& analysis, const std::vector<std::size_t>& points) {
  PointColumns columns;
  const std::size_t stride = points.size() / most_panel_points + 1;
  for (std::size_t k = 0; k < points.size(); k += stride) {
    const Observation& point = analysis.fitted.data.points[points[k]];
    if (point.counts_only()) continue;  // there is no e to draw
    if (point.censored) {
      columns.captured.push_back(point.velocity);
    } else {
      columns.velocity.push_back(point.velocity);
      columns.restitution.push_back(point.restitution);
      columns.sd.push_back(point.sd);
    }
  }
  return columns;
}

std::optional<plot::Points> rebound_layer(const Analysis& analysis, const PointColumns& columns,
                                          const std::string& name) {
  if (columns.velocity.empty()) return std::nullopt;
  plot::Points points{columns.velocity, columns.restitution};
  if (analysis.fitted.data.noise.sd_stated) points.with_sd(columns.sd);
  points.name = name;
  return points;
}

}  // namespace recoil
