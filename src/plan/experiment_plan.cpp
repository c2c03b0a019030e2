#include "plan/experiment_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "data/text.hpp"
#include "estimate/capture_velocity.hpp"
#include "plan/design.hpp"
#include "plan/possible_points.hpp"

namespace recoil {
namespace {

constexpr int grid_velocities = 48;  // velocities of each diameter
constexpr int fewest_points = 10;    // least number of points if the wanted error decides
// The default range of velocities, relative to the smallest and the largest capture velocity.
constexpr double below_capture = 0.8, above_capture = 30.0;
// A plan is refused if this number of points leaves an error of 100 %.
constexpr double hopeless_points = 1e6;
constexpr double least_share = 0.05;  // least share in LearntAt
// Fraction of the information of evenly spaced points that is added in the plan for a single
// quantity, because its best experiment can leave other parameters undetermined.
constexpr double share_of_everywhere = 1e-9;

/// The velocity rounded to three digits.
double as_set(double velocity) {
  const double unit = std::pow(10.0, std::floor(std::log10(velocity)) - 2.0);
  return *parse_number(fmt::format("{:.3g}", std::round(velocity / unit) * unit));
}

/// Spheres of one diameter in one dataset.
struct PlannedSize {
  std::size_t dataset = 0;
  std::size_t series = 0;
  double diameter = 0.0;
  CaptureVelocity capture;
};

std::vector<PlannedSize> planned_sizes(const ImpactModel& model, const std::vector<double>& theta,
                                       const std::vector<Dataset>& datasets) {
  std::vector<PlannedSize> sizes;
  std::vector<CaptureQuery> queries;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const ImpactPoint& point : datasets[d].points) {
      sizes.push_back({d, point.series, point.diameter, {}});
      queries.push_back({d, point.diameter});
    }
  }
  const std::vector<CaptureVelocity> found = capture_velocities(model, theta, queries);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    sizes[k].capture = found[k];
    if (!(found[k].value > 0.0)) sizes[k].capture.found = false;
  }
  return sizes;
}

/// Sets the range of velocities from the capture velocities if none is stated.
void complete_range(const FitSpec& spec, const std::vector<PlannedSize>& sizes,
                    PlanOptions& options) {
  if (options.slowest > 0.0) return;
  double least = INFINITY;
  double most = 0.0;
  for (const PlannedSize& size : sizes) {
    if (!size.capture.found) continue;
    least = std::min(least, size.capture.value);
    most = std::max(most, size.capture.value);
  }
  if (!(most > 0.0)) {
    throw InputError({spec.file.string()}, "the range of velocities is not known",
                     "no capture velocity could be derived from the model",
                     "state it: --velocity MIN,MAX");
  }
  options.slowest = as_set(below_capture * least);
  options.fastest = as_set(above_capture * most);
}

/// The scatter of the planned points of `dataset`, from the options and the errors in the fit file.
PlannedScatter planned_scatter(const PlanOptions& options, const NoiseSpec& noise,
                               const Dataset& dataset) {
  PlannedScatter scatter;
  scatter.scatter = options.scatter;
  scatter.floor = options.floor;
  scatter.spread = options.spread;
  scatter.events = options.events;
  scatter.velocity_error = noise.velocity_relative_sd;
  scatter.diameter_error = noise.diameter_relative_sd;
  scatter.rebound_measured = std::ranges::any_of(
      dataset.columns, [](const DataColumn& column) { return column.name == "rebound_velocity"; });
  return scatter;
}

/// `count` velocities, evenly spaced in ln V.
std::vector<double> spaced(double from, double to, int count) {
  std::vector<double> velocities;
  for (int k = 0; k < count; ++k) {
    const double share = count > 1 ? static_cast<double>(k) / (count - 1) : 0.5;
    velocities.push_back(as_set(from * std::pow(to / from, share)));
  }
  return velocities;
}

/// Possible points, and the number of points to measure at each.
struct PlacedPoints {
  PossiblePoints points;
  std::vector<int> counts;
};

