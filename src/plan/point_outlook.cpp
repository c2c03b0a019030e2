#include "plan/point_outlook.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_sf_erf.h>

#include <algorithm>
#include <cmath>

#include "core/gsl_errors.hpp"
#include "estimate/survivors.hpp"

namespace recoil {
namespace {

constexpr double near_capture = 30.0;  // in units of the scatter of e^2: see `renew_weights`
constexpr double far_out = 35.0;       // standard deviations, where phi is 0

/// phi^2 / (Phi(z) Phi(-z)): what a yes or no tells of z.
double information_of_a_count(double z) {
  if (std::abs(z) > far_out) return 0.0;
  return gsl_sf_hazard(z) * gsl_sf_hazard(-z);
}

/// What a normal deviate of mean z tells of z where it is seen above 0 only.
double information_of_censored(double z) {
  if (z > far_out) return 1.0;
  if (z < -far_out) return 0.0;
  const double density = gsl_ran_ugaussian_pdf(z);
  return gsl_cdf_ugaussian_P(z) - z * density + density * gsl_sf_hazard(z);
}

PointOutlook where_some_are_captured(double m, double s, double tau, const PlannedScatter& by) {
  const double n = by.events;
  const double shared = s * s + tau * tau;
  const double weight = (1.0 + (n - 1.0) * s * s / shared) / n;
  PointOutlook found;
  found.information = weight * n * information_of_a_count(m / std::sqrt(shared)) / shared;
  const double u = m / s;
  const double rebounds = n * gsl_cdf_ugaussian_P(u);
  found.captured = gsl_cdf_ugaussian_Q(u);
  const RootMoments root = root_of_positive_normal(u);
  found.restitution = std::sqrt(s) * root.mean;
  const double own = std::hypot(by.scatter * found.restitution, by.floor);
  if (rebounds < 0.5) return found;
  const double variance = (own * own + s * root.variance) / rebounds;
  found.sd = std::sqrt(variance);
  const double slope = root.slope / std::sqrt(s);
  found.information += slope * slope / (variance + slope * slope * tau * tau);
  return found;
}

}  // namespace

PointOutlook point_outlook(double m, double m_V, double m_d, const PlannedScatter& by) {
  gsl_errors_are_values();
  const double shared = by.rebound_measured ? 2.0 * std::max(m, 0.0) : 0.0;
  const double tau = std::hypot((m_V + shared) * by.velocity_error, m_d * by.diameter_error);
  const double s = by.spread * std::abs(m_V);
  if (s > 0.0 && m < near_capture * s) return where_some_are_captured(m, s, tau, by);
  PointOutlook found;
  found.restitution = std::sqrt(std::max(m, 0.0));
  found.captured = m > 0.0 ? 0.0 : 1.0;
  const double own = std::hypot(by.scatter * found.restitution, by.floor);
  const double spread = s > 0.0 ? 0.5 * s / found.restitution : 0.0;  // m is above 30 s
  const double variance = (own * own + spread * spread) / by.events;
  if (m > 0.0) found.sd = std::sqrt(variance);
  // 4 psi^2, psi that of `weighted_residual`; for m far below zero the sum cancels.
  const double hypotenuse = std::hypot(m, variance);
  const double four_psi_squared =
      m >= 0.0 ? 2.0 * (m + hypotenuse) : 2.0 * variance * variance / (hypotenuse - m);
  const double width = std::sqrt(variance * (four_psi_squared + 2.0 * variance) + tau * tau);
  found.information = information_of_censored(m / width) / (width * width);
  return found;
}

}  // namespace recoil
