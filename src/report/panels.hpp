#pragma once

#include <string>
#include <vector>

#include "report/figure_style.hpp"
#include "report/report.hpp"

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
  style::Range velocity;
  double top = 1.05;
};
Axes axes_of(const Analysis& analysis, const std::vector<Panel>& panels, std::size_t dataset);

/// Rows V, e, lower, upper, two-point e of a curve, thinned where it is flat.
std::vector<std::vector<double>> curve_rows(const RestitutionCurve& curve);

/// The points of a panel as rows, thinned to `most_panel_points`.
struct PointRows {
  std::vector<std::vector<double>> rebounds;  // V, e, sd
  std::vector<std::vector<double>> captures;  // V, 0
};
PointRows point_rows(const Analysis& analysis, const std::vector<std::size_t>& points);

}  // namespace recoil
