#include "estimate/observations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "estimate/input_errors.hpp"
#include "estimate/instant_errors.hpp"

namespace recoil {
namespace {

bool has_column(const Dataset& dataset, const std::string& name) {
  return std::any_of(dataset.columns.begin(), dataset.columns.end(),
                     [&](const DataColumn& column) { return column.name == name; });
}

Observation observe(const Dataset& dataset, std::size_t index, const ImpactPoint& p,
                    const NoiseSpec& spec) {
  Observation point;
  point.dataset = index;
  point.series = p.series;
  point.diameter = p.diameter;
  point.velocity = p.incident_velocity;
  point.restitution = p.restitution;
  point.sd = p.restitution_sd.value_or(0.0);
  point.censored = p.all_captured() || p.counts_only;
  point.events = p.events;
  point.captured = p.captured;
  point.counted = p.counted || p.captured > 0;
  point.rebound_measured = has_column(dataset, "rebound_velocity");
  if (spec.velocity_errors) {
    point.velocity_sd = p.velocity_sd.value_or(spec.velocity_relative_sd * p.incident_velocity);
  }
  point.setting_velocity_sd = p.setting_velocity_sd.value_or(0.0);
  if (spec.diameter_errors) {
    point.diameter_sd = p.diameter_sd.value_or(spec.diameter_relative_sd * p.diameter);
    point.series_diameter_sd = p.series_diameter_sd.value_or(0.0);
  }
  point.line = p.line;
  return point;
}

/// Numbers the settings of all datasets in the order in which they appear. A point without a stated
/// setting shares one with the points of its series, diameter and velocity.
/// @return whether some setting to which `spec` assigns a shared error has several points
bool number_settings(const std::vector<Dataset>& datasets, Observations& data) {
  std::vector<const ImpactPoint*> stated;
  for (const Dataset& dataset : datasets) {
    for (const ImpactPoint& p : dataset.points) stated.push_back(&p);
  }
  const auto key = [&](std::size_t i) {
    const ImpactPoint& p = *stated[i];
    const bool named = !p.setting.empty();
    return std::tuple(data.points[i].dataset, std::string_view(p.setting),
                      named ? std::size_t{0} : p.series, named ? 0.0 : p.diameter,
                      named ? 0.0 : p.incident_velocity);
  };
  std::vector<std::size_t> order(stated.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(key(a), a) < std::pair(key(b), b);
  });
  bool several = false;
  for (std::size_t k = 0; k < order.size();
       ++k) {  // first by the index of the setting's first point
    const bool is_new = k == 0 || key(order[k]) != key(order[k - 1]);
    data.points[order[k]].setting = is_new ? order[k] : data.points[order[k - 1]].setting;
    several = several ||
              (!is_new && (data.noise.spec.every_setting || !stated[order[k]]->setting.empty()));
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const std::size_t first = data.points[i].setting;
    data.points[i].setting = first == i ? count++ : data.points[first].setting;
  }
  return several;
}

/// Numbers the successive bounces of launches, which share instants.
void number_bounces(const std::vector<Dataset>& datasets, Observations& data) {
  std::size_t launches = 0;
  std::size_t first = 0;
  for (const Dataset& dataset : datasets) {
    std::size_t own = 0;
    for (const LinkedBounce& linked : linked_bounces(dataset)) {
      Observation& point = data.points[first++];
      if (linked.launch == Observation::no_launch) continue;
      point.launch = launches + linked.launch;
      point.bounce = linked.bounce;
      own = std::max(own, linked.launch + 1);
    }
    launches += own;
  }
}

/// Completes missing standard deviations: the impacts of such a point are assumed to scatter like
/// the median of the others. (A captured point gives no information about the scatter of e.)
void complete_sd(std::vector<Observation>& points) {
  std::vector<double> known;
  for (const Observation& point : points) {
    if (point.sd > 0.0) known.push_back(point.event_sd(point.sd));
  }
  std::sort(known.begin(), known.end());
  const double middle = known.empty() ? nominal_sd : known[known.size() / 2];
  for (Observation& point : points) {
    if (!(point.sd > 0.0)) point.sd = middle / std::sqrt(static_cast<double>(point.averaged()));
  }
}

/// The number of points whose stated sd may have been computed from few impacts: not if all points
/// state the same number, for their mean or for an impact, as no samples do.
int count_sd_of_few(const std::vector<Observation>& points) {
  int few = 0;
  std::set<double> of_means, of_impacts;
  for (const Observation& point : points) {
    if (point.censored || !(point.sd > 0.0)) continue;
    of_means.insert(point.sd);
    of_impacts.insert(static_cast<float>(point.event_sd(point.sd)));
    if (point.rebounds() > 1 && point.rebounds() < few_impacts) ++few;
  }
  const bool alike = points.size() > 1 && (of_means.size() == 1 || of_impacts.size() == 1);
  return alike ? 0 : few;
}

/// Numbers the series of all datasets: the spheres of one may share an error of their size.
void number_batches(std::vector<Observation>& points) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> numbers;
  for (Observation& point : points) {
    point.batch = numbers.try_emplace({point.dataset, point.series}, numbers.size()).first->second;
  }
}

}  // namespace

