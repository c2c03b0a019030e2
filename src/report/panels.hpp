#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "plot/plot.hpp"

/// Parts of the pictures of e(V).
namespace recoil {

constexpr std::size_t most_panel_points = 400;  ///< points drawn in one panel

/// The content of one picture: one diameter of one dataset.
struct Panel {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  std::string series;
  const RestitutionCurve* curve = nullptr;
  const CaptureEstimate* capture = nullptr;
  std::vector<std::size_t> points;  ///< indices
};

/// The first 24 panels of a fit: one for each curve, or for each diameter without curves. A point
/// belongs to the panel of its dataset with the nearest diameter and, if several are equally near,
/// with its own series. `analysis` must outlive the panels.
std::vector<Panel> panels_of(const Analysis& analysis);

/// The common axes of all panels of a dataset. That of e begins at 0 if captures or the fall
/// towards a capture velocity are shown, and otherwise fits the points.
struct Axes {
  plot::Range velocity;     ///< [m/s]
  plot::Range restitution;  ///< [1]
};
Axes axes_of(const Analysis& analysis, const std::vector<Panel>& panels, std::size_t dataset);

/// A logarithmic axis of incident velocities.
plot::Axis velocity_axis(plot::Range range);

plot::Axis restitution_axis(plot::Range range);

/// The values of a curve. Flat parts are thinned.
struct CurveColumns {
  std::vector<double> velocity, restitution, lower, upper, two_point;
};
CurveColumns curve_columns(const RestitutionCurve& curve);

/// The values of the points of a panel, thinned to `most_panel_points`.
struct PointColumns {
  std::vector<double> velocity, restitution, sd;  ///< points with rebounds
  std::vector<double> captured;                   ///< velocities of captured points [m/s]
};
PointColumns point_columns(const Analysis& analysis, const std::vector<std::size_t>& points);

/// The points with rebounds as a layer, with error bars if standard deviations are stated; nullopt
/// if there are none.
std::optional<plot::Points> rebound_layer(const Analysis& analysis, const PointColumns& columns,
                                          const std::string& name);

}  // namespace recoil
