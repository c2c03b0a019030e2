#include "estimate/likelihood.hpp"

#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "estimate/residual.hpp"
#include "estimate/shared_errors.hpp"

namespace recoil {

double log_peak_density(const Observation& point, const PointWeights& weights,
                        double restitution_squared, const std::optional<StudentNoise>& student) {
  double ln = weights.peaks(point) ? -0.5 * weights.peak.deviance : 0.0;
  if (point.censored) return ln;
  ln += std::log(student ? gsl_ran_tdist_pdf(0.0, student->dof) : gsl_ran_ugaussian_pdf(0.0));
  if (weights.peaks(point)) return ln - std::log(weights.mean_sd);
  const WeightedResidual r = weighted_residual(point, weights, restitution_squared);
  return ln + std::log(slope_in_restitution(r, restitution_squared));
}

std::optional<double> minus_two_log_likelihood(const FitResult& fitted) {
  const auto& points = fitted.data.points;
  const std::optional<StudentNoise>& student = fitted.data.noise.student;
  const auto& moved = fitted.constants_moved;
  const double constants = std::inner_product(moved.begin(), moved.end(), moved.begin(), 0.0);
  const double weight = fitted.weights.noise.constants_weight;
  double sum = fitted.objective - weight * weight * constants;
  if (student) sum /= student->calibration();
  sum += constants + SharedErrors(fitted.data, fitted.weights).log_determinant();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Observation& point = points[i];
    const PointWeights& weights = fitted.weights.points[i];
    if (student && (point.censored || weights.peaks(point))) return std::nullopt;
    const double predicted = fitted.prediction_squared[i];
    // A rebound of a sphere that the model captures has no slope at the prediction.
    const double at = predicted > 0.0 ? predicted : point.restitution * point.restitution;
    sum -= 2.0 * log_peak_density(point, weights, at, student);
  }
  return sum;
}

}  // namespace recoil
