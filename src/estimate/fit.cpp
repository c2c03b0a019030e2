#include "estimate/fit.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "core/numerics.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/misfit.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "estimate/reweighting.hpp"
#include "estimate/shared_settings.hpp"

namespace recoil {

namespace {

// If the p-value of chi-squared under the stated noise is below this, every interval is widened.
constexpr double misfit_level = 0.01;
// Below this p-value the fit is called doubtful; chance may explain it.
constexpr double doubtful_level = 0.05;
// Two minima within this relative difference of chi2 are a tie, if their parameters differ.
constexpr double tie_tolerance = 1e-6;

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

/// Compares the scatter of the points with their standard deviations: sets the verdict, the noise
/// scale and the degrees of freedom.
void judge_noise(FitResult& result, const Misfit& misfit) {
  result.dof = misfit.dof;
  result.p_value = misfit.p_value;
  const auto verdict = [&] {
    if (misfit.dof <= 0) return NoiseVerdict::unchecked;
    if (!result.data.noise.sd_stated) return NoiseVerdict::estimated;
    if (misfit.p_value < misfit_level) return NoiseVerdict::exceeded;
    return misfit.p_value < doubtful_level ? NoiseVerdict::doubtful : NoiseVerdict::explained;
  };
  result.noise_verdict = verdict();
  if (result.noise_verdict == NoiseVerdict::estimated ||
      result.noise_verdict == NoiseVerdict::exceeded) {
    result.noise_scale = misfit.scale();
  }
  const double least = std::max(result.data.noise.scale, result.data.noise.rounding_sd);
  const bool scatters = least * result.noise_scale > least_noise;
  if (result.noise_verdict == NoiseVerdict::estimated) {
    result.noise_scale = std::max(
        result.noise_scale, std::min(1.0, result.data.noise.rounding_sd / result.data.noise.scale));
    // The degrees of freedom by which the points determine the constants do not determine the
    // noise.
    result.dof -= static_cast<int>(std::lround(misfit.learned));
  }
  Noise& noise = result.data.noise;
  noise.known = result.data.noise.sd_stated || (result.dof > 0 && scatters);
  if (!noise.known) {
    result.noise_scale = 1.0;
    result.noise_verdict = NoiseVerdict::unchecked;
  }
  const auto known_by = [&](int dof) {
    if (dof > 0 && (result.quantile_dof == 0 || dof < result.quantile_dof)) {
      result.quantile_dof = dof;
    }
  };
  if (!result.data.noise.sd_stated) known_by(result.dof);
  if (noise.event_spread > 0.0) {
    // Degrees of freedom of the spread of the impacts: those in the range where some spheres stick
    // count, and single impacts in proportion to the part of their variance that comes from the
    // spread (Satterthwaite 1946, Biometrics Bull. 2, 110).
    const std::vector<bool> among = among_captures(result.data.points);
    double impacts = 0.0;
    for (std::size_t i = 0; i < among.size(); ++i) {
      const Observation& point = result.data.points[i];
      if (point.events > 1 || point.censored) {
        impacts += among[i] ? point.events : 0;
      } else if (point.weights.scatter > 0.0) {
        impacts += std::pow(1.0 - std::pow(point.weights.sd / point.weights.mean_sd, 2), 2);
      }
    }
    known_by(std::max(1, static_cast<int>(impacts) - 1));
  }
  if (result.data.noise.setting_sd_estimated) {
    known_by(spare_settings(result.data, result.model.free_count()));
  }
}

/// (e - e_model)^2 of a point; a capture counts with e = 0.
double squared_miss(const Observation& point, double predicted_squared) {
  const double measured = point.censored ? 0.0 : point.restitution;
  return std::pow(measured - expected_restitution(point, predicted_squared), 2);
}

/// Root mean square of e - e_model over the points with a known e; NaN without any.
double root_mean_square(const FitResult& result) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < result.data.points.size(); ++i) {
    if (result.data.points[i].counts_only()) continue;
    sum += squared_miss(result.data.points[i], result.prediction_squared[i]);
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
  return misfit(result.data, result.residuals, result.prediction_squared, result.model.free_count(),
                constants_in_fit(run, result.model.adjusted_count(), result.data.constants_weight));
}

/// Repeats the fit with `constants_weight` = noise_scale until noise_scale does not change: the
/// standard deviations of the points are too small by noise_scale, those of the constants are not.
/// @return false if a fit failed
bool keep_errors_of_constants(FitResult& result, LeastSquaresResult& run,
                              const LeastSquaresOptions& options) {
  constexpr int most_rounds = 20;
  constexpr double at_rest = 1e-4;  // relative change of the scale
  for (int round = 0; round < most_rounds; ++round) {
    result.data.constants_weight = result.noise_scale;
    ReweightedFit again =
        reweighted_fit(result.model, result.data, result.theta, {.minimiser = options});
    run = std::move(again.run);
    if (!run.ended()) return false;
    result.data = std::move(again.data);
    take_over(result, run);
    const double scale = misfit_of(result, run).scale();
    const bool done = std::abs(scale / result.noise_scale - 1.0) < at_rest;
    result.noise_scale = scale;
    result.weights_at_rest = done && again.at_rest;
    if (done) break;
  }
  return true;
}

/// Counts the points whose errors of V and d are too large for a first-order effective variance.
int count_strained(const std::vector<Observation>& points) {
  return static_cast<int>(std::count_if(points.begin(), points.end(), [](const Observation& p) {
    const PointWeights& w = p.weights;
    const double sd = std::hypot(std::max(2.0 * p.restitution, w.sd) * w.sd, w.input_sd);
    return std::abs(w.input_bias) > strained_bias * sd;
  }));
}

void compare_starts(FitResult& result, std::size_t best_start) {
  const StartSummary& best = result.starts[best_start];
  for (std::size_t k = 0; k < result.starts.size(); ++k) {
    StartSummary& start = result.starts[k];
    if (start.ending == DescentEnd::limit || start.ending == DescentEnd::no_answer) continue;
    if (k != best_start && start.ending == DescentEnd::flat) {
      start.outcome = StartOutcome::flat;
      continue;
    }
    start.outcome = k == best_start ? StartOutcome::best : StartOutcome::same;
    if (start.chi2 > best.chi2 * (1.0 + 1e-3) + 1e-6) {
      start.outcome = StartOutcome::worse;
    } else if (start.chi2 <= best.chi2 * (1.0 + tie_tolerance)) {
      for (std::size_t j = 0; j < start.end.size(); ++j) {
        if (result.std_error[j] > 0.0 &&
            std::abs(start.end[j] - best.end[j]) > 0.1 * result.std_error[j]) {
          start.outcome = StartOutcome::tie;
          start.differing.push_back(j);
        }
      }
    }
  }
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

/// `fit` on the threads of the caller's arena.
FitResult fitted_here(const ImpactModel& model, Observations&& observed,
                      const FitOptions& options) {
  FitResult result;
  result.model = model;
  result.data = std::move(observed);
  result.data.constants_weight = 1.0;
  leave_out_explained_counts(model, result);
  const std::vector<double> first = options.start.empty() ? model.initial() : options.start;
  const int free_count = model.free_count();
  result.dof = static_cast<int>(result.data.points.size()) - free_count;
  if (result.dof < 0) {
    result.failure = fmt::format("{} points cannot determine {} free parameters",
                                 result.data.points.size(), free_count);
    return result;
  }
  StartSearch search =
      search_from_starts(model, result.data, first, options.several_starts, options.minimiser);
  result.starts = std::move(search.starts);
  result.searched_points = search.points;
  result.handovers += search.handovers;
  if (search.leads.empty()) {
    const std::string where = unanswered_point(model, result.data, first);
    result.failure = where.empty() ? "no start converged: " + result.starts.front().message
                                   : "no start converged; " + where;
    return result;
  }
  LeastSquaresOptions minimiser = options.minimiser;
  if (search.sampled) {
    minimiser.strategies.insert(minimiser.strategies.begin(), Strategy::gauss_newton);
  }
  LeastSquaresResult best;
  std::size_t best_start = search.leads.front().start;
  if (result.data.weights_depend_on_fit()) {
    ReweightedFit reweighted = reweighted_fit(model, result.data, search.leads.front().run.theta,
                                              {.minimiser = minimiser});
    if (!reweighted.run.ended()) {
      result.failure = "reweighting did not converge: " + reweighted.run.message;
      return result;
    }
    result.weights_at_rest = reweighted.at_rest;
    best = std::move(reweighted.run);
    result.data = std::move(reweighted.data);
  } else {
    const LeastSquaresProblem problem = impact_problem(model, result.data, &result.handovers);
    for (StartLead& lead : search.leads) {
      LeastSquaresResult run = minimise(problem, lead.run.theta, minimiser);
      if (!run.ended() && !search.sampled) run = std::move(lead.run);
      if (!run.ended() || (best.ended() && !(run.sum_of_squares < best.sum_of_squares))) continue;
      best = std::move(run);
      best_start = lead.start;
    }
    if (!best.ended()) {
      result.failure =
          "no fit to all points converged from the results of the starts on some of them";
      return result;
    }
  }
  result.usable = true;
  take_over(result, best);
  result.chi2 = best.sum_of_squares;
  judge_noise(result, misfit_of(result, best));
  if (result.noise_verdict == NoiseVerdict::exceeded && model.adjusts_constants() &&
      !keep_errors_of_constants(result, best, options.minimiser)) {
    result.usable = false;
    result.failure = "the fit with widened errors of the points did not converge: " + best.message;
    return result;
  }
  result.strained_points = count_strained(result.data.points);
  result.covariance = scaled_covariance(result.data, best.covariance, result.noise_scale);
  result.spread_covariance =
      event_spread_covariance(model, result.theta, result.data, best.covariance);
  for (std::size_t k = 0; k < result.spread_covariance.size(); ++k) {
    result.covariance[k] += result.spread_covariance[k];
  }
  result.constant_effects = constant_effects(model, best, result.data.points.size());
  add_constant_effects(result.constant_effects, result.covariance);
  if (!result.data.noise.known) result.covariance.clear();
  result.std_error.assign(result.theta.size(), 0.0);
  for (std::size_t j = 0; !result.covariance.empty() && j < result.theta.size(); ++j) {
    result.std_error[j] = std::sqrt(result.covariance[j * result.theta.size() + j]);
  }
  result.rmse = root_mean_square(result);
  compare_starts(result, best_start);
  return result;
}

// With more points than `many_points`, the descents from the starts use 250 to 374 of them: a rough
// answer is enough to compare starts, and only the last steps need all points.
constexpr std::size_t many_points = 500;
constexpr std::size_t searched_of_many = 250;

/// Adds `first` with the damping factors multiplied by 0.1, 1 and 10 in all combinations: capture
/// and strong damping create flat and non-convex regions around the minimum.
void add_dampings(const ImpactModel& model, const std::vector<double>& first,
                  std::vector<std::vector<double>>& starts) {
  for (const double hertz : {0.1, 1.0, 10.0}) {
    for (const double adhesion : {0.1, 1.0, 10.0}) {
      if (hertz == 1.0 && adhesion == 1.0) continue;
      std::vector<double> start = first;
      bool moved = false;
      for (std::size_t j = 0; j < start.size(); ++j) {
        const ParameterSlot& slot = model.slots[j];
        if (!slot.free || !slot.parameter->is_damping()) continue;
        const double factor =
            slot.parameter->role == ParameterRole::hertz_damping ? hertz : adhesion;
        start[j] = std::clamp(start[j] * factor, slot.lower, slot.upper);
        moved = moved || start[j] != first[j];
      }
      if (moved) starts.push_back(std::move(start));
    }
  }
}

/// The stated start, with other dampings; the same around the dampings of the catalogue if a stated
/// one differs from these by more than a factor of ten; then the starts that the catalogue of
/// mechanisms lists, one parameter at a time.
std::vector<std::vector<double>> starting_points(const ImpactModel& model,
                                                 const std::vector<double>& first, bool several) {
  std::vector<std::vector<double>> starts = {first};
  if (!several) return starts;
  add_dampings(model, first, starts);
  std::vector<double> usual = first;
  bool far = false;
  for (std::size_t j = 0; j < first.size(); ++j) {
    const ParameterSlot& slot = model.slots[j];
    if (!slot.free || !slot.parameter->is_damping()) continue;
    usual[j] = std::clamp(slot.parameter->initial, slot.lower, slot.upper);
    far = far || !(first[j] <= 10.0 * usual[j] && usual[j] <= 10.0 * first[j]);
  }
  if (far) {
    starts.push_back(usual);
    add_dampings(model, usual, starts);
  }
  for (std::size_t j = 0; j < first.size(); ++j) {
    const ParameterSlot& slot = model.slots[j];
    if (!slot.free) continue;
    for (const double value : slot.parameter->starts) {
      if (value < slot.lower || value > slot.upper || value == first[j]) continue;
      starts.push_back(first);
      starts.back()[j] = value;
    }
  }
  return starts;
}

/// Every n-th point, sorted by dataset, diameter and velocity.
std::vector<std::size_t> spread_part(const std::vector<Observation>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return std::tuple(points[i].dataset, points[i].diameter, points[i].velocity, i);
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<std::size_t> part;
  const std::size_t stride = points.size() / searched_of_many;
  for (std::size_t k = stride / 2; k < order.size(); k += stride) part.push_back(order[k]);
  return part;
}

/// The points that the descents from the starts use; nullopt for all. Until the scatter of the
/// impacts is known, a mean of survivors lies far above the curve, so points with rebounds and
/// captures are left to `reweighted_fit` if the other points suffice.
std::optional<Observations> searched_part(const Observations& data, std::ptrdiff_t free_count) {
  const std::vector<bool> mixed = among_captures(data.points);
  std::ptrdiff_t rebounds = 0;
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    if (!mixed[i] && !data.points[i].censored) ++rebounds;
  }
  const bool leave_mixed =
      std::find(mixed.begin(), mixed.end(), true) != mixed.end() && rebounds > free_count;
  const bool many = data.points.size() > many_points;
  if (!leave_mixed && !many) return std::nullopt;
  std::vector<std::size_t> used;
  if (many) {
    used = spread_part(data.points);
  } else {
    used.resize(data.points.size());
    std::iota(used.begin(), used.end(), std::size_t{0});
  }
  if (leave_mixed) std::erase_if(used, [&](std::size_t i) { return mixed[i]; });
  return data.subset(used);
}

/// Do the parameters of `run` differ from those of `best` by more than a tenth of their standard
/// errors?
bool ends_elsewhere(const LeastSquaresResult& run, const LeastSquaresResult& best) {
  const std::size_t p = run.theta.size();
  for (std::size_t j = 0; j < p; ++j) {
    const double error = best.covariance.empty() ? 0.0 : std::sqrt(best.covariance[j * p + j]);
    const double unit = error > 0.0 ? 0.1 * error : 1e-3 * std::abs(best.theta[j]);
    if (std::abs(run.theta[j] - best.theta[j]) > unit) return true;
  }
  return false;
}

/// Continues descents that reached the iteration limit with a smaller sum of squares than every
/// finished descent: by box_descent, as long as the sum decreases.
void finish_promising(const LeastSquaresProblem& problem, LeastSquaresOptions options,
                      std::vector<StartSummary>& starts, std::vector<StartLead>& ended) {
  constexpr int most_descents = 5;
  double least = INFINITY;
  for (const StartLead& lead : ended) least = std::min(least, lead.run.sum_of_squares);
  options.strategies = {Strategy::box_descent};
  for (std::size_t k = 0; k < starts.size(); ++k) {
    StartSummary& start = starts[k];
    for (int round = 0; start.ending == DescentEnd::limit && round < most_descents; ++round) {
      if (!(start.chi2 < least)) break;
      LeastSquaresResult run = minimise(problem, start.end, options);
      if (run.end == DescentEnd::no_answer || !(run.sum_of_squares < start.chi2 || run.ended()))
        break;
      start = {start.start, run.theta, run.sum_of_squares, run.end, run.message};
      if (!run.ended()) continue;
      least = std::min(least, run.sum_of_squares);
      ended.push_back({k, std::move(run)});
    }
  }
}

constexpr double stated_level = 0.05;
constexpr double estimated_level = 0.01;
constexpr double rejected = 0.05;  // p-value below which a fit is rejected
constexpr double fixed = 1e-9;     // 1 - h of a point that alone determines a parameter

}  // namespace

