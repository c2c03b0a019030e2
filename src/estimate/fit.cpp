#include "estimate/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "data/text.hpp"
#include "estimate/estimated_parts.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/judge_noise.hpp"
#include "estimate/misfit.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "estimate/reweighting.hpp"

namespace recoil {

namespace {

std::string describe_point(const Observation& point) {
  return fmt::format("the point at d = {:.4g} um, V = {:.4g} m/s", point.diameter / units::um,
                     point.velocity);
}

/// Names the first point whose impact cannot be solved at `theta`, and the reason; "" without one.
std::string unanswered_point(const ImpactModel& model, const Observations& data,
                             std::span<const double> theta) {
  const std::vector<Prediction> predictions = predict(model, theta, data.conditions(), false);
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    if (!predictions[i].usable()) {
      return fmt::format("{}: {}", describe_point(data.points[i]),
                         to_string(predictions[i].outcome));
    }
  }
  return "";
}

void record_predictions(FitResult& result) {
  result.prediction.resize(result.data.points.size());
  result.prediction_squared.resize(result.data.points.size());
  PointPredictor predictor(result.model, result.data.conditions());
  const auto take = [&](std::size_t first, std::span<const ImpactResult> answers) {
    for (std::size_t k = 0; k < answers.size(); ++k) {
      const double square = answers[k].restitution_squared;
      result.prediction_squared[first + k] = square;
      result.prediction[first + k] = std::sqrt(std::max(square, 0.0));
    }
  };
  predictor.evaluate_blocks(result.theta, false, take);
}

void record_leverage(FitResult& result, const std::vector<double>& jacobian,
                     const std::vector<double>& unscaled_covariance) {
  const std::size_t n = result.residuals.size();
  result.leverage =
      unscaled_covariance.empty()
          ? std::vector<double>(n, 0.0)
          : leverages(std::span(jacobian).first(n * result.theta.size()), unscaled_covariance);
}

/// (e - e_model)^2 of a point; a capture counts with e = 0.
double squared_miss(const Observation& point, const PointWeights& weights,
                    double predicted_squared) {
  const double measured = point.censored ? 0.0 : point.restitution;
  return std::pow(measured - expected_restitution(point, weights, predicted_squared), 2);
}

/// Root mean square of e - e_model over the points with a known e; NaN without any.
double root_mean_square(const FitResult& result) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < result.data.points.size(); ++i) {
    if (result.data.points[i].counts_only()) continue;
    sum +=
        squared_miss(result.data.points[i], result.weights.points[i], result.prediction_squared[i]);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : NAN;
}

/// Copies the end of a descent into the result and computes the predictions there.
void take_over(FitResult& result, const LeastSquaresResult& run) {
  const std::size_t n = result.data.points.size();
  result.theta = run.theta;
  result.at_bound = run.at_bound;
  result.ending = run.end;
  result.strategy = run.strategy;
  result.flat = run.flat;
  result.residuals.assign(run.residuals.begin(),
                          run.residuals.begin() + static_cast<std::ptrdiff_t>(n));
  result.objective = run.sum_of_squares;
  result.constants_moved = constant_deviations(result.model, result.data, result.theta);
  record_predictions(result);
  record_leverage(result, run.jacobian, run.covariance);
}

Misfit misfit_of(const FitResult& result, const LeastSquaresResult& run) {
  return misfit(
      result.data, result.weights, result.residuals, result.prediction_squared,
      result.model.free_count(),
      constants_in_fit(run, result.model.adjusted_count(), result.weights.noise.constants_weight));
}

/// Repeats the fit with `constants_weight` = noise_scale until noise_scale does not change: the
/// standard deviations of the points are too small by noise_scale, those of the constants are not.
/// @return false if a fit failed
bool keep_errors_of_constants(FitResult& result, LeastSquaresResult& run,
                              const LeastSquaresOptions& options) {
  constexpr int most_rounds = 20;
  constexpr double at_rest = 1e-4;  // relative change of the scale
  for (int round = 0; round < most_rounds; ++round) {
    result.weights.noise.constants_weight = result.noise_scale;
    ReweightedFit again = reweighted_fit(result.model, result.data, result.weights.noise,
                                         result.theta, {.minimiser = options});
    result.handovers += again.handovers;
    run = std::move(again.run);
    if (!run.ended()) return false;
    result.weights = std::move(again.weights);
    take_over(result, run);
    const double scale = std::max(1.0, misfit_of(result, run).scale());
    const bool done = std::abs(scale / result.noise_scale - 1.0) < at_rest;
    result.noise_scale = scale;
    result.weights_at_rest = done && again.at_rest;
    if (done) break;
  }
  return true;
}

