#include "uncertainty/resample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include "estimate/capture_velocity.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/misfit.hpp"
#include "estimate/residual.hpp"
#include "estimate/reweighting.hpp"
#include "estimate/shared_errors.hpp"
#include "uncertainty/intervals.hpp"

namespace recoil {

namespace {

/// r_i / (1 - h_i)^power of every point; 0 for captured ones. With scatter from impact to impact,
/// the residual of the fit also contains the count, which is redrawn; so this takes the residual of
/// the survivors' mean alone.
std::vector<double> scaled_residuals(const FitResult& fitted, double power) {
  std::vector<double> scaled(fitted.data.points.size(), 0.0);
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    const Observation& point = fitted.data.points[i];
    if (point.censored) continue;
    const PointWeights& own = fitted.weights.points[i];
    if (own.scatter > 0.0) {
      const double expected = expected_restitution(point, own, fitted.prediction_squared[i]);
      scaled[i] = (point.restitution - expected) / own.mean_sd;
      continue;
    }
    const double h = std::min(fitted.leverage[i], most_leverage);
    // The residual before whitening includes the errors that the point shares.
    const double residual = fitted.data.share_errors()
                                ? weighted_residual(point, own, fitted.prediction_squared[i]).value
                                : fitted.residuals[i];
    scaled[i] = residual / std::pow(1.0 - h, power);
  }
  return scaled;
}

/// The scaled residuals of the points that rebounded, minus their mean.
std::vector<double> residual_pool(const FitResult& fitted) {
  const std::vector<double> scaled = scaled_residuals(fitted, 0.5);
  std::vector<double> pool;
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    if (!fitted.data.points[i].censored) pool.push_back(scaled[i]);
  }
  double mean = 0.0;
  for (const double r : pool) mean += r / static_cast<double>(pool.size());
  for (double& r : pool) r -= mean;
  return pool;
}

