#include "report/figures_overview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/format.hpp"
#include "report/panels.hpp"

namespace recoil {

plot::Picture restitution_overview(const Analysis& analysis, const std::string& id) {
  const std::vector<Panel> panels = panels_of(analysis);
  plot::Range velocity{INFINITY, 0.0};
  double top = 1.05;
  for (std::size_t k = 0; k < analysis.datasets.size(); ++k) {
    const Axes axes = axes_of(analysis, panels, k);
    if (!std::isfinite(axes.velocity.lower)) continue;
    velocity.lower = std::min(velocity.lower, axes.velocity.lower);
    velocity.upper = std::max(velocity.upper, axes.velocity.upper);
    top = std::max(top, axes.top);
  }
  plot::Plot shown;
  shown.x = velocity_axis(velocity);
  shown.x.label = "V";
  shown.y = restitution_axis(top);
  shown.y.label = "e";
  shown.key.place = plot::KeyPlace::above;
  const bool by_dataset = analysis.datasets.size() > 1;
  std::vector<bool> named(analysis.datasets.size(), false);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Panel& panel = panels[i];
    const plot::Marker& marker = plot::marker(by_dataset ? panel.dataset : i);
    const std::string name =
        by_dataset ? analysis.datasets[panel.dataset].id : diameter_label(panel.diameter);
    const bool show = by_dataset ? !named[panel.dataset] : panels.size() <= plot::markers.size();
    named[panel.dataset] = true;
    if (panel.curve != nullptr) {
      const CurveColumns curve = curve_columns(*panel.curve);
      if (!by_dataset && !curve.lower.empty()) {
        shown.layers.push_back(plot::Band{
            curve.velocity, curve.lower, curve.upper, {std::string(marker.colour), 0.3}});
      }
      shown.layers.push_back(plot::Line{curve.velocity, curve.restitution, {marker.colour, 1.6}});
    }
    const PointColumns columns = point_columns(analysis, panel.points);
    plot::Points points{columns.velocity, columns.restitution};
    points.marker = marker;
    if (show) points.name = name;
    shown.layers.push_back(std::move(points));
  }
  plot::Picture picture;
  picture.name = plot::plot_name("overview-" + id);
  picture.title = fmt::format("Restitution against incident velocity, {}", id);
  picture.width = 420;
  picture.height = 270;
  picture.plots = {std::move(shown)};
  return picture;
}

}  // namespace recoil
