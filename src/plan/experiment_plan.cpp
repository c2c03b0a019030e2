#include "plan/experiment_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
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
// With many diameters fewer draws are taken: draws times places.
constexpr std::size_t most_outlooks = 40000, fewest_draws = 25;
constexpr int fewest_points = 10;  // least number of points if the wanted error decides
// The default range of velocities, relative to the smallest and the largest capture velocity.
constexpr double below_capture = 0.8, above_capture = 30.0;
// A plan is refused if this number of points leaves an error of 100 %.
constexpr double hopeless_points = 1e6;
constexpr double least_share = 0.05;  // least share in LearntAt
constexpr double worst_share = 0.95;  // share of the draws in which an error is at most the worst
// The part of one evenly spaced point that is taken as known.
constexpr double share_of_everywhere = 1e-6;

/// The value that a share `p` of `values` does not exceed: one of them, as some may be infinite.
double quantile(std::vector<double> values, double p) {
  const auto place = static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }

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

/// `grid_velocities`, evenly spaced in ln V; fewer if some round to the same velocity.
std::vector<double> spaced(double from, double to) {
  std::vector<double> velocities;
  for (int k = 0; k < grid_velocities; ++k) {
    velocities.push_back(as_set(from * std::pow(to / from, k / (grid_velocities - 1.0))));
  }
  velocities.erase(std::unique(velocities.begin(), velocities.end()), velocities.end());
  return velocities;
}

/// Computes `settings`, `quantities` and the totals of a plan.
class Planner {
 public:
  /// @param draws values of theta, those of the plan first
  Planner(const FitSpec& spec, const std::vector<std::vector<double>>& draws, ExperimentPlan& plan)
      : plan_(plan) {
    std::size_t places = 0;
    for (const Dataset& dataset : plan.datasets) places += dataset.points.size() * grid_velocities;
    const std::size_t count = std::min(
        draws.size(), std::max(fewest_draws, most_outlooks / std::max<std::size_t>(1, places)));
    std::vector<std::vector<PlannedSize>> sizes;
    for (std::size_t k = 0; k < count; ++k) {
      sizes.push_back(planned_sizes(plan.model, draws[k], plan.datasets));
    }
    sizes_ = sizes.front();
    complete_range(spec, sizes_, plan.options);
    for (const Dataset& dataset : plan.datasets) {
      scatter_.push_back(planned_scatter(plan.options, spec.noise, dataset));
    }
    velocities_ = spaced(plan.options.slowest, plan.options.fastest);
    list_quantities(spec);
    for (std::size_t k = 0; k < count; ++k) add_draw(draws[k], sizes[k]);
    plan.draws = static_cast<int>(draws_.size());
  }