/// Counts the points whose errors of V and d are too large for a first-order effective variance.
int count_strained(const Observations& data, const Weights& weights) {
  int strained = 0;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const PointWeights& w = weights.points[i];
    const double of_e2 = std::max(2.0 * data.points[i].restitution, w.sd) * w.sd;
    if (std::abs(w.input_bias) > strained_bias * std::hypot(of_e2, w.input_sd)) ++strained;
  }
  return strained;
}

/// Removes counts of captures where a mechanism of the model, or the sizes that a dataset states,
/// describe how the impacts of a point differ. The mean e there is that of the survivors, so the
/// spread of the impacts must not be estimated a second time from the counts.
void leave_out_explained_counts(const ImpactModel& model, FitResult& result) {
  const auto found = std::find_if(model.chain.begin(), model.chain.end(),
                                  [](const Mechanism* mechanism) { return mechanism->spreads(); });
  const Mechanism* const by = found == model.chain.end() ? nullptr : *found;
  int counts = 0;
  for (Observation& point : result.data.points) {
    if (point.censored || !point.counted) continue;
    if (by == nullptr && !averages_over_sizes(model, point.dataset)) continue;
    point.events -= std::exchange(point.captured, 0);
    point.counted = false;
    ++counts;
  }
  if (counts > 0) result.unused_counts = {by, counts};
}

/// "; the best so far: C_H = 0.0039, C_A = 0.028", without those that are held; empty without
/// finite values.
std::string best_so_far(const ImpactModel& model, const std::vector<double>& theta) {
  std::string text;
  for (std::size_t j = 0; j < theta.size(); ++j) {
    if (!std::isfinite(theta[j])) return "";
    if (!model.slots[j].free) continue;
    text += fmt::format("{} {} = {:.4g}", text.empty() ? "; the best so far:" : ",",
                        model.slots[j].label(), theta[j]);
  }
  return text;
}

/// The end of the start that came down most.
const StartSummary& lowest(const std::vector<StartSummary>& starts) {
  return *std::ranges::min_element(starts, {}, [](const StartSummary& start) {
    return std::isfinite(start.chi2) && !start.end.empty() ? start.chi2 : INFINITY;
  });
}

/// `fit` on the threads of the caller's arena.
FitResult fitted_here(const ImpactModel& model, Observations&& observed,
                      const FitOptions& options) {
  FitResult result;
  result.model = model;
  result.data = std::move(observed);
  leave_out_explained_counts(model, result);
  const std::vector<double> first = options.start.empty() ? model.initial() : options.start;
  const int free_count = model.free_count();
  result.dof = static_cast<int>(result.data.points.size()) - free_count;
  if (result.dof < 0) {
    result.failure =
        fmt::format("{} cannot determine {}", counted(result.data.points.size(), "point"),
                    counted(free_count, "free parameter"));
    return result;
  }
  StartSearch search =
      search_from_starts(model, result.data, first, options.several_starts, options.minimiser);
  result.starts = std::move(search.starts);
  result.searched_points = search.points;
  result.handovers += search.handovers;
  if (search.leads.empty()) {
    const std::string where = unanswered_point(model, result.data, first);
    const StartSummary& best = lowest(result.starts);
    result.failure =
        where.empty() ? "no start converged: " + best.message : "no start converged; " + where;
    result.failure += best_so_far(model, best.end);
    return result;
  }
  LeastSquaresOptions minimiser = options.minimiser;
  if (search.sampled) {
    minimiser.strategies.insert(minimiser.strategies.begin(), Strategy::gauss_newton);
  }
  LeastSquaresResult best;
  std::size_t best_start = search.leads.front().start;
  if (result.data.weights_depend_on_fit()) {
    Noise noise = options.noise.value_or(first_noise(result.data.noise));
    noise.constants_weight = 1.0;
    ReweightedFit reweighted = reweighted_fit(
        model, result.data, noise, search.leads.front().run.theta, {.minimiser = minimiser});
    result.handovers += reweighted.handovers;
    if (!reweighted.run.ended()) {
      result.failure = "reweighting did not converge: " + reweighted.run.message +
                       best_so_far(model, reweighted.run.theta);
      return result;
    }
    result.weights_at_rest = reweighted.at_rest;
    best = std::move(reweighted.run);
    result.weights = std::move(reweighted.weights);
  } else {
    result.weights = first_weights(result.data);
    const auto predictor = std::make_shared<PointPredictor>(model, result.data.conditions());
    const LeastSquaresProblem problem =
        impact_problem(model, result.data, result.weights, predictor);
    for (StartLead& lead : search.leads) {
      LeastSquaresResult run = minimise(problem, lead.run.theta, minimiser);
      if (!run.ended() && !search.sampled) run = std::move(lead.run);
      if (!run.ended() || (best.ended() && !(run.sum_of_squares < best.sum_of_squares))) continue;
      best = std::move(run);
      best_start = lead.start;
    }
    result.handovers += predictor->handovers();
    if (!best.ended()) {
      result.failure =
          "no fit to all points converged from the results of the starts on some of them" +
          best_so_far(model, search.leads.front().run.theta);
      return result;
    }
  }
  result.usable = true;
  result.criterion = restricted_criterion(model, result.data, best, result.weights);
  take_over(result, best);
  result.chi2 = best.sum_of_squares;
  judge_noise(result, misfit_of(result, best));
  if (result.noise_verdict == NoiseVerdict::exceeded && model.adjusts_constants() &&
      !keep_errors_of_constants(result, best, options.minimiser)) {
    result.usable = false;
    result.failure = "the fit with widened errors of the points did not converge: " + best.message +
                     best_so_far(model, best.theta);
    return result;
  }
  result.strained_points = count_strained(result.data, result.weights);
  result.covariance = scaled_covariance(result.data, best.covariance, result.noise_scale);
  set_estimated_parts(result, best);
  result.spread_covariance =
      event_spread_covariance(model, result.theta, result.data, result.weights, best.covariance);
  for (std::size_t k = 0; k < result.spread_covariance.size(); ++k) {
    result.covariance[k] += result.spread_covariance[k];
    for (EstimatedPart& part : result.estimated) {
      if (part.error == Estimated::spread) part.covariance[k] += result.spread_covariance[k];
    }
  }
  result.constant_effects = constant_effects(model, best, result.data.points.size());
  add_constant_effects(result.constant_effects, result.covariance);
  if (!result.weights.noise.known) result.covariance.clear();
  result.std_error.assign(result.theta.size(), 0.0);
  for (std::size_t j = 0; !result.covariance.empty() && j < result.theta.size(); ++j) {
    result.std_error[j] = std::sqrt(result.covariance[j * result.theta.size() + j]);
  }
  result.rmse = root_mean_square(result);
  compare_starts(result.starts, best_start, result.std_error);
  return result;
}

}  // namespace

