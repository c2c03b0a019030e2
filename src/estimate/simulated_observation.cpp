#include "estimate/simulated_observation.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>

#include "core/numerics.hpp"
#include "estimate/residual.hpp"

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

Observation redraw_captures(const Observation& point, double restitution_squared, double uniform) {
  const double u = (restitution_squared + point.weights.shift) / point.weights.scatter;
  Observation drawn = point;
  // Where nobody counted captures there is a mean of rebounds and nothing else to draw.
  drawn.captured =
      point.counted ? binomial_quantile(uniform, gsl_cdf_ugaussian_Q(u), point.events) : 0;
  drawn.censored = point.counts_only() || drawn.rebounds() == 0;
  drawn.weights.sd =
      point.event_sd() /
      std::sqrt(static_cast<double>(drawn.censored ? drawn.events : drawn.rebounds()));
  return drawn;
}

Observation simulate_observation(const Observation& point, double restitution_squared,
                                 double noise_scale, const std::optional<StudentNoise>& student,
                                 RandomStream& random) {
  const double common = point.weights.input_sd * random.normal();
  const double uniform = random.uniform();
  const double normal = random.normal();
  const double noise =
      noise_scale *
      (student ? student->core * gsl_cdf_tdist_Pinv(gsl_cdf_ugaussian_P(normal), student->dof)
               : normal);
  const double m = restitution_squared + common;
  Observation drawn = point;
  if (!(point.weights.scatter > 0.0)) {
    if (!point.censored) {
      drawn.restitution = std::max(0.0, std::sqrt(std::max(m, 0.0)) + point.weights.sd * noise);
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
