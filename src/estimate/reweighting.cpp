#include "estimate/reweighting.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "estimate/impact_problem.hpp"
#include "estimate/misfit.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_errors.hpp"

namespace recoil {

namespace {

constexpr int most_rounds = 25;
// A replicate drops a variance function whose criterion exceeds that of another one by this.
constexpr double far_behind = 2.0;

/// The steps of the parameters in their standard errors, or relative to their values without one.
std::vector<double> relative_steps(const LeastSquaresResult& run,
                                   const std::vector<double>& before) {
  const std::size_t p = before.size();
  std::vector<double> steps(p, 0.0);
  for (std::size_t j = 0; j < p; ++j) {
    const double error = run.covariance.empty() ? 0.0 : std::sqrt(run.covariance[j * p + j]);
    const double unit = error > 0.0 ? error : std::abs(run.theta[j]);
    const double step = run.theta[j] - before[j];
    if (step != 0.0) steps[j] = step / unit;
  }
  return steps;
}

double largest(const std::vector<double>& steps) {
  double most = 0.0;
  for (const double step : steps) most = std::max(most, std::abs(step));
  return most;
}

/// Aitken extrapolation of the rounds, whose steps may shrink slowly by a constant ratio.
class Extrapolation {
 public:
  /// The start of the next round after one from `before` to `run.theta`.
  std::vector<double> next(const ImpactModel& model, const LeastSquaresResult& run,
                           const std::vector<double>& before, std::vector<double> steps) {
    double dot = 0.0;
    double square = 0.0;
    for (std::size_t j = 0; j < last_.size(); ++j) {
      dot += steps[j] * last_[j];
      square += last_[j] * last_[j];
    }
    const double ratio = square > 0.0 ? dot / square : 0.0;
    constexpr double slow = 0.3;
    constexpr double steady = 0.95;  // above it the steps hardly shrink and are not extrapolated
    std::vector<double> theta = run.theta;
    if (!(ratio > slow && ratio < steady)) {
      last_ = std::move(steps);
      return theta;
    }
    last_.clear();  // a step after an extrapolation gives no ratio
    for (std::size_t j = 0; j < theta.size(); ++j) {
      const ParameterSlot& slot = model.slots[j];
      if (!slot.free || run.at_bound[j]) continue;
      const double leap = theta[j] + ratio / (1.0 - ratio) * (theta[j] - before[j]);
      if (leap > slot.lower && leap < slot.upper) theta[j] = leap;
    }
    return theta;
  }

 private:
  std::vector<double> last_;
};

/// @param limit ends the rounds if the restricted criterion, at the best scale, exceeds it
ReweightedFit reweight_with(const ImpactModel& model, const Observations& data, const Noise& noise,
                            std::span<const double> start, const ReweightingOptions& options,
                            const std::shared_ptr<PointPredictor>& points,
                            double limit = INFINITY) {
  ReweightedFit result;
  result.weights = first_weights(data, noise);
  std::vector<double> theta(start.begin(), start.end());
  Extrapolation extrapolation;
  LeastSquaresOptions minimiser = options.minimiser;
  minimiser.finish = false;  // only after the last round
  for (int round = 0; round < most_rounds; ++round) {
    std::optional<Weights> renewed =
        weights_at(model, data, std::move(result.weights), theta, *points);
    if (!renewed) {
      result.run.end = DescentEnd::no_answer;
      result.run.converged = false;
      result.run.message =
          "the weights need simulated impacts near every point, and one of these has no solution";
      return result;
    }
    result.weights = std::move(*renewed);
    double& noise_scale = result.weights.noise.scale;
    result.run = minimise(impact_problem(model, data, result.weights, points), theta, minimiser);
    if (!result.run.ended()) return result;
    minimiser.strategies = {Strategy::gauss_newton,
                            Strategy::box_descent};  // the next start is near the answer
    double scale = 1.0;
    if (!data.noise.sd_stated) {
      const ConstantsInFit constants =
          constants_in_fit(result.run, model.adjusted_count(), noise.constants_weight);
      const Misfit found = misfit(data, result.weights, result.run.residuals,
                                  result.weights.predicted, model.free_count(), constants);
      scale = found.scale();
      // For data without noise the scale would shrink without limit.
      const double rounding = data.noise.rounding_sd;
      result.at_rest = std::max(noise_scale, rounding) * scale < least_noise;
      if (result.at_rest) break;
      scale = std::max(scale, std::min(1.0, rounding / noise_scale));
      const double square = scale * scale;
      if (std::isfinite(limit) && restricted_criterion(model, data, result.run, result.weights) -
                                          found.dof * (square - 1.0 - std::log(square)) >
                                      limit) {
        break;
      }
    }
    std::vector<double> steps = relative_steps(result.run, theta);
    result.at_rest = largest(steps) < options.parameters && std::abs(scale - 1.0) < options.scale;
    if (result.at_rest) break;
    theta = extrapolation.next(model, result.run, theta, std::move(steps));
    noise_scale *= scale;
  }
  return result;
}

/// Refines a fit to the last digit with its weights fixed.
ReweightedFit finished(const ImpactModel& model, const Observations& data, ReweightedFit fit,
                       const LeastSquaresOptions& minimiser,
                       const std::shared_ptr<PointPredictor>& points) {
  if (minimiser.finish && fit.run.ended()) {
    LeastSquaresResult run =
        minimise(impact_problem(model, data, fit.weights, points), fit.run.theta, minimiser);
    if (run.ended()) fit.run = std::move(run);
  }
  fit.handovers = points->handovers();
  return fit;
}

}  // namespace

double restricted_criterion(const ImpactModel& model, const Observations& data,
                            const LeastSquaresResult& run, const Weights& weights) {
  const std::optional<StudentNoise>& student = data.noise.student;
  const double unit = student ? student->calibration() : 1.0;
  double criterion = run.sum_of_squares / unit + SharedErrors(data, weights).log_determinant();
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const PointWeights& own = weights.points[i];
    if (data.points[i].censored) continue;
    // The residual holds only the deviance above the peak.
    if (own.scatter > 0.0) criterion += own.peak.deviance;
    criterion += 2.0 * std::log(own.scatter > 0.0 ? own.mean_sd : own.sd);
  }
  const std::size_t p = run.theta.size();
  std::vector<std::size_t> free;
  for (std::size_t j = 0; j < p; ++j) {
    if (model.slots[j].moves()) free.push_back(j);
  }
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(run.residuals.size()),
                           static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < run.residuals.size(); ++i) {
    for (std::size_t k = 0; k < free.size(); ++k) {
      jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          run.jacobian[i * p + free[k]];
    }
  }
  if (free.empty()) return criterion;
  const Eigen::VectorXd diagonal =
      jacobian.householderQr().matrixQR().diagonal().cwiseAbs().array().log();
  const double log_determinant = 2.0 * diagonal.sum();
  return std::isfinite(log_determinant) ? criterion + log_determinant : criterion;
}

