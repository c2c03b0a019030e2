#include "estimate/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/units.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/noise.hpp"
#include "estimate/noise_words.hpp"
#include "estimate/reweigh.hpp"

namespace recoil {
namespace {

// A chi-squared less likely than this under the stated noise widens every interval.
constexpr double misfit_level = 0.01;
// One less likely than this is worth a word, but may well be chance.
constexpr double doubtful_level = 0.05;
// Two minima within this relative difference of chi2 are a tie, if their parameters differ.
constexpr double tie_tolerance = 1e-6;

/// The stated start, and the damping factors ten times smaller and larger in all combinations:
/// capture and strong damping make flat and non-convex regions on either side. Then what the
/// catalogue of mechanisms advises, one parameter at a time.
std::vector<std::vector<double>> starting_points(const ImpactModel& model,
                                                 const std::vector<double>& first, bool several) {
  std::vector<std::vector<double>> starts = {first};
  if (!several) return starts;
  for (const double hertz : {0.1, 1.0, 10.0}) {
    for (const double adhesion : {0.1, 1.0, 10.0}) {
      if (hertz == 1.0 && adhesion == 1.0) continue;
      std::vector<double> start = first;
      bool moved = false;
      for (std::size_t j = 0; j < start.size(); ++j) {
        const ParameterSlot& slot = model.slots[j];
        if (!slot.free || slot.name == "f0" || !slot.mechanism.empty()) continue;
        const double factor = slot.name == "C_H" ? hertz : adhesion;
        start[j] = std::clamp(start[j] * factor, slot.lower, slot.upper);
        moved = moved || start[j] != first[j];
      }
      if (moved) starts.push_back(std::move(start));
    }
  }
  for (std::size_t j = 0; j < first.size(); ++j) {
    const ParameterSlot& slot = model.slots[j];
    if (!slot.free) continue;
    for (const double value : slot.starts) {
      if (value < slot.lower || value > slot.upper || value == first[j]) continue;
      starts.push_back(first);
      starts.back()[j] = value;
    }
  }
  return starts;
}

std::string describe_point(const Observation& point) {
  return fmt::format("the point at d = {:.4g} um, V = {:.4g} m/s", point.diameter / units::um,
                     point.velocity);
}

std::vector<Prediction> predict_observations(const ImpactModel& model,
                                             std::span<const double> theta,
                                             const Observations& data) {
  std::vector<PointConditions> points;
  for (const Observation& point : data.points) {
    points.push_back({point.dataset, point.diameter, point.velocity, point.series});
  }
  return predict(model, theta, std::move(points), false);
}

/// The first point that the model cannot answer at `theta`, in words.
std::string unanswered_point(const ImpactModel& model, const Observations& data,
                             std::span<const double> theta) {
  const std::vector<Prediction> predictions = predict_observations(model, theta, data);
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    if (!predictions[i].usable()) {
      return fmt::format("{}: {}", describe_point(data.points[i]),
                         to_string(predictions[i].outcome));
    }
  }
  return "";
}

void record_predictions(FitResult& result) {
  for (const Prediction& at : predict_observations(result.model, result.theta, result.data)) {
    result.prediction_squared.push_back(at.restitution_squared);
    result.prediction.push_back(at.restitution());
  }
}

void record_leverage(FitResult& result, const std::vector<double>& jacobian,
                     const std::vector<double>& unscaled_covariance) {
  const std::size_t n = result.residuals.size();
  const std::size_t p = result.theta.size();
  result.leverage.assign(n, 0.0);
  if (unscaled_covariance.empty()) return;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t a = 0; a < p; ++a) {
      for (std::size_t b = 0; b < p; ++b) {
        result.leverage[i] +=
            jacobian[i * p + a] * unscaled_covariance[a * p + b] * jacobian[i * p + b];
      }
    }
  }
}

std::string in_words(double p_value) {
  return p_value < 1e-6 ? "p < 1e-6" : fmt::format("p = {:.2g}", p_value);
}

