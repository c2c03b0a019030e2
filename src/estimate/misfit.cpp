#include "estimate/misfit.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "estimate/residual.hpp"

namespace recoil {

std::vector<std::vector<double>> constant_effects(const ImpactModel& model,
                                                  const LeastSquaresResult& run,
                                                  std::size_t points) {
  std::vector<std::vector<double>> effects;
  if (model.adjusts_constants() || run.covariance.empty()) return effects;
  const std::size_t p = run.theta.size();
  for (std::size_t k = 0; k < model.constants.size(); ++k) {
    const std::size_t own = model.first_constant() + k;
    const double sd = 1.0 / model.constants[k].deviation_slope(run.theta[own]);
    std::vector<double> pull(p, 0.0);  // J'J_c
    for (std::size_t i = 0; i < points; ++i) {
      const double* row = &run.jacobian[i * p];
      for (std::size_t j = 0; j < p; ++j) pull[j] += row[j] * row[own];
    }
    std::vector<double> effect(p, 0.0);
    for (std::size_t a = 0; a < p; ++a) {
      for (std::size_t b = 0; b < p; ++b) effect[a] -= run.covariance[a * p + b] * pull[b] * sd;
    }
    effect[own] = sd;
    effects.push_back(std::move(effect));
  }
  return effects;
}

void add_constant_effects(const std::vector<std::vector<double>>& effects,
                          std::vector<double>& covariance, double sign) {
  for (const std::vector<double>& effect : effects) {
    const std::size_t p = effect.size();
    for (std::size_t a = 0; a < p && !covariance.empty(); ++a) {
      for (std::size_t b = 0; b < p; ++b) covariance[a * p + b] += sign * effect[a] * effect[b];
    }
  }
}

double Misfit::scale() const {
  if (dof <= 0) return 1.0;
  // Lower limit of the divisor, for few points whose information mostly determines the constants.
  const double left = std::max(expected - learned, 0.25 * expected);
  return std::sqrt(point_square / left);
}

ConstantsInFit constants_in_fit(const LeastSquaresResult& run, std::size_t count, double weight) {
  ConstantsInFit constants;
  const std::size_t n = run.residuals.size() - count;
  const std::size_t p = run.theta.size();
  for (std::size_t k = n; k < run.residuals.size(); ++k) {
    constants.square += std::pow(run.residuals[k] / weight, 2);
  }
  if (run.covariance.empty() || count == 0) return constants;
  constants.learned = static_cast<double>(count);
  for (const double h : leverages(std::span(run.jacobian).subspan(n * p), run.covariance)) {
    constants.learned -= h;
  }
  constants.learned = std::max(0.0, constants.learned);
  return constants;
}

Misfit misfit(const Observations& data, const Weights& weights, std::span<const double> residuals,
              std::span<const double> predicted, int free_count, const ConstantsInFit& constants) {
  Misfit result;
  const std::optional<StudentNoise>& student = data.noise.student;
  std::vector<double> plain;  // residuals before the transformation to Student's t
  int informative = 0;
  const bool counts =
      data.noise.sd_stated && std::ranges::any_of(data.points, &Observation::counts_only);
  double of_counts = 0.0, variance_of_counts = 0.0;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    if (!data.noise.sd_stated && point.censored) continue;
    // A captured point that the model also captures has a residual near zero for any parameters: it
    // determines a sign, not a value, and is no degree of freedom of the noise.
    const PointWeights& own = weights.points[i];
    if (counts && point.censored && own.scatter > 0.0) {
      const CountMoments moments = count_moments(point, own, predicted[i]);
      of_counts += moments.mean;
      variance_of_counts += moments.variance;
    } else if (point.informs(predicted[i])) {
      ++informative;
    }
    double r = student ? student->original(residuals[i]) : residuals[i];
    if (!data.noise.sd_stated && own.scatter > 0.0) {
      r = (point.restitution - expected_restitution(point, own, predicted[i])) / own.mean_sd;
    }
    if (student) {
      plain.push_back(r);
      r = student->psi(r);
    }
    result.square += r * r;
  }
  if (student) result.square /= student->mean_square;
  result.point_square = result.square;
  result.learned = constants.learned;
  if (data.noise.sd_stated) result.square += constants.square;
  const int estimated = free_count + (counts ? 1 : 0);
  result.expected = informative + of_counts - estimated;
  result.dof = static_cast<int>(std::lround(result.expected));
  if (result.dof <= 0) return result;
  const int pooled = weights.noise.pooled_dof;
  if (student) {
    result.p_value = student->p_value(plain, result.dof);
  } else if (pooled > 0) {
    result.p_value = gsl_cdf_fdist_Q(result.square / result.dof, result.dof, pooled);
  } else if (counts) {
    const double variance = variance_of_counts + 2.0 * (informative - estimated);
    const double unit = std::max(variance, result.expected) / (2.0 * result.expected);
    result.p_value = gsl_cdf_chisq_Q(result.square / unit, result.expected / unit);
  } else {
    result.p_value = gsl_cdf_chisq_Q(result.square, result.dof);
  }
  return result;
}

std::vector<double> scaled_covariance(const Observations& data,
                                      const std::vector<double>& inverse_information,
                                      double noise_scale) {
  double factor = noise_scale * noise_scale;
  if (data.noise.student) factor *= data.noise.student->covariance_factor();
  std::vector<double> covariance = inverse_information;
  for (double& entry : covariance) entry *= factor;
  return covariance;
}

}  // namespace recoil
