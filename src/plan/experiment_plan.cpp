#include "plan/experiment_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/error.hpp"
#include "core/units.hpp"
#include "estimate/capture_velocity.hpp"
#include "plan/datasets_to_plan.hpp"
#include "plan/design.hpp"
#include "plan/planned_causes.hpp"
#include "plan/possible_points.hpp"

namespace recoil {
namespace {

constexpr int grid_velocities = 48;    // of one size
constexpr int fewest_points = 10;      // where the wanted error decides
constexpr double below_capture = 0.8;  // of the smallest capture velocity, where nothing is stated
constexpr double above_capture = 30.0;
constexpr double hopeless_points = 1e6;  // that leave an error of 100 %
constexpr double least_share = 0.05;     // of LearntAt
constexpr double trace_of_all = 1e-9;    // of the information of points everywhere, added where
                                         // the best experiment for one quantity asks no more

/// Three digits, as a velocity is set.
double as_set(double velocity) {
  const double unit = std::pow(10.0, std::floor(std::log10(velocity)) - 2.0);
  return std::stod(fmt::format("{:.3g}", std::round(velocity / unit) * unit));
}

/// One size of spheres in one dataset.
struct Kind {
  std::size_t dataset = 0;
  std::size_t series = 0;
  double diameter = 0.0;
  CaptureVelocity capture;
};

std::vector<Kind> kinds_of(const ImpactModel& model, const std::vector<double>& theta,
                           const std::vector<Dataset>& datasets) {
  std::vector<Kind> kinds;
  std::vector<CaptureQuery> queries;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const ImpactPoint& point : datasets[d].points) {
      kinds.push_back({d, point.series, point.diameter, {}});
      queries.push_back({d, point.diameter});
    }
  }
  const std::vector<CaptureVelocity> found = capture_velocities(model, theta, queries);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    kinds[k].capture = found[k];
    if (!(found[k].value > 0.0)) kinds[k].capture.found = false;
  }
  return kinds;
}

/// Velocities from the smallest to the largest capture velocity, with room, where none are stated.
void complete_range(const FitSpec& spec, const std::vector<Kind>& kinds, PlanOptions& options) {
  if (options.slowest > 0.0) return;
  double least = INFINITY;
  double most = 0.0;
  for (const Kind& kind : kinds) {
    if (!kind.capture.found) continue;
    least = std::min(least, kind.capture.value);
    most = std::max(most, kind.capture.value);
  }
  if (!(most > 0.0)) {
    throw InputError({spec.file.string()}, "the range of velocities is not known",
                     "nothing is captured that could say what is slow",
                     "state it: --velocity MIN,MAX");
  }
  options.slowest = as_set(below_capture * least);
  options.fastest = as_set(above_capture * most);
}

class Planner {
 public:
  Planner(const FitSpec& spec, ExperimentPlan& plan)
      : plan_(plan), kinds_(kinds_of(plan.model, plan.theta, plan.datasets)) {
    complete_range(spec, kinds_, plan.options);
    parameters_ = planned_parameters(plan.model, plan.theta);
    for (const Dataset& dataset : plan.datasets) {
      scatter_.push_back(planned_scatter(plan.options, spec.noise, dataset));
    }
    list_quantities(spec);
    for (const Kind& kind : kinds_) {
      for (const double v : spaced(plan.options.slowest, plan.options.fastest, grid_velocities)) {
        grid_at_.push_back({kind.dataset, kind.diameter, v, kind.series});
      }
    }
    grid_ = possible(grid_at_);
    problem_ = {grid_.rows(), parameters_.known, asked_};
    require_determined();
  }

