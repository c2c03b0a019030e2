#include "uncertainty/replicate_errors.hpp"

#include <cmath>
#include <span>

#include "estimate/capture_velocity.hpp"
#include "estimate/constant_effects.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/misfit.hpp"
#include "estimate/weights.hpp"
#include "uncertainty/intervals.hpp"

namespace recoil {
namespace {

/// Do the points scatter unequally in a way that the covariance does not know of?
bool uses_sandwich(Scheme scheme) {
  return scheme == Scheme::wild || scheme == Scheme::cases || scheme == Scheme::cluster;
}

/// That of the points from their residuals, that of the constants from their errors, which are
/// known.
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
  // Where the noise is estimated, it was so again with the parameters of this run.
  const double scale = data.sd_stated ? fitted.noise_scale : 1.0;
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
