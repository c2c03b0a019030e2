// Fits under another law of adhesion than the ring's, to impacts of an integrator of their own.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/fit.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/predictor.hpp"
#include "estimate/two_point.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

/// Ammonium fluorescein on molybdenum as in tests/support/synthetic.hpp, by time steps of the
/// classical Runge-Kutta method on m n'' = -P(n, n').
struct SteppedTruth {
  AdhesionLaw law = AdhesionLaw::jkr;
  double W = 0.1, C_H = 3e-3, C_A = 0.05;
  double density = 1350.0, K = 1.789e9;

  /// e [1], 0 for a capture.
  double restitution(double diameter, double velocity) const {
    const double r = diameter / 2.0;
    const double m = density * pi / 6.0 * std::pow(diameter, 3);
    const double parts_radius = std::cbrt(pi * W * r * r / (6.0 * K));  // dn / da = 0
    const auto approach = [&](double a) {
      return a * a / r - std::sqrt(8.0 * pi * W * a / (3.0 * K));
    };
    double radius = std::cbrt(8.0 * pi * W * r * r / (3.0 * K));  // n = 0
    const double end = law == AdhesionLaw::jkr ? approach(parts_radius) : 0.0;
    const auto acceleration = [&](double n, double v) {
      double elastic = K * std::sqrt(r) * std::pow(std::max(n, 0.0), 1.5);
      double adhesive = 2.0 * pi * W * r;
      if (law == AdhesionLaw::jkr) {
        double low = parts_radius, high = std::max(2.0 * radius, 4.0 * parts_radius);
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (low + high);
          (approach(middle) < n ? low : high) = middle;
        }
        radius = low;
        elastic = K * std::pow(radius, 3) / r;
        adhesive = std::sqrt(6.0 * pi * W * K * std::pow(radius, 3));
      }
      const double outward = v < 0.0 ? -v : 0.0;
      return -(elastic * (1.0 + C_H * v) - adhesive * (1.0 + C_A * outward)) / m;
    };
    const double scale = std::pow(m * velocity * velocity / (K * std::sqrt(r)), 0.4);
    const double dt = scale / velocity / 3000.0;
    double n = 0.0, v = velocity;
    for (int step = 0; step < 60000; ++step) {
      const double k1 = acceleration(n, v);
      const double k2 = acceleration(n + 0.5 * dt * v, v + 0.5 * dt * k1);
      const double k3 = acceleration(n + 0.5 * dt * (v + 0.5 * dt * k1), v + 0.5 * dt * k2);
      const double k4 = acceleration(n + dt * (v + 0.5 * dt * k2), v + dt * k3);
      const double before = n;
      n += dt * v + dt * dt / 6.0 * (k1 + k2 + k3);
      const double old = v;
      v += dt / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
      if (v < 0.0 && n <= end) {
        const double part = (before - end) / (before - n);
        return -(old + part * (v - old)) / velocity;
      }
      if (old < 0.0 && v >= 0.0) return 0.0;
    }
    return 0.0;
  }
};

std::vector<Dataset> data_of(const SteppedTruth& truth) {
  Dataset data = synthetic::dataset({});
  data.system.stiffness_K = truth.K;
  data.system.adhesion_force_f0.reset();
  data.points.clear();
  for (const double diameter : {2.58e-6, 6.89e-6}) {
    for (const double velocity : {0.8, 1.2, 2.0, 4.0, 8.0, 16.0, 40.0}) {
      ImpactPoint point;
      point.diameter = diameter;
      point.incident_velocity = velocity;
      point.restitution = truth.restitution(diameter, velocity);
      point.restitution_sd = 0.005;
      if (point.restitution == 0.0) point.captured = 1;
      data.points.push_back(point);
    }
  }
  data.series.resize(1);
  return {data};
}

FitSpec spec_of(AdhesionLaw law) {
  FitSpec spec;
  spec.adhesion = law;
  for (const Parameter& parameter : base_parameters(law)) {
    spec.parameters.push_back(default_of(parameter));
  }
  spec.parameters.back().free = true;
  spec.parameters.back().initial = 0.05;
  spec.parameters.back().initial_stated = true;
  return spec;
}

