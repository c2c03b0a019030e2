// Capture velocity against diameter, ours beside the older models.
#include "predict/capture_comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "exact_fit.hpp"

namespace {

using recoil::CaptureComparison;
using recoil::CaptureCurve;
using recoil::CaptureModel;

const CaptureCurve& curve(const CaptureComparison& of, CaptureModel model) {
  const auto found = std::find_if(of.curves.begin(), of.curves.end(),
                                  [&](const CaptureCurve& c) { return c.model == model; });
  EXPECT_NE(found, of.curves.end()) << name_of(model);
  return found == of.curves.end() ? of.curves.front() : *found;
}

TEST(CaptureComparison, OursIsTheCaptureOfTheOtherSimulator) {
  const recoil::ExactFit exact;
  const auto all = recoil::compare_captures(exact.fitted, exact.datasets, {});
  ASSERT_EQ(all.size(), 1U);
  const recoil::Truth ring = recoil::synthetic::truth_of(exact.design);
  const CaptureCurve& ours = curve(all[0], CaptureModel::fit);
  EXPECT_TRUE(ours.lower.empty());
  for (std::size_t k = 0; k < all[0].diameter.size(); k += 6) {
    EXPECT_NEAR(ours.velocity[k] / recoil::true_capture_velocity(ring, all[0].diameter[k]), 1.0,
                1e-5)
        << all[0].diameter[k];
  }
  // It falls more steeply than JKR, whose exponent is -5/6.
  const CaptureCurve& jkr = curve(all[0], CaptureModel::jkr);
  const double decades = std::log(all[0].diameter.back() / all[0].diameter.front());
  EXPECT_NEAR(std::log(jkr.velocity.back() / jkr.velocity.front()) / decades, -5.0 / 6.0, 1e-9);
  EXPECT_LT(std::log(ours.velocity.back() / ours.velocity.front()) / decades, -1.1);
}

TEST(CaptureComparison, OlderModelsLoseMoreThanJkr) {
  const recoil::ExactFit exact;
  const auto all = recoil::compare_captures(exact.fitted, exact.datasets, {});
  for (std::size_t k = 0; k < all[0].diameter.size(); ++k) {
    const double jkr = curve(all[0], CaptureModel::jkr).velocity[k];
    const double wall = curve(all[0], CaptureModel::wall).velocity[k];
    EXPECT_GT(wall, jkr);
    // E_r - e^2 E_i > E_r - E_i for e < 1.
    EXPECT_GT(curve(all[0], CaptureModel::dahneke).velocity[k], wall);
    EXPECT_GE(curve(all[0], CaptureModel::thornton_ning).velocity[k], jkr);
  }
  EXPECT_TRUE(all[0].published.empty());  // none for molybdenum
}

TEST(CaptureComparison, TheBandHoldsTheReplicates) {
  const recoil::ExactFit exact;
  recoil::BootstrapResult bootstrap;
  for (int i = 0; i < 100; ++i) {
    std::vector<double> theta = exact.fitted.theta;
    theta[1] *= 0.95 + 0.001 * i;
    bootstrap.theta.push_back(theta);
  }
  const auto all = recoil::compare_captures(exact.fitted, exact.datasets, bootstrap);
  const CaptureCurve& ours = curve(all[0], CaptureModel::fit);
  ASSERT_EQ(ours.lower.size(), ours.velocity.size());
  for (std::size_t k = 0; k < ours.velocity.size(); ++k) {
    EXPECT_LT(ours.lower[k], ours.velocity[k]);
    EXPECT_GT(ours.upper[k], ours.velocity[k]);
    EXPECT_LT(ours.upper[k] / ours.lower[k], 1.2);
  }
}

TEST(CaptureComparison, WithoutAdhesionThereIsNone) {
  recoil::ExactFit exact;
  exact.datasets[0].system.adhesion_energy = 0.0;
  exact.datasets[0].system.adhesion_force_f0.reset();
  exact.fitted.model = recoil::make_model(recoil::synthetic::spec(), exact.datasets);
  EXPECT_TRUE(recoil::compare_captures(exact.fitted, exact.datasets, {}).empty());
}

}  // namespace