std::vector<std::size_t> held_back_dampings(const FitResult& fitted) {
  std::vector<std::size_t> found;
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    const bool rests = fitted.at_bound[j] && fitted.theta[j] >= slot.upper;
    if (slot.parameter->is_damping() && rests) found.push_back(j);
  }
  return found;
}

const StartSummary& FitResult::best_start() const {
  return *std::find_if(starts.begin(), starts.end(), [](const StartSummary& start) {
    return start.outcome == StartOutcome::best;
  });
}

FitResult fit(const ImpactModel& model, Observations observed, const FitOptions& options) {
  return on_threads(options.threads,
                    [&] { return fitted_here(model, std::move(observed), options); });
}

double root_mean_square(const ImpactModel& model, std::span<const double> theta,
                        const Observations& data, const std::vector<std::size_t>& subset) {
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
    sum += squared_miss(data.points[points[k]], predictions[k].restitution_squared);
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

StartSearch search_from_starts(const ImpactModel& model, const Observations& data,
                               const std::vector<double>& first, bool several,
                               LeastSquaresOptions options) {
  StartSearch search;
  const std::optional<Observations> part = searched_part(data, model.free_count());
  const Observations& seen = part ? *part : data;
  search.points = seen.points.size();
  search.sampled = data.points.size() > many_points;
  const LeastSquaresProblem problem = impact_problem(model, seen, &search.handovers);
  options.finish = false;  // only the best run is refined
  std::vector<StartLead> ended;
  for (const std::vector<double>& start : starting_points(model, first, several)) {
    LeastSquaresResult run = minimise(problem, start, options);
    search.starts.push_back({start, run.theta, run.sum_of_squares, run.end, run.message});
    if (run.ended()) ended.push_back({search.starts.size() - 1, std::move(run)});
  }
  finish_promising(problem, options, search.starts, ended);
  if (ended.empty()) return search;
  const auto best =
      std::min_element(ended.begin(), ended.end(), [](const StartLead& a, const StartLead& b) {
        return a.run.sum_of_squares < b.run.sum_of_squares;
      });
  std::iter_swap(ended.begin(), best);
  search.leads.push_back(std::move(ended.front()));
  if (!search.sampled) return search;
  // If the sums of squares over all points differ by D on average, a sample's difference has the
  // standard deviation 2 sqrt(D). A minimum that is worse over all points is ahead by this much in
  // the sample only if chance exceeds seven of these.
  constexpr double telling = 50.0;
  const double least = search.leads.front().run.sum_of_squares;
  const double noise = std::max(1.0, least / static_cast<double>(problem.residual_count));
  for (std::size_t k = 1; k < ended.size(); ++k) {
    const LeastSquaresResult& run = ended[k].run;
    if (run.end == DescentEnd::flat || run.sum_of_squares > least + telling * noise) continue;
    const bool is_new =
        std::all_of(search.leads.begin(), search.leads.end(),
                    [&](const StartLead& lead) { return ends_elsewhere(run, lead.run); });
    if (is_new) search.leads.push_back(std::move(ended[k]));
  }
  return search;
}

std::optional<OddPoint> odd_point(const FitResult& fitted) {
  gsl_errors_are_values();
  const bool stated = fitted.data.noise.sd_stated;
  const std::size_t n = fitted.data.points.size();
  if (!fitted.usable || !fitted.data.noise.known || fitted.data.noise.student) return {};
  if (fitted.dof < 3 || (stated && fitted.p_value >= rejected)) return {};
  const double square = std::inner_product(fitted.residuals.begin(), fitted.residuals.end(),
                                           fitted.residuals.begin(), 0.0);
  OddPoint odd;
  double most = 0.0;  // r^2 / (1 - h)
  for (std::size_t i = 0; i < n; ++i) {
    const double rest = 1.0 - fitted.leverage[i];
    if (fitted.data.points[i].censored || !(rest > fixed)) continue;
    const double gain = fitted.residuals[i] * fitted.residuals[i] / rest;
    if (!(gain > most)) continue;
    most = gain;
    odd.index = i;
  }
  const double left = fitted.dof - 1.0;
  const double scale = stated ? 1.0 : std::sqrt(std::max(0.0, square - most) / left);
  if (!(most > 0.0)) return {};
  odd.residual = std::copysign(std::sqrt(most) / scale, fitted.residuals[odd.index]);
  const double tail = stated ? gsl_cdf_ugaussian_Q(std::abs(odd.residual))
                             : gsl_cdf_tdist_Q(std::abs(odd.residual), left);
  if (2.0 * tail * static_cast<double>(n) > (stated ? stated_level : estimated_level)) return {};
  std::vector<std::size_t> others(n);
  std::iota(others.begin(), others.end(), std::size_t{0});
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(odd.index));
  FitOptions options;
  options.several_starts = false;
  options.start = fitted.theta;
  odd.without = fit(fitted.model, fitted.data.subset(others), options);
  if (!odd.without.usable || (stated && odd.without.p_value < rejected)) return {};
  return odd;
}

}  // namespace recoil
