#include "report/figures_plan.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"
#include "estimate/predictor.hpp"
#include "report/format.hpp"
#include "report/panels.hpp"

namespace recoil {
namespace {

constexpr int expected_points = 160;
constexpr double beyond_points = 1.12;  // of the axis of velocities beyond the points

plot::Line expected_curve(const ExperimentPlan& plan, std::size_t dataset, double diameter,
                          const plot::Marker& marker) {
  std::vector<PointConditions> at;
  const double from = plan.options.slowest / beyond_points;
  const double to = plan.options.fastest * beyond_points;
  for (int k = 0; k < expected_points; ++k) {
    at.push_back({dataset, diameter, from * std::pow(to / from, k / (expected_points - 1.0))});
  }
  plot::Line line;
  line.stroke = {marker.colour, 1.6};
  for (const Prediction& prediction : predict(plan.model, plan.theta, at, false)) {
    line.x.push_back(at[line.x.size()].velocity);
    line.y.push_back(prediction.usable() ? prediction.restitution() : NAN);
  }
  return line;
}

plot::Points planned_points(const ExperimentPlan& plan, std::size_t dataset, double diameter,
                            const plot::Marker& marker) {
  plot::Points points;
  points.marker = marker;
  points.size = 0.7;
  points.name = diameter_label(diameter);
  std::vector<double> sd;
  for (const PlannedSetting& setting : plan.settings) {
    if (setting.dataset != dataset || setting.diameter != diameter) continue;
    points.x.push_back(setting.velocity);
    points.y.push_back(setting.captured > 0.5 ? 0.0 : setting.restitution);
    sd.push_back(setting.captured > 0.5 ? 0.0 : setting.sd);
  }
  return points.with_sd(sd);
}

/// How many points a mark stands for, where it is several.
void add_numbers(const ExperimentPlan& plan, std::size_t dataset, double diameter,
                 const plot::Marker& marker, plot::Plot& shown) {
  for (const PlannedSetting& setting : plan.settings) {
    if (setting.dataset != dataset || setting.diameter != diameter || setting.points < 2) continue;
    plot::Words words;
    words.text = fmt::format("{} ×", setting.points);
    words.x = plot::on_axis(setting.velocity);
    words.y = plot::on_axis(setting.captured > 0.5 ? 0.0 : setting.restitution);
    words.align = plot::Align::right;
    words.shift_x = -0.8;
    words.shift_y = 0.8;
    words.colour = std::string(marker.colour);
    shown.layers.push_back(std::move(words));
  }
}

}  // namespace

std::vector<Figure> plan_figures(const ExperimentPlan& plan) {
  std::vector<Figure> figures;
  for (std::size_t d = 0; d < plan.datasets.size(); ++d) {
    plot::Plot shown;
    shown.x =
        velocity_axis({plan.options.slowest / beyond_points, plan.options.fastest * beyond_points});
    shown.y = restitution_axis(1.05);
    shown.key.place = plot::KeyPlace::above;
    std::size_t size = 0;
    for (const double diameter : plan.options.diameters) {
      const plot::Marker& marker = plot::marker(size++);
      shown.layers.push_back(expected_curve(plan, d, diameter, marker));
      plot::Points points = planned_points(plan, d, diameter, marker);
      if (!points.x.empty()) shown.layers.push_back(std::move(points));
      add_numbers(plan, d, diameter, marker, shown);
    }
    plot::Picture picture;
    picture.name = fmt::format("plan-{}", d + 1);
    picture.title = fmt::format("Planned points, {}", plan.datasets[d].id);
    picture.plots = {std::move(shown)};
    figures.push_back(figure_of(
        std::move(picture),
        say("{}: what {e} is expected to be, and where to measure it. A mark is one setting, with "
            "the number of its points where it is several; its error is that of the mean of all "
            "impacts there. At the foot: settings at which most spheres stay and are counted.",
            plan.datasets[d].id)));
  }
  return figures;
}

}  // namespace recoil