std::vector<bool> among_captures(const std::vector<Observation>& points) {
  struct Overlap {
    double slowest_rebound = INFINITY;
    double fastest_capture = 0.0;
    bool single = true;  // every row is a single impact
  };
  std::map<std::pair<std::size_t, double>, Overlap> ranges;
  for (const Observation& point : points) {
    if (point.captured > 0) ranges[{point.dataset, point.diameter}];
  }
  std::vector<bool> among(points.size(), false);
  if (ranges.empty()) return among;
  for (const Observation& point : points) {
    const auto range = ranges.find({point.dataset, point.diameter});
    if (range == ranges.end()) continue;
    auto& [slowest_rebound, fastest_capture, single] = range->second;
    single = single && point.events == 1;
    if (point.captured < point.events) slowest_rebound = std::min(slowest_rebound, point.velocity);
    if (point.captured > 0) fastest_capture = std::max(fastest_capture, point.velocity);
  }
  for (auto& [size, range] : ranges) {
    if (range.single && std::isfinite(range.slowest_rebound) &&
        range.slowest_rebound > range.fastest_capture) {
      std::swap(range.slowest_rebound, range.fastest_capture);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto range = ranges.find({points[i].dataset, points[i].diameter});
    among[i] = range != ranges.end() && points[i].velocity >= range->second.slowest_rebound &&
               points[i].velocity <= range->second.fastest_capture;
  }
  return among;
}

Observations Observations::subset(std::span<const std::size_t> indices) const {
  Observations part = *this;
  part.points.clear();
  for (const std::size_t i : indices) part.points.push_back(points[i]);
  return part;
}

std::vector<PointConditions> Observations::conditions() const {
  std::vector<PointConditions> all;
  all.reserve(points.size());
  for (const Observation& point : points) all.push_back(point.conditions());
  return all;
}

bool Observations::share(SharedBy by) const {
  return std::any_of(sources.begin(), sources.end(),
                     [by](const ErrorSource* source) { return source->shared == by; });
}

bool Observations::share_errors() const {
  return std::any_of(sources.begin(), sources.end(),
                     [](const ErrorSource* source) { return source->shared != SharedBy::none; });
}

bool Observations::weights_depend_on_fit() const {
  return !noise.sd_stated || noise.pools_sd || !sources.empty() ||
         std::any_of(points.begin(), points.end(), [](const Observation& point) {
           return point.captured > 0 || point.counts_only();
         });
}

namespace {

/// `StatedNoise::rounding_sd` of the dataset with the coarsest rounding. Quotients of rounded
/// velocities have no common step.
double rounding_sd_of(const std::vector<Dataset>& datasets) {
  double coarsest = 0.0;
  for (const Dataset& dataset : datasets) {
    for (double step = 0.1; step > 0.5e-6; step /= 10.0) {
      const auto off = [step](const ImpactPoint& p) {
        const double steps = p.restitution / step;
        return std::abs(steps - std::round(steps)) > 1e-6;
      };
      if (std::any_of(dataset.points.begin(), dataset.points.end(), off)) continue;
      coarsest = std::max(coarsest, step);
      break;
    }
  }
  return coarsest / std::sqrt(12.0);
}

/// Adds the error of rounding to standard deviations that are smaller, as the digits of e show it.
/// @return the number of these points
int add_rounding(double rounding_sd, std::vector<Observation>& points) {
  int changed = 0;
  for (Observation& point : points) {
    if (point.censored || !(point.sd < rounding_sd)) continue;
    point.sd = std::hypot(point.sd, rounding_sd);
    ++changed;
  }
  return changed;
}

}  // namespace

Observations gather(const std::vector<Dataset>& datasets, const NoiseSpec& spec,
                    const Location& variance_place) {
  Observations data;
  data.noise.spec = spec;
  int missing = 0;
  int stated = 0;
  data.noise.rounding_sd = rounding_sd_of(datasets);
  if (spec.student) data.noise.student = student_noise(spec.student_dof);
  std::size_t count = 0;
  for (const Dataset& dataset : datasets) count += dataset.points.size();
  data.points.reserve(count);
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const ImpactPoint& p : datasets[d].points) {
      data.points.push_back(observe(datasets[d], d, p, spec));
      if (p.restitution_sd) {
        ++stated;
      } else if (!p.all_captured() && !p.counts_only) {
        ++missing;
      }
    }
  }
  const bool several = number_settings(datasets, data);
  number_batches(data.points);
  find_batches(data.points);
  const bool velocity_shared = setting_velocity_error().acts(data);
  data.noise.setting_sd_estimated =
      several && !spec.setting_sd && !spec.student && (spec.every_setting || !velocity_shared);
  if (spec.variance == VarianceFunction::stated && missing > 0) {
    throw InputError(
        variance_place,
        fmt::format("variance = \"stated\", but {} of {} points state no restitution_sd", missing,
                    data.points.size()),
        "", "write \"auto\", or state them all");
  }
  // Points without a stated sd are completed, also if all points are captured and none states one.
  data.noise.sd_stated =
      spec.variance ? spec.variance == VarianceFunction::stated : stated > 0 || missing == 0;
  if (data.noise.sd_stated) {
    data.noise.sd_missing = stated > 0 ? missing : 0;
    data.noise.sd_of_few = count_sd_of_few(data.points);
    data.noise.pools_sd = data.noise.sd_of_few > 0 && missing == 0 && !spec.variance;
    if (!spec.student) number_bounces(datasets, data);
    complete_sd(data.points);
    data.noise.sd_rounded = add_rounding(data.noise.rounding_sd, data.points);
  } else {
    data.noise.sd_set_aside = stated;
  }
  for (const ErrorSource* source : error_sources()) {
    if (source->acts(data)) data.sources.push_back(source);
  }
  for (const ErrorSource* source : data.sources) {
    if (spec.student && source->shared != SharedBy::none) {
      throw InputError({},
                       fmt::format("residuals = \"student\" beside {}", source->names.stated_by),
                       "errors that points share are normal", "leave out one of them");
    }
  }
  return data;
}

Observations gather(const std::vector<Dataset>& datasets, const FitSpec& spec) {
  return gather(datasets, spec.noise, spec.variance_place);
}

}  // namespace recoil
