#include "estimate/misfit.hpp"

#include <gsl/gsl_cdf.h>

#include <cmath>

#include "estimate/residual.hpp"

namespace recoil {

double Misfit::scale() const { return dof > 0 ? std::sqrt(square / dof) : 1.0; }

Misfit misfit(const Observations& data, std::span<const double> residuals,
              std::span<const double> predicted, int free_count) {
  Misfit result;
  const std::optional<StudentNoise>& student = data.noise.student;
  int informative = 0;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    if (!data.sd_stated && point.censored) continue;
    // A captured point that the model captures has no residual to speak of, whatever the
    // parameters: it fixes a side, not a value, and is no degree of freedom of the noise.
    if (!point.censored || predicted[i] > 0.0) ++informative;
    double r = student ? student->original(residuals[i]) : residuals[i];
    if (!data.sd_stated && point.weights.scatter > 0.0) {
      r = (point.restitution - expected_restitution(point, predicted[i])) / point.weights.mean_sd;
    }
    if (student) r = student->psi(r);
    result.square += r * r;
  }
  if (student) result.square /= student->mean_square;
  result.dof = informative - free_count;
  if (result.dof <= 0) return result;
  // psi^2 scatters less than the square of a normal: a chi-squared with more degrees of freedom,
  // scaled to the same mean and variance (Satterthwaite).
  const double ratio = student ? 2.0 / student->square_spread : 1.0;
  result.p_value = gsl_cdf_chisq_Q(result.square * ratio, result.dof * ratio);
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
