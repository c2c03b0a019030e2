// -2 ln likelihood against densities written out here.
#include "estimate/likelihood.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

constexpr double restitution_spread = 0.01;

/// V [m/s] and e of 60 impacts under C_H = 0.003, C_A = 0.03 s/m, with normal noise of 0.01.
constexpr std::array<std::pair<double, double>, 60> bounces = {
    {{1.6, 0.82328},     {1.66998, 0.78661}, {1.74302, 0.82482}, {1.81926, 0.82270},
     {1.89883, 0.83093}, {1.98189, 0.83978}, {2.06857, 0.82768}, {2.15905, 0.85100},
     {2.25348, 0.84966}, {2.35204, 0.89612}, {2.45492, 0.86935}, {2.56229, 0.86742},
     {2.67436, 0.87167}, {2.79134, 0.87105}, {2.91342, 0.87016}, {3.04085, 0.87954},
     {3.17386, 0.89076}, {3.31267, 0.88585}, {3.45757, 0.89990}, {3.60879, 0.89024},
     {3.76664, 0.89421}, {3.93139, 0.91101}, {4.10334, 0.90243}, {4.28281, 0.89321},
     {4.47014, 0.89759}, {4.66565, 0.90585}, {4.86972, 0.92071}, {5.08271, 0.89946},
     {5.30503, 0.90042}, {5.53706, 0.91347}, {5.77924, 0.89508}, {6.03202, 0.90144},
     {6.29585, 0.91350}, {6.57122, 0.91071}, {6.85863, 0.90597}, {7.15862, 0.91183},
     {7.47173, 0.87685}, {7.79853, 0.91526}, {8.13963, 0.89530}, {8.49564, 0.88799},
     {8.86723, 0.90714}, {9.25507, 0.91102}, {9.65987, 0.89914}, {10.0824, 0.89232},
     {10.5234, 0.90278}, {10.9836, 0.90136}, {11.464, 0.91525},  {11.9655, 0.90790},
     {12.4888, 0.90154}, {13.0351, 0.90982}, {13.6052, 0.89569}, {14.2003, 0.88746},
     {14.8214, 0.90146}, {15.4696, 0.90028}, {16.1462, 0.89107}, {16.8525, 0.88409},
     {17.5896, 0.89284}, {18.3589, 0.86416}, {19.1619, 0.89449}, {20, 0.89091}}};

FitResult fit_with(const std::string& noise) {
  Dataset data;
  data.id = "d";
  data.system.particle = {"polystyrene", 1050.0, 2.78e9, 0.33, std::nullopt};
  data.system.surface = {"silicon", 2330.0, 1.29e11, 0.28, std::nullopt};
  data.series = {"one"};
  for (const auto& [velocity, e] : bounces) {
    ImpactPoint point;
    point.diameter = 4.9e-6;
    point.incident_velocity = velocity;
    point.restitution = e;
    point.restitution_sd = restitution_spread;
    data.points.push_back(point);
  }
  const FitSpec spec = parse_fit("dataset = \"d\"\n" + noise + "[uncertainty]\nmaterials = false\n",
                                 "fits/fit.toml");
  return fit(make_model(spec, {data}), gather({data}, spec));
}

/// -2 ln of the product of the densities `density` of (e - e_model) / restitution_spread, in units
/// of e.
template <class Density>
double by_hand(const FitResult& fitted, const Density& density) {
  double sum = 0.0;
  for (std::size_t i = 0; i < bounces.size(); ++i) {
    sum -= 2.0 * std::log(density((bounces[i].second - fitted.prediction[i]) / restitution_spread) /
                          restitution_spread);
  }
  return sum;
}

// The residuals of a fit are those of e^2, which changes the sums by about (restitution_spread /
// e)^2 per point.
constexpr double tolerance = 60 * 1.6e-4;

TEST(Likelihood, OfNormalResiduals) {
  const FitResult fitted = fit_with("");
  ASSERT_TRUE(fitted.usable);
  const double expected =
      by_hand(fitted, [](double r) { return std::exp(-0.5 * r * r) / std::sqrt(2.0 * pi); });
  EXPECT_NEAR(minus_two_log_likelihood(fitted).value(), expected, tolerance);
}

TEST(Likelihood, OfStudentResiduals) {
  const FitResult fitted = fit_with("[noise]\nresiduals = \"student\"\n");
  ASSERT_TRUE(fitted.usable);
  const double expected = by_hand(fitted, [](double t) {  // 4 degrees of freedom
    return std::tgamma(2.5) / (std::tgamma(2.0) * std::sqrt(4.0 * pi)) *
           std::pow(1.0 + t * t / 4.0, -2.5);
  });
  EXPECT_NEAR(minus_two_log_likelihood(fitted).value(), expected, tolerance);
}

TEST(Likelihood, CannotBeComparedByTheCalibratedStatistic) {
  // The sums in units of the standard deviation were computed elsewhere from such residuals.
  const double of_sd = -2.0 * 60.0 * std::log(1.0 / restitution_spread);
  const FitResult normal = fit_with("");
  const FitResult student = fit_with("[noise]\nresiduals = \"student\"\n");
  EXPECT_NEAR(minus_two_log_likelihood(normal).value() - of_sd, 178.95, 0.02);
  EXPECT_NEAR(minus_two_log_likelihood(student).value() - of_sd, 176.69, 0.02);
  EXPECT_GT(student.chi2, normal.chi2);  // the calibrated statistic has the other sign
}

TEST(Likelihood, IsNotDefinedForCapturesUnderStudentsT) {
  FitResult fitted = fit_with("[noise]\nresiduals = \"student\"\n");
  fitted.data.points.front().censored = true;
  EXPECT_FALSE(minus_two_log_likelihood(fitted));
}

}  // namespace
}  // namespace recoil