class AdhesionFit : public testing::TestWithParam<AdhesionLaw> {};
INSTANTIATE_TEST_SUITE_P(Laws, AdhesionFit, testing::Values(AdhesionLaw::jkr, AdhesionLaw::dmt),
                         [](const auto& law) { return to_string(law.param); });

TEST_P(AdhesionFit, FindsWhatAnotherIntegratorUsed) {
  SteppedTruth truth;
  truth.law = GetParam();
  const std::vector<Dataset> datasets = data_of(truth);
  const ImpactModel model = make_model(spec_of(GetParam()), datasets);
  const Observations data = gather(datasets);
  const FitResult found = fit(model, data);
  ASSERT_TRUE(found.usable) << found.failure;
  EXPECT_LT(found.chi2, 1e-3);
  EXPECT_NEAR(found.theta[0] / truth.C_H, 1.0, 0.01);
  EXPECT_NEAR(found.theta[1] / truth.C_A, 1.0, 0.01);
  EXPECT_NEAR(found.theta[2] / truth.W, 1.0, 0.01);
}

/// The two-point calibration of the larger spheres with the work of adhesion of the truth.
TwoPointResult two_point_of(const SteppedTruth& truth, FitSpec spec) {
  spec.parameters.back().free = false;
  spec.parameters.back().initial = truth.W;
  const std::vector<Dataset> datasets = data_of(truth);
  const ImpactModel model = make_model(spec, datasets);
  return two_point(model, gather(datasets), 0, 6.89e-6);
}

TEST_P(AdhesionFit, TwoPointsFindWhatAnotherIntegratorUsed) {
  SteppedTruth truth;
  truth.law = GetParam();
  const TwoPointResult found = two_point_of(truth, spec_of(GetParam()));
  ASSERT_EQ(found.status, TwoPointStatus::converged);
  EXPECT_NEAR(found.theta[0] / truth.C_H, 1.0, 0.01);
  EXPECT_NEAR(found.theta[1] / truth.C_A, 1.0, 0.01);
}

TEST_P(AdhesionFit, CapturesWhereTheOtherIntegratorDoes) {
  SteppedTruth truth;
  truth.law = GetParam();
  truth.C_A = 0.2;
  const std::vector<Dataset> datasets = data_of(truth);
  const ImpactModel model = make_model(spec_of(GetParam()), datasets);
  const std::vector<double> theta = {truth.C_H, truth.C_A, truth.W};
  const CaptureVelocity capture = capture_velocity(model, theta, 0, 2.58e-6);
  ASSERT_TRUE(capture.found);
  EXPECT_GT(truth.restitution(2.58e-6, 1.01 * capture.value), 0.0);
  EXPECT_EQ(truth.restitution(2.58e-6, 0.99 * capture.value), 0.0);
}

TEST_P(AdhesionFit, KnowsItsSlopeInW) {
  const std::vector<Dataset> datasets = data_of({});
  const ImpactModel model = make_model(spec_of(GetParam()), datasets);
  const std::vector<double> theta = {3e-3, 0.02, 0.05};
  const auto at = [&](double W) {
    std::vector<double> moved = theta;
    moved[2] = W;
    return predict(model, moved, 0, 4.9e-6, 3.0, true);
  };
  const double h = 1e-5;
  const double slope =
      (at(0.05 + h).restitution_squared - at(0.05 - h).restitution_squared) / (2.0 * h);
  EXPECT_NEAR(at(0.05).gradient[2] / slope, 1.0, 1e-5);
}

TEST(MaugisFit, FindsTheWorkOfAJkrTruthWhereItsForcesAreShort) {
  // Tabor's parameter is about 50 with z_0 = 0.05 nm: the loss of an undamped impact is 2 % below
  // that of JKR, W^(5/3).
  SteppedTruth truth;
  const std::vector<Dataset> datasets = data_of(truth);
  FitSpec spec = spec_of(AdhesionLaw::maugis);
  spec.separation = 5e-11;
  const FitResult found = fit(make_model(spec, datasets), gather(datasets));
  ASSERT_TRUE(found.usable) << found.failure;
  EXPECT_NEAR(found.theta[0] / truth.C_H, 1.0, 0.05);
  EXPECT_NEAR(found.theta[1] / truth.C_A, 1.0, 0.05);
  EXPECT_NEAR(found.theta[2] / truth.W, 1.0, 0.03);
}