void add_settings(const PlacedPoints& placed, std::vector<PlannedSetting>& settings) {
  for (std::size_t i = 0; i < placed.counts.size(); ++i) {
    if (placed.counts[i] == 0) continue;
    const PointConditions& at = placed.points.at[i];
    const PointOutlook& outlook = placed.points.outlook[i];
    const auto same = std::ranges::find_if(settings, [&](const PlannedSetting& other) {
      return other.dataset == at.dataset && other.diameter == at.diameter &&
             other.velocity == at.velocity;
    });
    if (same != settings.end()) {
      same->points += placed.counts[i];
      continue;
    }
    settings.push_back({at.dataset, at.diameter, at.velocity, placed.counts[i], outlook.restitution,
                        outlook.sd, outlook.captured});
  }
}

/// All planned points as settings, sorted by dataset, diameter and velocity.
std::vector<PlannedSetting> settings_of(const std::vector<PlacedPoints>& all) {
  std::vector<PlannedSetting> settings;
  for (const PlacedPoints& placed : all) add_settings(placed, settings);
  std::ranges::sort(settings, [](const PlannedSetting& one, const PlannedSetting& other) {
    return std::tie(one.dataset, one.diameter, one.velocity) <
           std::tie(other.dataset, other.diameter, other.velocity);
  });
  for (PlannedSetting& setting : settings) setting.sd /= std::sqrt(setting.points);
  return settings;
}

std::vector<double> counts_of(const std::vector<PlannedSetting>& settings) {
  std::vector<double> counts;
  for (const PlannedSetting& setting : settings) counts.push_back(setting.points);
  return counts;
}

/// Computes `settings`, `quantities` and the totals of a plan.
class Planner {
 public:
  Planner(const FitSpec& spec, ExperimentPlan& plan)
      : plan_(plan), sizes_(planned_sizes(plan.model, plan.theta, plan.datasets)) {
    complete_range(spec, sizes_, plan.options);
    parameters_ = planned_parameters(plan.model, plan.theta);
    for (const Dataset& dataset : plan.datasets) {
      scatter_.push_back(planned_scatter(plan.options, spec.noise, dataset));
    }
    list_quantities(spec);
    std::vector<PointConditions> at;
    for (const PlannedSize& size : sizes_) {
      for (const double v : spaced(plan.options.slowest, plan.options.fastest, grid_velocities)) {
        at.push_back({size.dataset, size.diameter, v, size.series});
      }
    }
    grid_ = possible(std::move(at));
    problem_ = {grid_.rows(), parameters_.known, asked_};
    require_determined();
  }

  /// Plans the requested number of points, or the fewest that give the wanted error.
  void choose_settings() {
    const int events = plan_.options.events;
    const int free = plan_.model.free_count();
    if (plan_.options.impacts > 0) {
      plan_.points = plan_.options.impacts / events;
      if (plan_.points < free) {
        throw InputError({},
                         fmt::format("{} impacts make {} points of {}", plan_.options.impacts,
                                     plan_.points, events),
                         fmt::format("{} parameters are free", free),
                         "plan more impacts, or fewer for one point (--events)");
      }
      plan_.settings = settings_for(plan_.points);
    } else {
      const int most = most_planned_impacts / events;
      find_fewest_points(std::min(most, std::max(fewest_points, 2 * free)), most);
    }
    plan_.impacts = plan_.points * events;
  }