/// The groups of points that may depend on each other: those of one setting, if settings share
/// errors and series do not, else those of one series; joined where points share any other error.
std::vector<std::vector<std::size_t>> clusters_of(const Observations& data) {
  const bool by_setting = data.share(SharedBy::setting) && !data.share(SharedBy::series);
  std::vector<std::size_t> root(data.points.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto root_of = [&root](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::map<std::pair<std::size_t, std::uint64_t>, std::size_t> first;  // point of a source's draw
  const auto join = [&](std::size_t source, std::uint64_t draw, std::size_t i) {
    const std::size_t other = root_of(first.try_emplace({source, draw}, i).first->second);
    const std::size_t own = root_of(i);
    root[std::max(own, other)] = std::min(own, other);
  };
  for (std::size_t i = 0; i < root.size(); ++i) {
    const Observation& point = data.points[i];
    join(data.sources.size(), by_setting ? point.setting : point.batch, i);
    for (std::size_t k = 0; k < data.sources.size(); ++k) {
      for (const ErrorPart& part : data.sources[k]->parts(point)) join(k, part.draw, i);
    }
  }
  std::map<std::size_t, std::vector<std::size_t>> found;
  for (std::size_t i = 0; i < root.size(); ++i) found[root_of(i)].push_back(i);
  std::vector<std::vector<std::size_t>> clusters;
  for (auto& [point, points] : found) clusters.push_back(std::move(points));
  return clusters;
}

/// Sets point i of the sample to its predicted value plus `noise` standard deviations; with scatter
/// from impact to impact, its captures are redrawn.
void disturb(const ResamplingPlan& plan, std::size_t i, double noise, RandomStream& random,
             Observations& sample) {
  Observation& point = sample.points[i];
  const PointWeights& own = plan.fitted->weights.points[i];
  const double m = plan.fitted->prediction_squared[i];
  if (own.scatter > 0.0 && point.counted) {
    const DrawnPoint drawn = redraw_captures(point, own, m, random.uniform());
    point = drawn.point;
    point.restitution = point.censored
                            ? 0.0
                            : std::max(0.0, expected_restitution(point, drawn.weights, m) +
                                                survivors_sd(point, drawn.weights, m) * noise);
    return;
  }
  if (point.censored) return;
  point.restitution = std::max(0.0, expected_restitution(point, own, m) + own.sd * noise);
}

}  // namespace

std::size_t ResamplingPlan::units() const {
  return scheme == Scheme::cluster ? clusters.size() : fitted->data.points.size();
}

std::optional<std::string> scheme_obstacle(Scheme scheme, const Observations& data) {
  const bool all_captured = std::all_of(data.points.begin(), data.points.end(),
                                        [](const Observation& point) { return point.censored; });
  const bool by_residuals = scheme == Scheme::residual || scheme == Scheme::wild;
  if (by_residuals && all_captured) {
    return "no point rebounded: there are no residuals to draw from";
  }
  for (const ErrorSource* source : data.sources) {
    if (source->shared == SharedBy::none || !(by_residuals || scheme == Scheme::cases)) continue;
    return fmt::format(
        "points share an error ({}): single points cannot be exchanged, whole {} can (cluster)",
        source->names.stated_by,
        source->shared == SharedBy::setting ? "settings"
        : source->shared == SharedBy::size  ? "sizes"
                                            : "series");
  }
  if (scheme == Scheme::cluster && clusters_of(data).size() < 2) {
    return "all points belong to one series or share an error: there is nothing to exchange";
  }
  return std::nullopt;
}

ResamplingPlan plan_resampling(const FitResult& fitted, Scheme asked) {
  const Observations& data = fitted.data;
  ResamplingPlan plan;
  plan.fitted = &fitted;
  plan.scheme = asked;
  if (asked == Scheme::automatic) {
    const bool residuals = !scheme_obstacle(Scheme::wild, data);
    plan.scheme = data.noise.sd_stated || !residuals ? Scheme::parametric : Scheme::wild;
    plan.because = data.noise.sd_stated  ? SchemeBecause::sd_stated
                   : residuals           ? SchemeBecause::sd_not_stated
                   : data.share_errors() ? SchemeBecause::shared_errors
                                         : SchemeBecause::no_residuals;
  }
  if (plan.scheme == Scheme::residual) plan.residuals = residual_pool(fitted);
  if (plan.scheme == Scheme::wild) plan.residuals = scaled_residuals(fitted, 1.0);
  if (plan.scheme == Scheme::cluster) plan.clusters = clusters_of(data);
  return plan;
}

void resample_parametric(const ResamplingPlan& plan, std::span<const double> shared_errors,
                         RandomStream& random, Observations& sample) {
  // If constants are redrawn, the simulated noise is added to the measured values, which follow the
  // true constants, not to the curve of the stated ones.
  const FitResult& fitted = *plan.fitted;
  const bool other_constants = !fitted.model.constants.empty() && !fitted.model.adjusts_constants();
  sample.points = fitted.data.points;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    const Observation& measured = fitted.data.points[i];
    const PointWeights& own = fitted.weights.points[i];
    const double m = fitted.prediction_squared[i];
    Observation& point = sample.points[i];
    point = simulate_observation(measured, own, shifted_square(m, shared_errors[i]),
                                 has_own_scatter(fitted.data, i) ? fitted.noise_scale : 0.0,
                                 fitted.data.noise.student, random)
                .point;
    if (!other_constants || !fitted.data.noise.sd_stated) continue;
    if (measured.censored || point.censored) continue;
    point.restitution = std::max(
        0.0, point.restitution + measured.restitution - expected_restitution(measured, own, m));
  }
}

void resample_residual(const ResamplingPlan& plan, RandomStream& random, Observations& sample) {
  sample.points = plan.fitted->data.points;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    disturb(plan, i, plan.residuals[random.below(plan.residuals.size())], random, sample);
  }
}

void resample_wild(const ResamplingPlan& plan, RandomStream& random, Observations& sample) {
  sample.points = plan.fitted->data.points;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
    disturb(plan, i, sign * plan.residuals[i], random, sample);
  }
}