double penalty_of(VarianceFunction function) {
  switch (function) {
    case VarianceFunction::constant:
    case VarianceFunction::capture:
      return 2.0;
    case VarianceFunction::proportional:
      return 4.0;
    case VarianceFunction::steep:
    case VarianceFunction::stated:
      break;
  }
  return 0.0;
}

double choice_margin(const Noise& noise) {
  double own = 0.0;
  double other = INFINITY;
  for (const Noise::Candidate& candidate : noise.candidates) {
    if (candidate.function == noise.variance) {
      own = candidate.criterion + penalty_of(candidate.function);
    } else {
      other = std::min(other, candidate.criterion + penalty_of(candidate.function));
    }
  }
  return std::isfinite(other) ? other - own : 0.0;
}

ReweightedFit reweighted_fit(const ImpactModel& model, const Observations& data, const Noise& noise,
                             std::span<const double> start, const ReweightingOptions& options) {
  const auto points = std::make_shared<PointPredictor>(model, data.conditions());
  if (!data.weights_depend_on_fit()) {
    ReweightedFit result{{}, first_weights(data, noise), true};
    result.run =
        minimise(impact_problem(model, data, result.weights, points), start, options.minimiser);
    result.handovers = points->handovers();
    return result;
  }
  if (data.noise.sd_stated || data.noise.spec.variance) {
    return finished(model, data, reweight_with(model, data, noise, start, options, points),
                    options.minimiser, points);
  }
  std::vector<VarianceFunction> functions = {VarianceFunction::constant,
                                             VarianceFunction::proportional,
                                             VarianceFunction::capture, VarianceFunction::steep};
  if (options.replicate) {
    // the function of the original first, as it probably fits best here, too
    std::stable_partition(functions.begin(), functions.end(),
                          [&](VarianceFunction function) { return function == noise.variance; });
  }
  std::optional<ReweightedFit> best;
  double best_criterion = INFINITY;
  std::vector<double> from(start.begin(), start.end());
  std::vector<Noise::Candidate> candidates;
  // The original under the function of candidates.back().
  const Noise::Candidate* before = nullptr;
  for (const VarianceFunction function : functions) {
    Noise own = noise;
    own.variance = function;
    const auto known = std::find_if(
        noise.candidates.begin(), noise.candidates.end(),
        [&](const Noise::Candidate& candidate) { return candidate.function == function; });
    const bool again = options.replicate && known != noise.candidates.end();
    if (again) {
      own.scale = known->scale;
      from = known->theta;
      // The replicate differs from its original by about as much under every function.
      if (before != nullptr) {
        const Noise::Candidate& now = candidates.back();
        own.scale *= now.scale / before->scale;
        own.event_spread = now.event_spread;
        for (std::size_t j = 0; j < from.size(); ++j) {
          const ParameterSlot& slot = model.slots[j];
          if (!slot.moves()) continue;
          from[j] = std::clamp(from[j] + now.theta[j] - before->theta[j], slot.lower, slot.upper);
        }
      }
    }
    const double limit =
        options.replicate ? best_criterion + far_behind - penalty_of(function) : INFINITY;
    ReweightedFit result = reweight_with(model, data, own, from, options, points, limit);
    if (!result.run.ended()) {
      if (!best) best = std::move(result);
      continue;
    }
    const Noise& found = result.weights.noise;
    const double criterion = restricted_criterion(model, data, result.run, result.weights);
    const double total = criterion + penalty_of(function);
    if (again && !(total > limit)) before = &*known;
    if (!again || before == &*known) {
      candidates.push_back(
          {function, found.scale, criterion, found.event_spread, result.run.theta});
    }
    if (total < best_criterion) {
      best_criterion = total;
      best = std::move(result);
    }
  }
  best->weights.noise.candidates = std::move(candidates);
  return finished(model, data, std::move(*best), options.minimiser, points);
}

}  // namespace recoil