  /// Computes the errors of all quantities under the chosen settings.
  void find_errors() {
    const DesignProblem made = problem_of(plan_.settings);
    const std::vector<double> counts = counts_of(plan_.settings);
    const PlacedPoints even = evenly(plan_.points);
    const DesignProblem plain = {even.points.rows(), parameters_.known, asked_};
    const std::vector<double> even_counts = numbers_of(even.counts);
    const Eigen::VectorXd variances = variances_of(made, counts);
    const Eigen::VectorXd plain_variances = variances_of(plain, even_counts);
    const double points = plan_.points;
    const auto impacts = [&](const std::optional<double>& factor) {
      return factor ? std::optional(*factor * points * plan_.options.events) : std::nullopt;
    };
    plan_.reached = variances.maxCoeff() <= wanted_variance();
    std::vector<double> best = optimal_shares(problem_, points);
    for (double& count : best) count *= points;
    plan_.efficiency = least_possible_sum(problem_, best) / variances.sum();
    const std::size_t places = grid_.at.size();
    const Eigen::MatrixXd everywhere = information_of(
        problem_,
        std::vector<double>(places, share_of_everywhere * points / static_cast<double>(places)));
    for (std::size_t k = 0; k < plan_.quantities.size(); ++k) {
      const auto q = static_cast<Eigen::Index>(k);
      PlannedQuantity& quantity = plan_.quantities[k];
      quantity.error = std::sqrt(variances(q));
      quantity.plain_error = std::sqrt(plain_variances(q));
      quantity.impacts = impacts(factor_for(made, counts, q));
      quantity.plain_impacts = impacts(factor_for(plain, even_counts, q));
      const DesignProblem alone = {problem_.rows, everywhere, asked_.col(q)};
      std::vector<double> shares = optimal_shares(alone, points);
      quantity.learnt_at = places_of(shares);
      for (double& share : shares) share *= points;
      quantity.alone_impacts = impacts(factor_for(alone, shares, 0));
    }
  }

 private:
  double wanted_variance() const { return plan_.options.error * plan_.options.error; }

  PossiblePoints possible(std::vector<PointConditions> at) const {
    return possible_points(plan_.model, plan_.theta, parameters_, std::move(at), scatter_);
  }

  /// Bisects between `low` and `most` points, to 2 %.
  void find_fewest_points(int low, int most) {
    const auto take = [&](int points) {
      plan_.points = points;
      plan_.settings = settings_for(points);
    };
    take(low);
    if (good(plan_.settings)) return;
    take(most);
    leave_out_hopeless();
    if (std::vector<PlannedSetting> few = settings_for(low); good(few)) {
      take(low);
      return;
    }
    while (good(plan_.settings) && plan_.points - low > std::max(1, low / 50)) {
      const int middle = static_cast<int>(std::sqrt(static_cast<double>(low) * plan_.points));
      const int next = std::clamp(middle, low + 1, plan_.points - 1);
      std::vector<PlannedSetting> fewer = settings_for(next);
      if (good(fewer)) {
        plan_.points = next;
        plan_.settings = std::move(fewer);
      } else {
        low = next;
      }
    }
  }

  /// Points evenly spaced in ln V above the capture velocity, with equal numbers for each diameter.
  /// Diameters that are captured at every velocity are omitted.
  PlacedPoints evenly(int points) const {
    std::vector<const PlannedSize*> returning;
    const double fastest = plan_.options.fastest;
    for (const PlannedSize& size : sizes_) {
      if (!size.capture.found || size.capture.value < fastest) returning.push_back(&size);
    }
    std::vector<PointConditions> at;
    std::vector<int> counts;
    const auto sizes = static_cast<int>(returning.size());
    for (int k = 0; k < sizes; ++k) {
      const PlannedSize& size = *returning[static_cast<std::size_t>(k)];
      const double from =
          std::max(plan_.options.slowest, size.capture.found ? size.capture.value : 0.0);
      const int count = points / sizes + (k < points % sizes ? 1 : 0);
      const std::vector<double> velocities =
          spaced(from, fastest, std::min(count, grid_velocities));
      const auto places = static_cast<int>(velocities.size());
      for (int i = 0; i < places; ++i) {
        at.push_back(
            {size.dataset, size.diameter, velocities[static_cast<std::size_t>(i)], size.series});
        counts.push_back(count / places + (i < count % places ? 1 : 0));
      }
    }
    return {possible(std::move(at)), std::move(counts)};
  }

  void ask(PlannedQuantity quantity, const Eigen::VectorXd& column) {
    plan_.quantities.push_back(std::move(quantity));
    asked_.conservativeResize(column.size(), asked_.cols() + 1);
    asked_.col(asked_.cols() - 1) = column;
  }