TEST(MaugisFit, TwoPointsFindTheDampingsOfAJkrTruthWhereItsForcesAreShort) {
  FitSpec spec = spec_of(AdhesionLaw::maugis);
  spec.separation = 5e-11;
  const SteppedTruth truth;
  const TwoPointResult found = two_point_of(truth, spec);
  ASSERT_EQ(found.status, TwoPointStatus::converged);
  EXPECT_NEAR(found.theta[0] / truth.C_H, 1.0, 0.05);
  EXPECT_NEAR(found.theta[1] / truth.C_A, 1.0, 0.05);
}

TEST(MaugisFit, KnowsItsSlopesAndItsCapture) {
  const std::vector<Dataset> datasets = data_of({});
  for (const double separation : {2e-10, 2e-9}) {  // lambda about 13 and 1.3
    FitSpec spec = spec_of(AdhesionLaw::maugis);
    spec.separation = separation;
    const ImpactModel model = make_model(spec, datasets);
    const std::vector<double> theta = {3e-3, 0.02, 0.05};
    const auto at = [&](double W, double diameter) {
      std::vector<double> moved = theta;
      moved[2] = W;
      PointPredictor predictor(model, {{0, diameter, 3.0}});
      predictor.evaluate(moved, true);
      std::vector<double> row(3);
      predictor.gradient_row(0, 1.0, row);
      return std::array{predictor.at(0).restitution_squared, row[2], predictor.diameter_slope(0)};
    };
    const double h = 1e-5, d = 4.9e-6;
    const double by_W = (at(0.05 + h, d)[0] - at(0.05 - h, d)[0]) / (2.0 * h);
    EXPECT_NEAR(at(0.05, d)[1] / by_W, 1.0, 1e-5);
    const double by_d = (at(0.05, d * (1.0 + h))[0] - at(0.05, d * (1.0 - h))[0]) / (2.0 * h * d);
    EXPECT_NEAR(at(0.05, d)[2] / by_d, 1.0, 1e-5);
    const CaptureVelocity capture = capture_velocity(model, theta, 0, d);
    ASSERT_TRUE(capture.found);
    EXPECT_NEAR(predict(model, theta, 0, d, capture.value, false).restitution_squared, 0.0, 1e-7);
  }
}

TEST(AdhesionKeys, TheParameterFollowsTheLaw) {
  const auto refused = [](const std::string& text) {
    try {
      parse_fit("dataset = \"x\"\n" + text, "fits/one.toml");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused("[model]\nadhesion = \"jkr\"\n[parameters]\nW = { free = true }"), "");
  EXPECT_NE(refused("[model]\nadhesion = \"jkr\"\n[parameters]\nf0 = { free = true }"), "");
  EXPECT_NE(refused("[parameters]\nW = { free = true }"), "");
  EXPECT_NE(refused("[model]\nadhesion = \"jrk\""), "");
  EXPECT_NE(refused("[model]\nadhesion = \"dmt\"\nmechanisms = [\"crack_rate\"]"), "");
  EXPECT_EQ(refused("[model]\nadhesion = \"dmt\"\nmechanisms = [\"gas_film\"]"), "");
  EXPECT_EQ(refused("[model]\nadhesion = \"jkr\"\nmechanisms = [\"crack_rate\", "
                    "\"bulk_viscoelastic\", \"plastic_yield\"]"),
            "");
  EXPECT_NE(refused("[model]\nadhesion = \"jkr\"\nmechanisms = [\"jkr_hysteresis\"]")
                .find("which would count twice"),
            std::string::npos);
  EXPECT_EQ(refused("[model]\nadhesion = \"maugis\"\nseparation = 3e-10"), "");
  EXPECT_NE(refused("[model]\nadhesion = \"jkr\"\nseparation = 3e-10").find("range of adhesion"),
            std::string::npos);
  EXPECT_NE(refused("[model]\nadhesion = \"maugis\"\nseparation = 0.3").find("4e-10 is usual"),
            std::string::npos);
}

}  // namespace
}  // namespace recoil
