#include "plan/datasets_to_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"

namespace recoil {

std::vector<Dataset> datasets_to_plan(std::vector<Dataset> datasets,
                                      const std::vector<double>& diameters) {
  for (Dataset& dataset : datasets) {
    const std::vector<double> own = distinct_diameters(dataset);
    std::vector<double> sizes = diameters.empty() ? own : diameters;
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    if (sizes.empty()) {
      throw InputError({dataset.folder.string()}, "the diameters of the spheres are not known",
                       "there are no points that state them", "state them: --diameter 2,5,10");
    }
    if (!dataset.system.reference_diameter) {
      const std::vector<double>& from = own.empty() ? sizes : own;
      dataset.system.reference_diameter = from[from.size() / 2];
    }
    dataset.points.clear();
    dataset.series.clear();
    dataset.series_conditions.clear();
    dataset.warnings.clear();
    for (const double diameter : sizes) {
      ImpactPoint point;
      point.series = dataset.series.size();
      point.diameter = diameter;
      point.incident_velocity = 1.0;
      dataset.points.push_back(point);
      dataset.series.push_back(fmt::format("{:.4g} um", diameter / units::um));
      dataset.series_conditions.emplace_back();
    }
  }
  return datasets;
}

void take_points(ExperimentPlan& plan) {
  for (std::size_t d = 0; d < plan.datasets.size(); ++d) {
    Dataset& dataset = plan.datasets[d];
    const std::vector<ImpactPoint> sizes = std::move(dataset.points);
    dataset.points.clear();
    for (const PlannedSetting& setting : plan.settings) {
      if (setting.dataset != d) continue;
      ImpactPoint point;
      for (const ImpactPoint& size : sizes) {
        if (size.diameter == setting.diameter) point.series = size.series;
      }
      point.diameter = setting.diameter;
      point.incident_velocity = setting.velocity;
      point.events = setting.points * plan.options.events;
      point.captured = static_cast<int>(std::round(setting.captured * point.events));
      point.counted = true;
      if (!point.all_captured()) point.restitution = setting.restitution;
      if (setting.sd > 0.0) point.restitution_sd = setting.sd;
      dataset.points.push_back(point);
    }
  }
}

}  // namespace recoil