  void list_quantities(const FitSpec& spec) {
    const std::size_t count = parameters_.slots.size();
    const auto p = static_cast<Eigen::Index>(count);
    asked_.resize(p, 0);
    for (std::size_t k = 0; k < count; ++k) {
      const ParameterSlot& slot = plan_.model.slots[parameters_.slots[k]];
      const double value = plan_.theta[parameters_.slots[k]];
      if (!slot.free || value == 0.0) continue;
      PlannedQuantity quantity;
      quantity.label = slot.label();
      quantity.unit = slot.parameter->unit;
      quantity.value = value;
      ask(std::move(quantity), Eigen::VectorXd::Unit(p, static_cast<Eigen::Index>(k)));
    }
    if (plan_.quantities.empty()) {
      throw InputError({spec.file.string()}, "no parameter is free and other than 0",
                       "then there is nothing to determine",
                       "free one under [parameters], or assume another value");
    }
    for (const PlannedSize& size : sizes_) {
      if (!size.capture.found) continue;
      PlannedQuantity quantity;
      quantity.unit = "m/s";
      quantity.dataset = size.dataset;
      quantity.diameter = size.diameter;
      quantity.value = size.capture.value;
      Eigen::VectorXd column(p);
      for (std::size_t k = 0; k < count; ++k) {
        column(static_cast<Eigen::Index>(k)) =
            size.capture.gradient[parameters_.slots[k]] * parameters_.unit[k] / size.capture.value;
      }
      ask(std::move(quantity), column);
    }
  }

  void require_determined() const {
    const auto count = static_cast<std::size_t>(problem_.rows.rows());
    const Eigen::VectorXd variances = variances_of(
        problem_, std::vector<double>(count, hopeless_points / static_cast<double>(count)));
    std::vector<std::string> lost;
    for (Eigen::Index q = 0; q < variances.size(); ++q) {
      const PlannedQuantity& quantity = plan_.quantities[static_cast<std::size_t>(q)];
      if (!(variances(q) < 1.0) && quantity.is_parameter()) lost.push_back(quantity.label);
    }
    if (lost.empty()) return;
    throw ComputationError(fmt::format(
        "a million points between {:g} and {:g} m/s would not determine {}; widen --velocity, "
        "add a --diameter, or fix a parameter in the fit file",
        plan_.options.slowest, plan_.options.fastest, fmt::join(lost, " and ")));
  }

  /// The settings of `points` points: an evenly spaced share, and the best choice for the others.
  std::vector<PlannedSetting> settings_for(int points) const {
    const int checks = static_cast<int>(std::round(plan_.options.checks * points));
    const PlacedPoints checking = evenly(checks);
    DesignProblem rest = problem_;
    rest.known += information_of(
        {checking.points.rows(),
         Eigen::MatrixXd::Zero(checking.points.slopes.cols(), checking.points.slopes.cols()),
         {}},
        numbers_of(checking.counts));
    const std::vector<int> counts =
        after_exchanges(rest, whole_points(optimal_shares(rest, points - checks), points - checks));
    const PlacedPoints plain = evenly(points);
    const double sum = variances_of(rest, numbers_of(counts)).sum();
    const double sum_of_plain =
        variances_of({plain.points.rows(), parameters_.known, asked_}, numbers_of(plain.counts))
            .sum();
    if (!(sum <= sum_of_plain)) return settings_of({plain});
    return settings_of({{grid_, counts}, checking});
  }

  DesignProblem problem_of(const std::vector<PlannedSetting>& settings) const {
    std::vector<PointConditions> at;
    for (const PlannedSetting& setting : settings) {
      at.push_back({setting.dataset, setting.diameter, setting.velocity, series_of(setting)});
    }
    return {possible(std::move(at)).rows(), parameters_.known, asked_};
  }

  std::size_t series_of(const PlannedSetting& setting) const {
    for (const PlannedSize& size : sizes_) {
      if (size.dataset == setting.dataset && size.diameter == setting.diameter) return size.series;
    }
    return PointConditions::no_series;
  }