  void run() {
    const int most = most_planned_impacts / plan_.options.events;
    const int free = plan_.model.free_count();
    int points = plan_.options.impacts / plan_.options.events;
    std::vector<PlannedSetting> settings;
    if (plan_.options.impacts > 0) {
      if (points < free) {
        throw InputError({},
                         fmt::format("{} impacts make {} points of {}", plan_.options.impacts,
                                     points, plan_.options.events),
                         fmt::format("{} parameters are free", free),
                         "plan more impacts, or fewer for one point (--events)");
      }
      settings = settings_for(points);
    } else {
      int low = std::min(most, std::max(fewest_points, 2 * free));
      points = low;
      settings = settings_for(points);
      if (!good(settings)) {
        points = most;
        settings = settings_for(points);
        while (good(settings) && points - low > std::max(1, low / 50)) {
          const int middle = static_cast<int>(std::sqrt(static_cast<double>(low) * points));
          const int next = std::clamp(middle, low + 1, points - 1);
          std::vector<PlannedSetting> fewer = settings_for(next);
          if (good(fewer)) {
            points = next;
            settings = std::move(fewer);
          } else {
            low = next;
          }
        }
      }
    }
    plan_.settings = std::move(settings);
    plan_.points = points;
    plan_.impacts = points * plan_.options.events;
    judge();
  }

 private:
  PossiblePoints possible(std::vector<PointConditions> at) const {
    return possible_points(plan_.model, plan_.theta, parameters_, std::move(at), scatter_);
  }

  static std::vector<double> spaced(double from, double to, int count) {
    std::vector<double> velocities;
    for (int k = 0; k < count; ++k) {
      const double share = count > 1 ? static_cast<double>(k) / (count - 1) : 0.5;
      velocities.push_back(as_set(from * std::pow(to / from, share)));
    }
    return velocities;
  }

  /// Evenly in ln V, over all sizes alike, from where they come back; those that nowhere do are
  /// left out.
  struct Even {
    std::vector<PointConditions> at;
    std::vector<int> counts;
  };
  Even evenly(int points) const {
    std::vector<const Kind*> returning;
    const double fastest = plan_.options.fastest;
    for (const Kind& kind : kinds_) {
      if (!kind.capture.found || kind.capture.value < fastest) returning.push_back(&kind);
    }
    Even even;
    const auto sizes = static_cast<int>(returning.size());
    for (int k = 0; k < sizes; ++k) {
      const Kind& kind = *returning[static_cast<std::size_t>(k)];
      const int first = static_cast<int>(even.counts.size());
      const double from =
          std::max(plan_.options.slowest, kind.capture.found ? kind.capture.value : 0.0);
      const int count = points / sizes + (k < points % sizes ? 1 : 0);
      const int places = std::min(count, grid_velocities);
      for (const double v : spaced(from, fastest, places)) {
        const int place = static_cast<int>(even.counts.size()) - first;
        even.at.push_back({kind.dataset, kind.diameter, v, kind.series});
        even.counts.push_back(count / places + (place < count % places ? 1 : 0));
      }
    }
    return even;
  }