int degrees_of_freedom(const FitResult& fitted, std::span<const double> gradient) {
  if (fitted.quantile_dof == 0 || fitted.covariance.empty()) return fitted.quantile_dof;
  const std::size_t p = gradient.size();
  const auto variance_by = [&](const std::vector<double>& covariance) {
    double variance = 0.0;
    for (std::size_t a = 0; a < p; ++a) {
      for (std::size_t b = 0; b < p; ++b) {
        variance += gradient[a] * covariance[a * p + b] * gradient[b];
      }
    }
    return variance;
  };
  const double variance = variance_by(fitted.covariance);
  if (!(variance > 0.0)) return fitted.quantile_dof;
  double sum = 0.0;
  for (const EstimatedPart& part : fitted.estimated) {
    sum += std::pow(variance_by(part.covariance) / variance, 2) / part.dof;
  }
  constexpr double normal = 1e6;  // above it, the quantiles are normal to six digits
  return static_cast<int>(std::min(normal, (1.0 + 1e-9) / std::max(sum, 1.0 / normal)));
}

int degrees_of_freedom(const FitResult& fitted, std::size_t slot) {
  std::vector<double> gradient(fitted.theta.size(), 0.0);
  gradient[slot] = 1.0;
  return degrees_of_freedom(fitted, gradient);
}

std::vector<std::size_t> held_back_dampings(const FitResult& fitted) {
  std::vector<std::size_t> found;
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    const bool rests = fitted.at_bound[j] && fitted.theta[j] >= slot.upper;
    if (slot.parameter->is_damping() && rests) found.push_back(j);
  }
  return found;
}

const StartSummary& FitEnd::best_start() const {
  return *std::find_if(starts.begin(), starts.end(), [](const StartSummary& start) {
    return start.outcome == StartOutcome::best;
  });
}

FitResult fit(const ImpactModel& model, Observations observed, const FitOptions& options) {
  return on_threads(options.threads,
                    [&] { return fitted_here(model, std::move(observed), options); });
}

double root_mean_square(const ImpactModel& model, std::span<const double> theta,
                        const Observations& data, const Weights& weights,
                        const std::vector<std::size_t>& subset) {
  std::vector<std::size_t> points = subset;
  if (points.empty()) {
    points.resize(data.points.size());
    std::iota(points.begin(), points.end(), std::size_t{0});
  }
  std::erase_if(points, [&](std::size_t i) { return data.points[i].counts_only(); });
  if (points.empty()) return 0.0;
  std::vector<PointConditions> conditions;
  for (const std::size_t i : points) {
    conditions.push_back(data.points[i].conditions());
  }
  const std::vector<Prediction> predictions = predict(model, theta, std::move(conditions), false);
  double sum = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    sum += squared_miss(data.points[points[k]], weights.points[points[k]],
                        predictions[k].restitution_squared);
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace recoil
