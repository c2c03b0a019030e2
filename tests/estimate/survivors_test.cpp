// The restitution of spheres that were not captured, against quadrature and closed forms.
#include <gsl/gsl_integration.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "estimate/residual.hpp"

namespace recoil {
namespace {

/// Integral over y > 0 of y^power phi(y - u), by GSL, with exp(-u^2/2) taken out for u < 0.
double moment(double u, double power) {
  struct Parameters {
    double u, power;
  } parameters{u, power};
  gsl_function f;
  f.params = &parameters;
  f.function = [](double t, void* raw) {  // y = t^2
    const auto& p = *static_cast<Parameters*>(raw);
    const double y = t * t;
    const double exponent = p.u > 0.0 ? -0.5 * (y - p.u) * (y - p.u) : y * p.u - 0.5 * y * y;
    return 2.0 * t * std::pow(y, p.power) * std::exp(exponent);
  };
  gsl_integration_workspace* space = gsl_integration_workspace_alloc(2000);
  double result = 0.0;
  double error = 0.0;
  const double peak = std::sqrt(std::max(u, 0.0));
  double sum = 0.0;
  gsl_integration_qag(&f, 0.0, peak + 1.0, 0.0, 1e-12, 2000, GSL_INTEG_GAUSS61, space, &result,
                      &error);
  sum += result;
  gsl_integration_qag(&f, peak + 1.0, peak + 8.0, 1e-300, 1e-10, 2000, GSL_INTEG_GAUSS61, space,
                      &result, &error);
  gsl_integration_workspace_free(space);
  return sum + result;
}

TEST(Survivors, MeanAndVarianceAreThoseOfTheTruncatedNormal) {
  for (const double u : {-60.0, -9.0, -3.0, -0.5, 0.0, 0.7, 2.0, 5.0, 11.9, 12.1, 25.0}) {
    const double norm = moment(u, 0.0);
    const double mean = moment(u, 0.5) / norm;
    const RootMoments root = root_of_positive_normal(u);
    EXPECT_NEAR(root.mean / mean, 1.0, 1e-9) << u;
    const double variance = moment(u, 1.0) / norm - mean * mean;
    EXPECT_NEAR(root.variance / variance, 1.0, 1e-6) << u;
  }
}

TEST(Survivors, HalfNormalAtTheCaptureVelocity) {
  // E sqrt|z| = 2^(1/4) Gamma(3/4) / sqrt(pi), E|z| = sqrt(2 / pi).
  const double mean = std::pow(2.0, 0.25) * std::tgamma(0.75) / std::sqrt(std::numbers::pi);
  const RootMoments root = root_of_positive_normal(0.0);
  EXPECT_NEAR(root.mean, mean, 1e-12);
  EXPECT_NEAR(root.variance, std::sqrt(2.0 / std::numbers::pi) - mean * mean, 1e-12);
}

TEST(Survivors, FarBelowCaptureTheyAreExponential) {
  // u + z given u + z > 0 tends to an exponential of rate |u|: E sqrt = Gamma(3/2) / sqrt|u|.
  EXPECT_NEAR(root_of_positive_normal(-300.0).mean * std::sqrt(300.0), std::tgamma(1.5), 1e-4);
}

TEST(Survivors, SlopeMatchesDifferences) {
  for (const double u : {-40.0, -2.0, 0.3, 6.0, 11.999, 12.001, 30.0}) {
    constexpr double h = 1e-4;
    const double difference =
        (root_of_positive_normal(u + h).mean - root_of_positive_normal(u - h).mean) / (2.0 * h);
    EXPECT_NEAR(root_of_positive_normal(u).slope / difference, 1.0, 1e-6) << u;
  }
}

}  // namespace
}  // namespace recoil
