#include "uncertainty/resample.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <span>

#include "estimate/capture_velocity.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/misfit.hpp"
#include "estimate/residual.hpp"
#include "estimate/reweighting.hpp"
#include "estimate/shared_settings.hpp"
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
    if (point.weights.scatter > 0.0) {
      const double expected = expected_restitution(point, fitted.prediction_squared[i]);
      scaled[i] = (point.restitution - expected) / point.weights.mean_sd;
      continue;
    }
    const double h = std::min(fitted.leverage[i], most_leverage);
    // The residual before whitening includes the error that its setting shares.
    const double residual = fitted.data.noise.shares_errors()
                                ? weighted_residual(point, fitted.prediction_squared[i]).value
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

/// The groups of points that may depend on each other: one per series, or one per setting.
std::vector<std::vector<std::size_t>> clusters_of(const Observations& data) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> found;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    const bool by_setting = data.noise.shares_settings() && !data.noise.series_diameter_stated;
    found[by_setting ? std::pair(std::size_t{0}, point.setting)
                     : std::pair(point.dataset, point.series)]
        .push_back(i);
  }
  std::vector<std::vector<std::size_t>> clusters;
  for (auto& [key, points] : found) clusters.push_back(std::move(points));
  return clusters;
}

/// Sets point i of the sample to its predicted value plus `noise` standard deviations; with scatter
/// from impact to impact, its captures are redrawn.
void disturb(const ResamplingPlan& plan, std::size_t i, double noise, RandomStream& random,
             Observations& sample) {
  Observation& point = sample.points[i];
  if (point.weights.scatter > 0.0 && point.counted) {
    const double m = plan.fitted->prediction_squared[i];
    point = redraw_captures(point, m, random.uniform());
    point.restitution =
        point.censored
            ? 0.0
            : std::max(0.0, expected_restitution(point, m) + survivors_sd(point, m) * noise);
    return;
  }
  if (point.censored) return;
  const double expected = expected_restitution(point, plan.fitted->prediction_squared[i]);
  point.restitution = std::max(0.0, expected + point.weights.sd * noise);
}

}  // namespace

std::size_t ResamplingPlan::units() const {
  return scheme == Scheme::cluster ? clusters.size() : fitted->data.points.size();
}

std::optional<SchemeObstacle> scheme_obstacle(Scheme scheme, const Observations& data) {
  const bool all_captured = std::all_of(data.points.begin(), data.points.end(),
                                        [](const Observation& point) { return point.censored; });
  if ((scheme == Scheme::residual || scheme == Scheme::wild) && all_captured) {
    return SchemeObstacle::no_residuals;
  }
  if ((scheme == Scheme::residual || scheme == Scheme::cases) &&
      (data.noise.setting_sd > 0.0 || data.noise.setting_velocity_stated)) {
    return SchemeObstacle::shared_settings;
  }
  if ((scheme == Scheme::residual || scheme == Scheme::wild || scheme == Scheme::cases) &&
      data.noise.series_diameter_stated) {
    return SchemeObstacle::shared_sizes;
  }
  if ((scheme == Scheme::residual || scheme == Scheme::wild || scheme == Scheme::cases) &&
      data.noise.shares_instants) {
    return SchemeObstacle::shared_instants;
  }
  if (scheme == Scheme::cluster && clusters_of(data).size() < 2) {
    return SchemeObstacle::single_series;
  }
  return std::nullopt;
}

std::string obstacle_words(SchemeObstacle obstacle) {
  switch (obstacle) {
    case SchemeObstacle::no_residuals:
      return "no point rebounded: there are no residuals to draw from";
    case SchemeObstacle::single_series:
      return "all points belong to one series: there is nothing to exchange";
    case SchemeObstacle::shared_settings:
      return "points of one setting share an error: single points cannot be exchanged, whole "
             "settings can (cluster)";
    case SchemeObstacle::shared_instants:
      return "successive bounces of one launch share instants: single points cannot be exchanged, "
             "whole series can (cluster)";
    case SchemeObstacle::shared_sizes:
      return "points of one series share an error of their diameter: single points cannot be "
             "exchanged, whole series can (cluster)";
  }
  return "";
}

ResamplingPlan plan_resampling(const FitResult& fitted, Scheme asked) {
  const Observations& data = fitted.data;
  ResamplingPlan plan;
  plan.fitted = &fitted;
  plan.scheme = asked;
  if (asked == Scheme::automatic) {
    const bool residuals = !scheme_obstacle(Scheme::wild, data);
    plan.scheme = data.noise.sd_stated || !residuals ? Scheme::parametric : Scheme::wild;
    plan.because = data.noise.sd_stated                ? SchemeBecause::sd_stated
                   : residuals                         ? SchemeBecause::sd_not_stated
                   : data.noise.series_diameter_stated ? SchemeBecause::shared_sizes
                                                       : SchemeBecause::no_residuals;
  }
  if (plan.scheme == Scheme::residual) plan.residuals = residual_pool(fitted);
  if (plan.scheme == Scheme::wild) plan.residuals = scaled_residuals(fitted, 1.0);
  if (plan.scheme == Scheme::cluster) plan.clusters = clusters_of(data);
  return plan;
}