/// Decides what the standard deviations are worth.
void judge_noise(FitResult& result, const Misfit& misfit) {
  result.dof = misfit.dof;
  result.p_value = misfit.p_value;
  if (misfit.dof <= 0) {
    result.noise_text = "as many parameters as points: the noise cannot be checked";
    return;
  }
  if (!result.data.sd_stated) {
    result.noise_scale = misfit.scale();
  } else if (result.p_value < misfit_level) {
    result.noise_scale = misfit.scale();
    result.noise_text = fmt::format(
        "the residuals are {:.3g} times larger than the stated noise explains ({}): every error "
        "and interval is widened by that factor, and still describes this model, not the truth",
        result.noise_scale, in_words(result.p_value));
    result.warnings.push_back(result.noise_text);
  } else if (result.p_value < doubtful_level) {
    result.noise_text = fmt::format(
        "the scatter is at the edge of what the stated standard deviations explain ({})",
        in_words(result.p_value));
  } else {
    result.noise_text = "the stated standard deviations explain the scatter";
  }
}

void report_starts(FitResult& result, const StartSummary& best) {
  int failed = 0;
  int elsewhere = 0;
  for (const StartSummary& start : result.starts) {
    if (!start.converged) {
      ++failed;
    } else if (start.chi2 > best.chi2 * (1.0 + 1e-3) + 1e-6) {
      ++elsewhere;
    } else if (start.chi2 <= best.chi2 * (1.0 + tie_tolerance)) {
      for (std::size_t j = 0; j < start.end.size(); ++j) {
        if (result.std_error[j] > 0.0 &&
            std::abs(start.end[j] - best.end[j]) > 0.1 * result.std_error[j]) {
          result.warnings.push_back(fmt::format(
              "tie: another start ends with the same chi2 at {} = {:.4g} instead of {:.4g}",
              result.model.slots[j].label(), start.end[j], best.end[j]));
        }
      }
    }
  }
  if (failed > 0) {
    result.warnings.push_back(
        fmt::format("{} of {} starts did not converge", failed, result.starts.size()));
  }
  if (elsewhere > 0) {
    result.warnings.push_back(fmt::format("{} of {} starts ended in a worse local minimum",
                                          elsewhere, result.starts.size()));
  }
}

void report_bounds(FitResult& result) {
  for (std::size_t j = 0; j < result.theta.size(); ++j) {
    if (!result.at_bound[j]) continue;
    const ParameterSlot& slot = result.model.slots[j];
    const bool low = result.theta[j] <= 0.5 * (slot.lower + slot.upper);
    result.warnings.push_back(fmt::format(
        "{} rests on its {} bound {:.4g} {}: it has no symmetric error, and the errors of the "
        "others are conditional on it",
        slot.label(), low ? "lower" : "upper", low ? slot.lower : slot.upper, slot.unit));
  }
}

/// The points for the search from several starts. A mean of survivors lies far above the curve
/// until the scatter of the impacts is known, so points with rebounds and captures wait for
/// `settle`, if the others suffice.
Observations without_mixed_points(const Observations& data, std::ptrdiff_t free_count) {
  Observations rest = data;
  std::erase_if(rest.points,
                [](const Observation& point) { return point.captured > 0 && !point.censored; });
  const auto rebounds = std::count_if(rest.points.begin(), rest.points.end(),
                                      [](const Observation& point) { return !point.censored; });
  return rebounds > free_count ? rest : data;
}

/// Where a mechanism of the model says how the impacts of a point differ, its survivors are what
/// the mean e is of: their spread must not be estimated a second time from the counts.
void leave_counts_to_mechanism(const ImpactModel& model, FitResult& result) {
  const auto spreads = [](const ParameterSlot& slot) {
    return !slot.mechanism.empty() && find_mechanism(slot.mechanism)->spreads();
  };
  const auto found = std::find_if(model.slots.begin(), model.slots.end(), spreads);
  if (found == model.slots.end()) return;
  int counts = 0;
  for (Observation& point : result.data.points) {
    if (point.censored || !point.counted) continue;
    point.events -= std::exchange(point.captured, 0);
    point.counted = false;
    ++counts;
  }
  if (counts == 0) return;
  result.warnings.push_back(fmt::format(
      "{} says how the impacts of a point differ: the counts of captured spheres at {} points "
      "with rebounds are not used beside it",
      found->mechanism, counts));
}

}  // namespace

