#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "plot/plot.hpp"

/// What the pictures of e(V) are made of.
namespace recoil {

constexpr std::size_t most_panel_points = 400;  ///< drawn in one panel

/// One diameter of one dataset.
struct Panel {
  std::size_t dataset = 0;
  double diameter = 0.0;
  std::string series;
  const RestitutionCurve* curve = nullptr;
  const CaptureEstimate* capture = nullptr;
  std::vector<std::size_t> points;
};

/// The panels of a fit: one for each curve, or for each diameter where no curves were made. Every
/// point goes to the panel of its dataset with the nearest diameter and, among equals, its own
/// series. `analysis` must outlive the panels.
std::vector<Panel> panels_of(const Analysis& analysis);

/// Common axes of the panels of one dataset, so that they can be compared.
struct Axes {
  plot::Range velocity;
  double top = 1.05;
};
Axes axes_of(const Analysis& analysis, const std::vector<Panel>& panels, std::size_t dataset);

/// The axis of incident velocities, logarithmic.
plot::Axis velocity_axis(plot::Range range);

/// The axis of e from 0.
plot::Axis restitution_axis(double top);

/// A curve in columns, thinned where it is flat.
struct CurveColumns {
  std::vector<double> velocity, restitution, lower, upper, two_point;
};
CurveColumns curve_columns(const RestitutionCurve& curve);

/// The points of a panel in columns, thinned to `most_panel_points`.
struct PointColumns {
  std::vector<double> velocity, restitution, sd;  ///< of rebounds
  std::vector<double> captured;                   ///< velocities
};
PointColumns point_columns(const Analysis& analysis, const std::vector<std::size_t>& points);

/// The rebounds as a layer, with error bars where standard deviations are stated; nothing to show:
/// no layer.
std::optional<plot::Points> rebound_layer(const Analysis& analysis, const PointColumns& columns,
                                          const std::string& name);

}  // namespace recoil