void resample_parametric(const ResamplingPlan& plan, std::span<const double> setting_errors,
                         RandomStream& random, Observations& sample) {
  // If constants are redrawn, the simulated noise is added to the measured values, which follow the
  // true constants, not to the curve of the stated ones.
  const ImpactModel& model = plan.fitted->model;
  const bool other_constants = !model.constants.empty() && !model.adjusts_constants();
  sample.points = plan.fitted->data.points;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    sample.points[i] =
        simulate_observation(plan.fitted->data.points[i],
                             shifted_square(plan.fitted->prediction_squared[i], setting_errors[i]),
                             own_noise_scale(plan.fitted->data.points[i], plan.fitted->noise_scale),
                             plan.fitted->data.noise.student, random);
    if (!other_constants || !plan.fitted->data.noise.sd_stated) continue;
    const Observation& measured = plan.fitted->data.points[i];
    Observation& point = sample.points[i];
    if (measured.censored || point.censored) continue;
    point.restitution =
        std::max(0.0, point.restitution + measured.restitution -
                          expected_restitution(measured, plan.fitted->prediction_squared[i]));
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
  std::map<std::size_t, double> sign_of;  // sign of each setting, if its points share an error
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    const std::size_t unit =
        plan.fitted->data.noise.shares_settings() ? sample.points[i].setting : i;
    const auto [sign, is_new] = sign_of.try_emplace(unit, 1.0);
    if (is_new && random.uniform() < 0.5) sign->second = -1.0;
    disturb(plan, i, sign->second * plan.residuals[i], random, sample);
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
  // New number of each (draw, setting).
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> again;
  // New number of each (draw, launch).
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> launches;
  for (std::size_t k = 0; k < plan.clusters.size(); ++k) {
    for (const std::size_t i : plan.clusters[random.below(plan.clusters.size())]) {
      Observation& point = sample.points.emplace_back(plan.fitted->data.points[i]);
      // A setting that is drawn twice becomes two settings.
      point.setting = again.try_emplace({k, point.setting}, again.size()).first->second;
      if (point.launch == Observation::no_launch) continue;
      point.launch = launches.try_emplace({k, point.launch}, launches.size()).first->second;
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

std::vector<double> setting_errors_of(const ResamplingPlan& plan, std::uint64_t seed,
                                      std::uint64_t index) {
  RandomStream random(seed, RandomPurpose::settings, index);
  return draw_setting_errors(plan.fitted->data, plan.fitted->noise_scale, random);
}

void resample(const ResamplingPlan& plan, std::uint64_t seed, std::uint64_t index,
              Observations& sample) {
  resample_constants(*plan.fitted, seed, index, sample);
  RandomStream random(seed, RandomPurpose::bootstrap, index);
  switch (plan.scheme) {
    case Scheme::parametric:
      return resample_parametric(plan, setting_errors_of(plan, seed, index), random, sample);
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

std::vector<double> disturbance(const ResamplingPlan& plan, std::uint64_t seed,
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
    values[i] =
        (sample.points[i].restitution - plan.fitted->prediction[i]) / sample.points[i].weights.sd;
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
std::vector<double> sandwich_of(const LeastSquaresResult& run, const Observations& data) {
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
    const double square = data.constants_weight * data.constants_weight;
    for (std::size_t a = 0; a < p; ++a) {
      for (std::size_t b = 0; b < p; ++b) covariance[a * p + b] += square * step[a] * step[b];
    }
  }
  return covariance;
}

}  // namespace

std::vector<double> replicate_covariance(const LeastSquaresResult& run, const Observations& data,
                                         const FitResult& fitted, const ResamplingPlan& plan) {
  if (run.covariance.empty()) return {};
  // If the noise is estimated, this run has estimated it again.
  const double scale = data.noise.sd_stated ? fitted.noise_scale : 1.0;
  std::vector<double> covariance = uses_sandwich(plan.scheme)
                                       ? sandwich_of(run, data)
                                       : scaled_covariance(data, run.covariance, scale);
  const auto added = event_spread_covariance(fitted.model, run.theta, data, run.covariance);
  for (std::size_t k = 0; k < added.size(); ++k) covariance[k] += added[k];
  add_constant_effects(constant_effects(fitted.model, run, data.points.size()), covariance);
  return covariance;
}

std::vector<double> reference_covariance(const FitResult& fitted, const ResamplingPlan& plan) {
  if (!uses_sandwich(plan.scheme) || fitted.covariance.empty()) return fitted.covariance;
  const LeastSquaresProblem problem = impact_problem(fitted.model, plan.fitted->data);
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
  const double scaled = scaled_covariance(plan.fitted->data, {1.0}, fitted.noise_scale).front();
  for (double& entry : at_fit.covariance) entry /= scaled;
  return replicate_covariance(at_fit, plan.fitted->data, fitted, plan);
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