FitResult fit(const ImpactModel& model, const Observations& observed, const FitOptions& options) {
  FitResult result;
  result.model = model;
  result.data = observed;
  result.warnings = observed.warnings;
  leave_counts_to_mechanism(model, result);
  const Observations& data = result.data;  // until `settle` has weighed them
  const std::vector<double> first = options.start.empty() ? model.initial() : options.start;
  const auto free_count = std::count_if(model.slots.begin(), model.slots.end(),
                                        [](const ParameterSlot& slot) { return slot.free; });
  result.dof = static_cast<int>(data.points.size()) - static_cast<int>(free_count);
  if (result.dof < 0) {
    result.failure = fmt::format("{} points cannot determine {} free parameters",
                                 data.points.size(), free_count);
    return result;
  }

  const Observations searched = without_mixed_points(data, free_count);
  const LeastSquaresProblem problem = impact_problem(model, searched, &result.handovers);
  LeastSquaresResult best;
  std::size_t best_start = 0;
  for (const std::vector<double>& start : starting_points(model, first, options.several_starts)) {
    LeastSquaresResult run = minimise(problem, start, options.minimiser);
    result.starts.push_back({start, run.theta, run.sum_of_squares, run.converged, run.message});
    const bool better =
        run.converged && (!best.converged || run.sum_of_squares < best.sum_of_squares);
    if (better) {
      best = std::move(run);
      best_start = result.starts.size() - 1;
    }
  }
  if (!best.converged) {
    const std::string where = unanswered_point(model, data, first);
    result.failure = where.empty() ? "no start converged: " + result.starts.front().message
                                   : "no start converged; " + where;
    return result;
  }

  if (data.weights_depend_on_fit()) {
    Settled settled = settle(model, data, best.theta, {.minimiser = options.minimiser});
    if (!settled.run.converged) {
      result.failure = "the weights do not settle: " + settled.run.message;
      return result;
    }
    if (!settled.at_rest) {
      result.warnings.emplace_back(
          "the weights of the points still moved when their rounds ran out: the estimate depends "
          "on "
          "where they stopped");
    }
    best = std::move(settled.run);
    result.data = std::move(settled.data);
  }
  result.usable = true;
  result.theta = best.theta;
  result.at_bound = best.at_bound;
  result.residuals = best.residuals;
  result.chi2 = best.sum_of_squares;
  record_predictions(result);
  record_leverage(result, best.jacobian, best.covariance);
  judge_noise(result, misfit(result.data, result.residuals, result.prediction_squared,
                             static_cast<int>(free_count)));
  describe_noise(result);
  result.covariance = scaled_covariance(result.data, best.covariance, result.noise_scale);
  result.spread_covariance =
      event_spread_covariance(model, result.theta, result.data, best.covariance);
  for (std::size_t k = 0; k < result.spread_covariance.size(); ++k) {
    result.covariance[k] += result.spread_covariance[k];
  }
  result.std_error.assign(result.theta.size(), 0.0);
  if (result.covariance.empty()) {
    result.warnings.push_back(
        "the points do not determine all free parameters (J'J is singular): no standard errors");
  } else {
    for (std::size_t j = 0; j < result.theta.size(); ++j) {
      result.std_error[j] = std::sqrt(result.covariance[j * result.theta.size() + j]);
    }
  }
  result.rmse = root_mean_square(model, result.theta, result.data);
  report_starts(result, result.starts[best_start]);
  report_bounds(result);
  return result;
}

double root_mean_square(const ImpactModel& model, std::span<const double> theta,
                        const Observations& data, const std::vector<std::size_t>& subset) {
  std::vector<std::size_t> points = subset;
  if (points.empty()) {
    points.resize(data.points.size());
    std::iota(points.begin(), points.end(), std::size_t{0});
  }
  if (points.empty()) return 0.0;
  std::vector<PointConditions> conditions;
  for (const std::size_t i : points) {
    const Observation& point = data.points[i];
    conditions.push_back({point.dataset, point.diameter, point.velocity, point.series});
  }
  const std::vector<Prediction> predictions = predict(model, theta, std::move(conditions), false);
  double sum = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Observation& point = data.points[points[k]];
    const double measured = point.censored ? 0.0 : point.restitution;
    sum += std::pow(measured - expected_restitution(point, predictions[k].restitution_squared), 2);
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace recoil