  /// The information of `counts` of these points.
  static Eigen::MatrixXd information_in(const PossiblePoints& points,
                                        const std::vector<int>& counts) {
    const DesignProblem problem = {
        points.rows(), Eigen::MatrixXd::Zero(points.slopes.cols(), points.slopes.cols()), {}};
    return information_of(problem, {counts.begin(), counts.end()});
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
    for (const Kind& kind : kinds_) {
      if (!kind.capture.found) continue;
      PlannedQuantity quantity;
      quantity.kind = PlannedKind::capture_velocity;
      quantity.unit = "m/s";
      quantity.dataset = kind.dataset;
      quantity.diameter = kind.diameter;
      quantity.value = kind.capture.value;
      Eigen::VectorXd column(p);
      for (std::size_t k = 0; k < count; ++k) {
        column(static_cast<Eigen::Index>(k)) =
            kind.capture.gradient[parameters_.slots[k]] * parameters_.unit[k] / kind.capture.value;
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
      if (!(variances(q) < 1.0) && quantity.kind == PlannedKind::parameter) {
        lost.push_back(quantity.label);
      }
    }
    if (lost.empty()) return;
    throw ComputationError(fmt::format(
        "a million points between {:g} and {:g} m/s would not determine {}; widen --velocity, "
        "add a --diameter, or fix a parameter in the fit file",
        plan_.options.slowest, plan_.options.fastest, fmt::join(lost, " and ")));
  }

  /// So many points: the best where they may lie anywhere, but for those that check the model.
  std::vector<PlannedSetting> settings_for(int points) const {
    const int checks = static_cast<int>(std::round(plan_.options.checks * points));
    const Even even = evenly(checks);
    const PossiblePoints checking = possible(even.at);
    DesignProblem rest = problem_;
    rest.known += information_in(checking, even.counts);
    const std::vector<int> counts =
        after_exchanges(rest, whole_points(optimal_shares(rest, points - checks), points - checks));
    const Even all_even = evenly(points);
    const PossiblePoints plain = possible(all_even.at);
    const double sum = variances_of(rest, {counts.begin(), counts.end()}).sum();
    const double sum_of_plain = variances_of({plain.rows(), parameters_.known, asked_},
                                             {all_even.counts.begin(), all_even.counts.end()})
                                    .sum();
    if (!(sum <= sum_of_plain)) return merged(plain, all_even.counts, {}, {});
    return merged(grid_, counts, checking, even.counts);
  }

  static void add_settings(const PossiblePoints& points, const std::vector<int>& counts,
                           std::vector<PlannedSetting>& settings) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == 0) continue;
      const PointConditions& at = points.at[i];
      const PointOutlook& outlook = points.outlook[i];
      const auto same =
          std::find_if(settings.begin(), settings.end(), [&](const PlannedSetting& other) {
            return other.dataset == at.dataset && other.diameter == at.diameter &&
                   other.velocity == at.velocity;
          });
      if (same != settings.end()) {
        same->points += counts[i];
        continue;
      }
      settings.push_back({at.dataset, at.diameter, at.velocity, counts[i], outlook.restitution,
                          outlook.sd, outlook.captured});
    }
  }

  static std::vector<PlannedSetting> merged(const PossiblePoints& a, const std::vector<int>& of_a,
                                            const PossiblePoints& b, const std::vector<int>& of_b) {
    std::vector<PlannedSetting> settings;
    add_settings(a, of_a, settings);
    add_settings(b, of_b, settings);
    std::sort(settings.begin(), settings.end(),
              [](const PlannedSetting& one, const PlannedSetting& other) {
                return std::tie(one.dataset, one.diameter, one.velocity) <
                       std::tie(other.dataset, other.diameter, other.velocity);
              });
    for (PlannedSetting& setting : settings) setting.sd /= std::sqrt(setting.points);
    return settings;
  }

  /// The information of settings, for its variances.
  DesignProblem problem_of(const std::vector<PlannedSetting>& settings) const {
    std::vector<PointConditions> at;
    for (const PlannedSetting& setting : settings) {
      at.push_back({setting.dataset, setting.diameter, setting.velocity, series_of(setting)});
    }
    return {possible(std::move(at)).rows(), parameters_.known, asked_};
  }

  std::size_t series_of(const PlannedSetting& setting) const {
    for (const Kind& kind : kinds_) {
      if (kind.dataset == setting.dataset && kind.diameter == setting.diameter) return kind.series;
    }
    return PointConditions::no_series;
  }

  static std::vector<double> counts_of(const std::vector<PlannedSetting>& settings) {
    std::vector<double> counts;
    for (const PlannedSetting& setting : settings) counts.push_back(setting.points);
    return counts;
  }

  bool good(const std::vector<PlannedSetting>& settings) const {
    const Eigen::VectorXd variances = variances_of(problem_of(settings), counts_of(settings));
    return variances.maxCoeff() <= plan_.options.error * plan_.options.error;
  }

  /// By which factor `counts` have to grow or may shrink for the wanted error of quantity `q`.
  std::optional<double> factor_for(const DesignProblem& problem, const std::vector<double>& counts,
                                   Eigen::Index q) const {
    const double wanted = plan_.options.error * plan_.options.error;
    const auto enough = [&](double factor) {
      std::vector<double> scaled = counts;
      for (double& count : scaled) count *= factor;
      return variances_of(problem, scaled)(q) <= wanted;
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

  /// The places of the largest shares, neighbours on the grid together.
  std::vector<LearntAt> places_of(const std::vector<double>& shares) const {
    std::vector<LearntAt> places;
    bool open = false;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const bool new_size = i % grid_velocities == 0;
      if (new_size || !(shares[i] > 0.1 * least_share)) open = false;
      if (!(shares[i] > 0.1 * least_share)) continue;
      if (!open) places.push_back({grid_at_[i].dataset, grid_at_[i].diameter, 0.0, 0.0});
      open = true;
      LearntAt& place = places.back();
      place.velocity += shares[i] * grid_at_[i].velocity;
      place.share += shares[i];
    }
    std::erase_if(places, [](const LearntAt& place) { return place.share < least_share; });
    for (LearntAt& place : places) place.velocity /= place.share;
    std::sort(places.begin(), places.end(),
              [](const LearntAt& a, const LearntAt& b) { return a.share > b.share; });
    return places;
  }

  void judge() {
    const DesignProblem made = problem_of(plan_.settings);
    const std::vector<double> counts = counts_of(plan_.settings);
    const Even even = evenly(plan_.points);
    const DesignProblem plain = {possible(even.at).rows(), parameters_.known, asked_};
    const std::vector<double> even_counts(even.counts.begin(), even.counts.end());
    const Eigen::VectorXd variances = variances_of(made, counts);
    const Eigen::VectorXd plain_variances = variances_of(plain, even_counts);
    const double points = plan_.points;
    const auto events = static_cast<double>(plan_.options.events);
    const auto impacts = [&](const std::optional<double>& factor) {
      return factor ? std::optional(*factor * points * events) : std::nullopt;
    };
    plan_.reached = variances.maxCoeff() <= plan_.options.error * plan_.options.error;
    std::vector<double> best = optimal_shares(problem_, points);
    for (double& count : best) count *= points;
    plan_.efficiency = least_possible_sum(problem_, best) / variances.sum();
    const auto count = static_cast<double>(grid_at_.size());
    const Eigen::MatrixXd everywhere = information_of(
        problem_, std::vector<double>(grid_at_.size(), trace_of_all * points / count));
    for (std::size_t k = 0; k < plan_.quantities.size(); ++k) {
      const auto q = static_cast<Eigen::Index>(k);
      PlannedQuantity& quantity = plan_.quantities[k];
      quantity.error = std::sqrt(variances(q));
      quantity.plain_error = std::sqrt(plain_variances(q));
      quantity.impacts = impacts(factor_for(made, counts, q));
      quantity.plain_impacts = impacts(factor_for(plain, even_counts, q));
      const DesignProblem alone = {problem_.rows, everywhere, asked_.col(q)};
      const std::vector<double> shares = optimal_shares(alone, points);
      quantity.learnt_at = places_of(shares);
      std::vector<double> of_alone = shares;
      for (double& share : of_alone) share *= points;
      quantity.alone_impacts = impacts(factor_for(alone, of_alone, 0));
    }
  }

  ExperimentPlan& plan_;
  std::vector<Kind> kinds_;
  PlannedParameters parameters_;
  std::vector<PlannedScatter> scatter_;
  Eigen::MatrixXd asked_;
  std::vector<PointConditions> grid_at_;
  PossiblePoints grid_;
  DesignProblem problem_;
};

}  // namespace

ExperimentPlan plan_experiment(const FitSpec& spec, std::vector<Dataset> datasets,
                               const std::vector<double>& theta, PlanOptions options) {
  ExperimentPlan plan;
  plan.fit = spec.id;
  plan.options = std::move(options);
  plan.model = make_model(spec, datasets);
  plan.theta = theta;
  plan.datasets = std::move(datasets);
  plan.law_error = spec.law_error;
  Planner(spec, plan).run();
  plan.options.diameters.clear();
  for (const Dataset& dataset : plan.datasets) {
    for (const double diameter : distinct_diameters(dataset)) {
      plan.options.diameters.push_back(diameter);
    }
  }
  std::sort(plan.options.diameters.begin(), plan.options.diameters.end());
  plan.options.diameters.erase(
      std::unique(plan.options.diameters.begin(), plan.options.diameters.end()),
      plan.options.diameters.end());
  take_points(plan);
  plan.expected = planned_causes(spec, plan);
  return plan;
}

}  // namespace recoil