void resample_cases(const ResamplingPlan& plan, RandomStream& random, Observations& sample) {
  const std::vector<Observation>& points = plan.fitted->data.points;
  sample.points.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    sample.points.push_back(points[random.below(points.size())]);
  }
}

void resample_clusters(const ResamplingPlan& plan, RandomStream& random, Observations& sample) {
  sample.points.clear();
  // A setting, batch or launch that is drawn twice becomes two: new numbers by (draw, number).
  std::array<std::map<std::pair<std::size_t, std::size_t>, std::size_t>, 3> again;
  constexpr std::array numbers = {&SharedNumbers::setting, &SharedNumbers::batch,
                                  &SharedNumbers::launch};
  for (std::size_t k = 0; k < plan.clusters.size(); ++k) {
    for (const std::size_t i : plan.clusters[random.below(plan.clusters.size())]) {
      Observation& point = sample.points.emplace_back(plan.fitted->data.points[i]);
      for (std::size_t n = 0; n < numbers.size(); ++n) {
        std::size_t& number = point.*numbers[n];
        if (number == Observation::no_launch) continue;
        number = again[n].try_emplace({k, number}, again[n].size()).first->second;
      }
    }
  }
}

void resample_constants(const FitResult& fitted, std::uint64_t seed, std::uint64_t index,
                        Observations& sample) {
  const std::vector<UncertainConstant>& constants = fitted.model.constants;
  const std::size_t first = fitted.model.first_constant();
  RandomStream random(seed, RandomPurpose::constants, index);
  sample.constants.clear();
  for (std::size_t k = 0; k < constants.size(); ++k) {
    sample.constants.push_back(constants[k].moved(fitted.theta[first + k], random.normal()));
  }
}

void resample(const ResamplingPlan& plan, std::uint64_t seed, std::uint64_t index,
              Observations& sample) {
  resample_constants(*plan.fitted, seed, index, sample);
  RandomStream random(seed, RandomPurpose::bootstrap, index);
  switch (plan.scheme) {
    case Scheme::parametric: {
      RandomStream of_shared(seed, RandomPurpose::settings, index);
      const FitResult& fitted = *plan.fitted;
      return resample_parametric(
          plan, draw_shared_errors(fitted.data, fitted.weights, fitted.noise_scale, of_shared),
          random, sample);
    }
    case Scheme::residual:
      return resample_residual(plan, random, sample);
    case Scheme::wild:
      return resample_wild(plan, random, sample);
    case Scheme::cases:
      return resample_cases(plan, random, sample);
    case Scheme::cluster:
      return resample_clusters(plan, random, sample);
    case Scheme::automatic:
      break;
  }
  assert(false && "a plan names its scheme");
}

std::vector<double> perturbation(const ResamplingPlan& plan, std::uint64_t seed,
                                 std::uint64_t index) {
  const std::size_t n = plan.fitted->data.points.size();
  std::vector<double> values(n, 0.0);
  if (plan.scheme == Scheme::cases || plan.scheme == Scheme::cluster) {
    // The same draws as in `resample_cases` and `resample_clusters`, counted.
    RandomStream random(seed, RandomPurpose::bootstrap, index);
    for (double& v : values) v = -1.0;
    for (std::size_t k = 0; k < plan.units(); ++k) {
      const std::size_t drawn = random.below(plan.units());
      if (plan.scheme == Scheme::cases) {
        values[drawn] += 1.0;
      } else {
        for (const std::size_t i : plan.clusters[drawn]) values[i] += 1.0;
      }
    }
    return values;
  }
  Observations sample;
  resample(plan, seed, index, sample);
  for (std::size_t i = 0; i < n; ++i) {
    if (sample.points[i].censored) continue;
    values[i] = (sample.points[i].restitution - plan.fitted->prediction[i]) /
                plan.fitted->weights.points[i].sd;
  }
  return values;
}