  /// Do all quantities that the number of points decides about have the wanted error?
  bool good(const std::vector<PlannedSetting>& settings) const {
    const Eigen::VectorXd variances = variances_of(problem_of(settings), counts_of(settings));
    return (sought_.size() == 0 ? variances : variances.cwiseProduct(sought_)).maxCoeff() <=
           wanted_variance();
  }

  /// Leaves out the quantities that the settings of the plan, the most that there can be, do not
  /// determine, unless these are all.
  void leave_out_hopeless() {
    const Eigen::VectorXd variances =
        variances_of(problem_of(plan_.settings), counts_of(plan_.settings));
    const Eigen::VectorXd kept = (variances.array() <= wanted_variance()).cast<double>();
    if (kept.sum() > 0.0) sought_ = kept;
  }

  /// The factor on `counts` that gives quantity `q` the wanted error; nullopt if there is none.
  std::optional<double> factor_for(const DesignProblem& problem, const std::vector<double>& counts,
                                   Eigen::Index q) const {
    const auto enough = [&](double factor) {
      std::vector<double> scaled = counts;
      for (double& count : scaled) count *= factor;
      return variances_of(problem, scaled)(q) <= wanted_variance();
    };
    double few = 1e-6;
    double many = 1e6;
    if (!enough(many)) return std::nullopt;
    while (many > 1.0005 * few) {
      const double middle = std::sqrt(few * many);
      (enough(middle) ? many : few) = middle;
    }
    return many;
  }

  /// The velocities and diameters with the largest shares; neighbours on the grid are merged.
  std::vector<LearntAt> places_of(const std::vector<double>& shares) const {
    std::vector<LearntAt> places;
    bool open = false;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const bool new_size = i % grid_velocities == 0;
      if (new_size || !(shares[i] > 0.1 * least_share)) open = false;
      if (!(shares[i] > 0.1 * least_share)) continue;
      if (!open) places.push_back({grid_.at[i].dataset, grid_.at[i].diameter, 0.0, 0.0});
      open = true;
      LearntAt& place = places.back();
      place.velocity += shares[i] * grid_.at[i].velocity;
      place.share += shares[i];
    }
    std::erase_if(places, [](const LearntAt& place) { return place.share < least_share; });
    for (LearntAt& place : places) place.velocity /= place.share;
    std::ranges::sort(places,
                      [](const LearntAt& a, const LearntAt& b) { return a.share > b.share; });
    return places;
  }

  ExperimentPlan& plan_;
  std::vector<PlannedSize> sizes_;
  PlannedParameters parameters_;
  std::vector<PlannedScatter> scatter_;  // per dataset
  Eigen::MatrixXd asked_;                // one column for each quantity
  Eigen::VectorXd sought_;  ///< 1: the quantity decides about the number of points; empty: all do
  PossiblePoints grid_;
  DesignProblem problem_;  // design problem of the grid
};

/// Puts one point for each setting into the datasets of the plan, with the expected results.
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

std::vector<double> sorted_unique(std::vector<double> values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

std::vector<Dataset> datasets_to_plan(std::vector<Dataset> datasets,
                                      const std::vector<double>& diameters) {
  for (Dataset& dataset : datasets) {
    const std::vector<double> own = distinct_diameters(dataset);
    const std::vector<double> sizes = sorted_unique(diameters.empty() ? own : diameters);
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

ExperimentPlan plan_experiment(const FitSpec& spec, std::vector<Dataset> datasets,
                               const std::vector<double>& theta, PlanOptions options) {
  ExperimentPlan plan;
  plan.fit = spec.id;
  plan.options = std::move(options);
  plan.model = make_model(spec, datasets);
  plan.theta = theta;
  plan.datasets = std::move(datasets);
  Planner planner(spec, plan);
  planner.choose_settings();
  planner.find_errors();
  std::vector<double> diameters;
  for (const Dataset& dataset : plan.datasets) {
    for (const double diameter : distinct_diameters(dataset)) diameters.push_back(diameter);
  }
  plan.options.diameters = sorted_unique(std::move(diameters));
  take_points(plan);
  return plan;
}

}  // namespace recoil
