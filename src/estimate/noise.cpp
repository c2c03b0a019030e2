#include "estimate/noise.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/gsl_errors.hpp"
#include "estimate/survivors.hpp"

namespace recoil {
namespace {

/// The smallest k with P(captured <= k) >= `uniform` among `n` impacts.
int binomial_quantile(double uniform, double p, int n) {
  gsl_errors_are_values();
  int below = -1;
  int reached = n;
  while (reached - below > 1) {
    const int middle = below + (reached - below) / 2;
    const bool enough =
        gsl_cdf_binomial_P(static_cast<unsigned>(middle), p, static_cast<unsigned>(n)) >= uniform;
    (enough ? reached : below) = middle;
  }
  return reached;
}

}  // namespace

double Misfit::scale() const { return dof > 0 ? std::sqrt(square / dof) : 1.0; }

Misfit misfit(const Observations& data, std::span<const double> residuals,
              std::span<const double> predicted, int free_count) {
  Misfit result;
  const StudentNoise* student = nullptr;
  int informative = 0;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    student = point.student ? &*point.student : nullptr;
    if (!data.sd_stated && point.censored) continue;
    // A captured point that the model captures has no residual to speak of, whatever the
    // parameters: it fixes a side, not a value, and is no degree of freedom of the noise.
    if (!point.censored || predicted[i] > 0.0) ++informative;
    double r = student ? student->original(residuals[i]) : residuals[i];
    if (!data.sd_stated && point.scatter > 0.0) {
      r = (point.restitution - expected_restitution(point, predicted[i])) / point.mean_sd;
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
  if (!data.points.empty() && data.points.front().student) {
    factor *= data.points.front().student->covariance_factor();
  }
  std::vector<double> covariance = inverse_information;
  for (double& entry : covariance) entry *= factor;
  return covariance;
}

Observation redraw_captures(const Observation& point, double restitution_squared, double uniform) {
  const double u = (restitution_squared + point.shift) / point.scatter;
  Observation drawn = point;
  // Where nobody counted captures there is a mean of rebounds and nothing else to draw.
  drawn.captured =
      point.counted ? binomial_quantile(uniform, gsl_cdf_ugaussian_Q(u), point.events) : 0;
  drawn.censored = drawn.rebounds() == 0;
  drawn.sd = point.event_sd() /
             std::sqrt(static_cast<double>(drawn.censored ? drawn.events : drawn.rebounds()));
  return drawn;
}

Observation simulate_observation(const Observation& point, double restitution_squared,
                                 double noise_scale, RandomStream& random) {
  const double common = point.input_sd * random.normal();
  const double uniform = random.uniform();
  const double normal = random.normal();
  const double noise =
      noise_scale * (point.student
                         ? point.student->core *
                               gsl_cdf_tdist_Pinv(gsl_cdf_ugaussian_P(normal), point.student->dof)
                         : normal);
  const double m = restitution_squared + common;
  Observation drawn = point;
  if (!(point.scatter > 0.0)) {
    if (!point.censored) {
      drawn.restitution = std::max(0.0, std::sqrt(std::max(m, 0.0)) + point.sd * noise);
    }
    return drawn;
  }
  drawn = redraw_captures(point, m, uniform);
  drawn.restitution =
      drawn.censored
          ? 0.0
          : std::max(0.0, expected_restitution(drawn, m) + survivors_sd(drawn, m) * noise);
  return drawn;
}

}  // namespace recoil