namespace {

/// Does the scheme allow unequal scatter that the covariance does not include?
bool uses_sandwich(Scheme scheme) {
  return scheme == Scheme::wild || scheme == Scheme::cases || scheme == Scheme::cluster;
}

/// The sandwich covariance: the part of the points from their residuals, the part of the constants
/// from their known errors.
std::vector<double> sandwich_of(const LeastSquaresResult& run, const Observations& data,
                                double constants_weight) {
  const std::vector<double> C = scaled_covariance(data, run.covariance, 1.0);
  const std::size_t p = run.theta.size();
  const std::size_t n = data.points.size();
  const std::span<const double> jacobian(run.jacobian);
  std::vector<double> covariance =
      sandwich_covariance(std::span(run.residuals).first(n), jacobian.first(n * p), C);
  std::vector<double> step(p);
  for (std::size_t k = n; k < run.residuals.size(); ++k) {
    for (std::size_t a = 0; a < p; ++a) {
      step[a] = 0.0;
      for (std::size_t b = 0; b < p; ++b) step[a] += C[a * p + b] * jacobian[k * p + b];
    }
    const double square = constants_weight * constants_weight;
    for (std::size_t a = 0; a < p; ++a) {
      for (std::size_t b = 0; b < p; ++b) covariance[a * p + b] += square * step[a] * step[b];
    }
  }
  return covariance;
}

}  // namespace

std::vector<double> replicate_covariance(const LeastSquaresResult& run, const Observations& data,
                                         const Weights& weights, const FitResult& fitted,
                                         const ResamplingPlan& plan) {
  if (run.covariance.empty()) return {};
  // If the noise is estimated, this run has estimated it again.
  const double scale = data.noise.sd_stated ? fitted.noise_scale : 1.0;
  std::vector<double> covariance = uses_sandwich(plan.scheme)
                                       ? sandwich_of(run, data, weights.noise.constants_weight)
                                       : scaled_covariance(data, run.covariance, scale);
  const auto added =
      event_spread_covariance(fitted.model, run.theta, data, weights, run.covariance);
  for (std::size_t k = 0; k < added.size(); ++k) covariance[k] += added[k];
  add_constant_effects(constant_effects(fitted.model, run, data.points.size()), covariance);
  return covariance;
}

std::vector<double> reference_covariance(const FitResult& fitted, const ResamplingPlan& plan) {
  if (!uses_sandwich(plan.scheme) || fitted.covariance.empty()) return fitted.covariance;
  const LeastSquaresProblem problem = impact_problem(fitted.model, fitted.data, fitted.weights);
  LeastSquaresResult at_fit;
  at_fit.theta = fitted.theta;
  at_fit.residuals.resize(problem.residual_count);
  at_fit.jacobian.resize(problem.residual_count * fitted.theta.size());
  if (!problem.evaluate(at_fit.theta, at_fit.residuals, at_fit.jacobian)) return fitted.covariance;
  at_fit.covariance = fitted.covariance;
  for (std::size_t k = 0; k < fitted.spread_covariance.size(); ++k) {
    at_fit.covariance[k] -= fitted.spread_covariance[k];
  }
  add_constant_effects(fitted.constant_effects, at_fit.covariance, -1.0);
  const double scaled = scaled_covariance(fitted.data, {1.0}, fitted.noise_scale).front();
  for (double& entry : at_fit.covariance) entry /= scaled;
  return replicate_covariance(at_fit, fitted.data, fitted.weights, fitted, plan);
}

std::vector<double> roots_of_diagonal(std::span<const double> covariance, std::size_t p) {
  std::vector<double> roots(p, 0.0);
  for (std::size_t j = 0; j < p && !covariance.empty(); ++j) {
    roots[j] = std::sqrt(covariance[j * p + j]);
  }
  return roots;
}

double logarithmic_error(const CaptureVelocity& capture, std::span<const double> covariance) {
  if (!capture.found || !(capture.value > 0.0) || covariance.empty()) return 0.0;
  const std::size_t p = capture.gradient.size();
  double variance = 0.0;
  for (std::size_t a = 0; a < p; ++a) {
    for (std::size_t b = 0; b < p; ++b) {
      variance += capture.gradient[a] * covariance[a * p + b] * capture.gradient[b];
    }
  }
  return variance > 0.0 ? std::sqrt(variance) / capture.value : 0.0;
}

}  // namespace recoil