  /// Plans the requested number of points, or the fewest that give the wanted error.
  void choose_settings() {
    const int events = plan_.options.events;
    const int free = plan_.model.free_count();
    if (plan_.options.impacts > 0) {
      const int points = plan_.options.impacts / events;
      if (points < free) {
        throw InputError(
            {},
            fmt::format("{} impacts make {} points of {}", plan_.options.impacts, points, events),
            fmt::format("{} parameters are free", free),
            "plan more impacts, or fewer for one point (--events)");
      }
      take(points);
    } else {
      const int most = most_planned_impacts / events;
      find_fewest_points(std::min(most, std::max(fewest_points, 2 * free)), most);
    }
    plan_.impacts = plan_.points * events;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (counts_[i] == 0) continue;
      const PointConditions& at = grid_.at[i];
      const PointOutlook& outlook = grid_.outlook[i];
      plan_.settings.push_back({at.dataset, at.diameter, at.velocity, counts_[i],
                                outlook.restitution, outlook.sd / std::sqrt(counts_[i]),
                                outlook.captured});
    }
  }

  /// Computes the errors of all quantities under the chosen settings.
  void find_errors() {
    const std::vector<double> counts = numbers_of(counts_);
    const std::vector<double> even = numbers_of(evenly(plan_.points));
    const double points = plan_.points;
    const auto impacts = [&](const std::optional<double>& factor) {
      return factor ? std::optional(*factor * points * plan_.options.events) : std::nullopt;
    };
    std::vector<double> best = optimal_shares(draws_, points, shares_);
    for (double& count : best) count *= points;
    plan_.efficiency = least_possible_sum(draws_, best) / mean_sum_of(draws_, counts);
    plan_.reached = true;
    const Variances variances = variances_under(draws_, counts);
    const Variances even_variances = variances_under(draws_, even);
    for (std::size_t q = 0; q < plan_.quantities.size(); ++q) {
      PlannedQuantity& quantity = plan_.quantities[q];
      quantity.error = std::sqrt(median(variances[q]));
      quantity.worst_error = std::sqrt(quantile(variances[q], worst_share));
      quantity.plain_error = std::sqrt(median(even_variances[q]));
      plan_.reached = plan_.reached && quantity.error <= plan_.options.error;
      quantity.impacts = impacts(factor_for(draws_, counts, q));
      quantity.plain_impacts = impacts(factor_for(draws_, even, q));
      DesignProblems alone = {draws_.front()};
      alone.front().asked = draws_.front().asked.col(static_cast<Eigen::Index>(q));
      std::vector<double> shares = optimal_shares(alone, points);
      quantity.learnt_at = places_of(shares);
      for (double& share : shares) share *= points;
      quantity.alone_impacts = impacts(factor_for(alone, shares, 0));
    }
  }

 private:
  double wanted_variance() const { return plan_.options.error * plan_.options.error; }

  void take(int points) {
    plan_.points = points;
    counts_ = counts_for(points);
  }

  /// Takes more points, from `few` on, until all quantities that `most` points determine have the
  /// wanted error.
  void find_fewest_points(int few, int most) {
    take(most);
    leave_out_hopeless();
    if (excess() > 1.0) return;
    int low = few - 1;
    take(few);
    for (double over = excess(); over > 1.0; over = excess()) {
      low = plan_.points;
      take(static_cast<int>(std::clamp(std::ceil(low * over), low + 1.0, most * 1.0)));
    }
    while (plan_.points - low > std::max(1, low / 50)) {
      const int high = plan_.points;
      std::vector<int> counts = counts_;
      take((low + high) / 2);
      if (excess() <= 1.0) continue;
      low = plan_.points;
      plan_.points = high;
      counts_ = std::move(counts);
    }
  }

  /// The counts of points evenly spaced in ln V above the capture velocity, with equal numbers for
  /// each diameter. Diameters that are captured at every velocity are omitted.
  std::vector<int> evenly(int points) const {
    std::vector<std::vector<std::size_t>> returning;  // the places of each size
    for (std::size_t s = 0; s < sizes_.size(); ++s) {
      const CaptureVelocity& capture = sizes_[s].capture;
      std::vector<std::size_t> places;
      for (std::size_t v = 0; v < velocities_.size(); ++v) {
        if (capture.found && velocities_[v] < capture.value) continue;
        places.push_back(s * velocities_.size() + v);
      }
      if (!places.empty()) returning.push_back(std::move(places));
    }
    std::vector<int> counts(sizes_.size() * velocities_.size(), 0);
    const auto sizes = static_cast<int>(returning.size());
    for (int s = 0; s < sizes; ++s) {
      const std::vector<std::size_t>& places = returning[static_cast<std::size_t>(s)];
      const int count = points / sizes + (s < points % sizes ? 1 : 0);
      for (int i = 0; i < count; ++i) {
        const double share = count > 1 ? i / (count - 1.0) : 0.5;
        ++counts[places[static_cast<std::size_t>(
            std::round(share * static_cast<double>(places.size() - 1)))]];
      }
    }
    return counts;
  }

  void list_quantities(const FitSpec& spec) {
    for (std::size_t j = 0; j < plan_.theta.size(); ++j) {
      const ParameterSlot& slot = plan_.model.slots[j];
      if (!slot.free || plan_.theta[j] == 0.0) continue;
      PlannedQuantity& quantity = plan_.quantities.emplace_back();
      quantity.label = slot.label();
      quantity.unit = slot.parameter->unit;
      quantity.value = plan_.theta[j];
      place_.push_back(j);
    }
    if (plan_.quantities.empty()) {
      throw InputError({spec.file.string()}, "no parameter is free and other than 0",
                       "then there is nothing to determine",
                       "free one under [parameters], or assume another value");
    }
    for (std::size_t s = 0; s < sizes_.size(); ++s) {
      if (!sizes_[s].capture.found) continue;
      PlannedQuantity& quantity = plan_.quantities.emplace_back();
      quantity.unit = "m/s";
      quantity.dataset = sizes_[s].dataset;
      quantity.diameter = sizes_[s].diameter;
      quantity.value = sizes_[s].capture.value;
      place_.push_back(s);
    }
  }

  /// The quantities as functions of the parameters, one column each; empty if one is not known.
  Eigen::MatrixXd asked_under(const PlannedParameters& parameters,
                              const std::vector<PlannedSize>& sizes) const {
    const std::size_t count = parameters.slots.size();
    Eigen::MatrixXd asked = Eigen::MatrixXd::Zero(
        static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(plan_.quantities.size()));
    for (std::size_t q = 0; q < plan_.quantities.size(); ++q) {
      const bool is_parameter = plan_.quantities[q].is_parameter();
      if (!is_parameter && !sizes[place_[q]].capture.found) return {};
      for (std::size_t k = 0; k < count; ++k) {
        double& slope = asked(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(q));
        if (is_parameter) {
          slope = parameters.slots[k] == place_[q] ? 1.0 : 0.0;
        } else {
          const CaptureVelocity& capture = sizes[place_[q]].capture;
          slope = capture.gradient[parameters.slots[k]] * parameters.unit[k] / capture.value;
        }
      }
    }
    return asked;
  }

  /// Adds the design problem of one draw of theta. A draw under which no experiment determines the
  /// parameters cannot tell experiments apart: the first throws, the others are left out.
  void add_draw(const std::vector<double>& theta, const std::vector<PlannedSize>& sizes) {
    const PlannedParameters parameters = planned_parameters(plan_.model, theta);
    const Eigen::MatrixXd asked = asked_under(parameters, sizes);
    if (asked.size() == 0) return;
    std::vector<PointConditions> at;
    for (const PlannedSize& size : sizes_) {
      for (const double v : velocities_)
        at.push_back({size.dataset, size.diameter, v, size.series});
    }
    const bool first = draws_.empty();
    try {
      PossiblePoints grid =
          possible_points(plan_.model, theta, parameters, std::move(at), scatter_);
      DesignProblem problem = {grid.rows(), parameters.known, asked};
      require_determined(problem);
      // The best experiment for a single quantity can leave other parameters undetermined.
      const auto places = static_cast<std::size_t>(problem.rows.rows());
      problem.known = information_of(
          problem, std::vector<double>(places, share_of_everywhere / static_cast<double>(places)));
      if (first) grid_ = std::move(grid);
      draws_.push_back(std::move(problem));
    } catch (const ComputationError&) {
      if (first) throw;
    }
  }

  void require_determined(const DesignProblem& problem) const {
    const auto count = static_cast<std::size_t>(problem.rows.rows());
    const Eigen::VectorXd variances = variances_of(
        problem, std::vector<double>(count, hopeless_points / static_cast<double>(count)));
    std::vector<std::string> lost;
    for (Eigen::Index q = 0; q < variances.size(); ++q) {
      const PlannedQuantity& quantity = plan_.quantities[static_cast<std::size_t>(q)];
      if (!(variances(q) < 1.0) && quantity.is_parameter()) lost.push_back(quantity.label);
    }
    if (!lost.empty()) {
      throw ComputationError(fmt::format(
          "a million points between {:g} and {:g} m/s would not determine {}; widen --velocity, "
          "add a --diameter, or fix a parameter in the fit file",
          plan_.options.slowest, plan_.options.fastest, fmt::join(lost, " and ")));
    }
  }

  /// The counts of `points` points: an evenly spaced share, and the best choice for the others.
  std::vector<int> counts_for(int points) {
    const int checks = static_cast<int>(std::round(plan_.options.checks * points));
    const std::vector<int> checking = evenly(checks);
    DesignProblems rest = draws_;
    for (DesignProblem& draw : rest) draw.known = information_of(draw, numbers_of(checking));
    shares_ = optimal_shares(rest, points - checks, shares_);
    std::vector<int> counts = after_exchanges(rest, whole_points(shares_, points - checks));
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += checking[i];
    return counts;
  }

  using Variances = std::vector<std::vector<double>>;  // [quantities][draws]

  static Variances variances_under(const DesignProblems& draws, const std::vector<double>& counts) {
    Variances all(static_cast<std::size_t>(draws.front().asked.cols()));
    for (const DesignProblem& draw : draws) {
      const Eigen::VectorXd found = variances_of(draw, counts);
      for (std::size_t q = 0; q < all.size(); ++q) {
        all[q].push_back(found(static_cast<Eigen::Index>(q)));
      }
    }
    return all;
  }

  /// The largest median variance of a quantity that the number of points decides about, over the
  /// wanted one.
  double excess() const {
    double most = 0.0;
    const Variances variances = variances_under(draws_, numbers_of(counts_));
    for (std::size_t q = 0; q < variances.size(); ++q) {
      if (!hopeless_.contains(q)) most = std::max(most, median(variances[q]));
    }
    return most / wanted_variance();
  }

  /// Leaves out the quantities that the settings of the plan, the most that there can be, do not
  /// determine, unless these are all.
  void leave_out_hopeless() {
    const Variances variances = variances_under(draws_, numbers_of(counts_));
    for (std::size_t q = 0; q < variances.size(); ++q) {
      if (!(median(variances[q]) <= wanted_variance())) hopeless_.insert(q);
    }
    if (hopeless_.size() == variances.size()) hopeless_.clear();
  }

  /// The factor on `counts` that gives a quantity the wanted error; nullopt if there is none.
  std::optional<double> factor_for(const DesignProblems& draws, const std::vector<double>& counts,
                                   std::size_t q) const {
    const auto enough = [&](double factor) {
      std::vector<double> scaled = counts;
      for (double& count : scaled) count *= factor;
      return median(variances_under(draws, scaled)[q]) <= wanted_variance();
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
      const bool new_size = i % velocities_.size() == 0;
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
  std::vector<PlannedScatter> scatter_;  // per dataset
  std::vector<double> velocities_;       // of every size
  std::vector<std::size_t> place_;       // of each quantity: its slot or its size
  std::set<std::size_t> hopeless_;       // quantities that do not decide the number of points
  PossiblePoints grid_;                  // every velocity of every size
  DesignProblems draws_;                 // for the grid
  std::vector<double> shares_;           // of the grid, the last optimal ones
  std::vector<int> counts_;              // of the grid
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
                               const std::vector<std::vector<double>>& draws, PlanOptions options) {
  ExperimentPlan plan;
  plan.fit = spec.id;
  plan.options = std::move(options);
  plan.model = make_model(spec, datasets);
  plan.theta = draws.front();
  plan.datasets = std::move(datasets);
  Planner planner(spec, draws, plan);
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
