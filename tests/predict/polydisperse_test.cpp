// Weighted averages against sums over an independent simulator, one size at a time.
#include "predict/polydisperse.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exact_fit.hpp"

namespace {

using recoil::BandedValue;
using recoil::PolydispersePrediction;

recoil::MeasuredSizes three_sizes() {
  recoil::MeasuredSizes sizes;
  sizes.bins = {{2e-6, 1.0, 0.0}, {4e-6, 2.0, 0.0}, {8e-6, 1.0, 0.0}};
  sizes.smallest = 2e-6;
  sizes.largest = 8e-6;
  return sizes;
}

PolydispersePrediction predicted(const recoil::ExactFit& exact, double height, int threads = 1) {
  recoil::PolydisperseOptions options;
  options.probe_height = height;
  options.threads = threads;
  options.velocities = 25;
  return recoil::predict_mixture(exact.fitted, 0, exact.bootstrap, three_sizes(), options);
}

TEST(Mixture, IsTheSumOverItsSizes) {
  const recoil::ExactFit exact;
  const double height = 0.02;  // rebounds below 0.626 m/s are not seen
  const PolydispersePrediction mixture = predicted(exact, height);
  const double slowest = std::sqrt(2.0 * 9.80665 * height);
  EXPECT_NEAR(mixture.slowest_seen, slowest, 1e-12);
  int differing = 0;
  for (std::size_t k = 0; k < mixture.velocity.size(); ++k) {
    const double v = mixture.velocity[k];
    double sum[3] = {0.0, 0.0, 0.0};
    double weight[3] = {0.0, 0.0, 0.0};
    for (const recoil::SizeBin& bin : three_sizes().bins) {
      const double e = exact.truth(bin.diameter, v);
      const bool counts[3] = {true, e > 0.0, e * v > slowest};
      for (int c = 0; c < 3; ++c) {
        if (!counts[c]) continue;
        sum[c] += bin.weight * e;
        weight[c] += bin.weight;
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const BandedValue& at = mixture.average[c][k];
      ASSERT_EQ(at.value.has_value(), weight[c] > 0.0) << v << " " << c;
      if (at.value) {
        EXPECT_NEAR(*at.value, sum[c] / weight[c], 1e-6) << v << " " << c;
      }
      EXPECT_FALSE(at.lower.has_value());  // no bootstrap
    }
    EXPECT_NEAR(*mixture.captured[k].value, 1.0 - weight[1] / 4.0, 1e-12) << v;
    EXPECT_NEAR(*mixture.unseen[k].value, 1.0 - weight[2] / 4.0, 1e-12) << v;
    if (weight[0] > weight[1] && weight[1] > weight[2] && weight[2] > 0.0) ++differing;
  }
  EXPECT_GE(differing, 1) << "the three conventions never differed: nothing was tested";
}

TEST(Mixture, ConventionsAreOrdered) {
  const recoil::ExactFit exact;
  const PolydispersePrediction mixture = predicted(exact, 0.01);
  for (std::size_t k = 0; k < mixture.velocity.size(); ++k) {
    const auto& zero = mixture.average[0][k].value;
    const auto& left_out = mixture.average[1][k].value;
    const auto& unseen = mixture.average[2][k].value;
    if (left_out) {
      EXPECT_LE(*zero, *left_out + 1e-12);
    }
    if (unseen) {
      EXPECT_LE(*left_out, *unseen + 1e-12);
    }
    EXPECT_LE(*mixture.captured[k].value, *mixture.unseen[k].value + 1e-12);
  }
}

TEST(Mixture, SizeCurvesAndTheirCaptureVelocities) {
  const recoil::ExactFit exact;
  const PolydispersePrediction mixture = predicted(exact, 0.001);
  ASSERT_EQ(mixture.size_curves.size(), 3U);
  EXPECT_DOUBLE_EQ(mixture.size_curves[1].diameter, 4.5e-6);  // (2 + 8 + 8) / 4
  for (const recoil::SizeCurve& size : mixture.size_curves) {
    ASSERT_GT(size.capture_velocity, 0.0);
    EXPECT_EQ(exact.truth(size.diameter, 0.99 * size.capture_velocity), 0.0);
    EXPECT_GT(exact.truth(size.diameter, 1.01 * size.capture_velocity), 0.0);
  }
}

TEST(Mixture, PointsOfOneSizeLieOnItsCurve) {
  // A mixture of one size only, with points of that size: nothing is missed.
  recoil::ExactFit exact;
  exact.design.diameters = {4.9e-6};
  exact.datasets = {recoil::synthetic::dataset(exact.design)};
  exact.fitted.data = recoil::gather(exact.datasets);
  recoil::MeasuredSizes one;
  one.bins = {{4.9e-6, 7.0, 0.0}};
  one.smallest = one.largest = 4.9e-6;
  const auto mixture = recoil::predict_mixture(exact.fitted, 0, exact.bootstrap, one, {});
  ASSERT_TRUE(mixture.miss_single.rmse.has_value());
  EXPECT_LT(*mixture.miss_single.rmse, 1e-6);
  EXPECT_EQ(mixture.miss_single.points, exact.design.velocities.size());
  for (const recoil::CurveMiss& miss : mixture.miss) EXPECT_LT(*miss.rmse, 1e-6);
}

TEST(Mixture, BandsHoldThePercentilesOfTheReplicates) {
  recoil::ExactFit exact;
  for (int i = 0; i <= 200; ++i) {  // C_H spread evenly by 10 % to either side
    std::vector<double> theta = exact.fitted.theta;
    theta[0] *= 0.9 + 0.001 * i;
    exact.bootstrap.theta.push_back(theta);
  }
  const PolydispersePrediction mixture = predicted(exact, 0.001, 2);
  EXPECT_EQ(mixture.replicates, 201U);
  const std::size_t last = mixture.velocity.size() - 1;
  const BandedValue& at = mixture.average[0][last];
  ASSERT_TRUE(at.lower && at.upper);
  // The average falls with C_H; the 2.5 % quantile of 201 values by the (B + 1) p rule lies at
  // C_H x (0.9 + 0.001 x (200 - 4.05)).
  recoil::ExactFit high = exact;
  high.bootstrap.theta.clear();
  high.fitted.theta[0] *= 0.9 + 0.001 * (200.0 - 4.05);
  recoil::ExactFit low = high;
  low.fitted.theta[0] = exact.fitted.theta[0] * (0.9 + 0.001 * 4.05);
  const auto value_at = [&](const recoil::ExactFit& of) {
    double sum = 0.0;
    for (const recoil::SizeBin& bin : three_sizes().bins) {
      sum += bin.weight * recoil::predict(of.fitted.model, of.fitted.theta, 0, bin.diameter,
                                          mixture.velocity[last], false)
                              .restitution();
    }
    return sum / 4.0;
  };
  EXPECT_NEAR(*at.lower, value_at(high), 2e-5);
  EXPECT_NEAR(*at.upper, value_at(low), 2e-5);
  EXPECT_LT(*at.lower, *at.value);
  EXPECT_GT(*at.upper, *at.value);
  // Threads change nothing.
  const PolydispersePrediction again = predicted(exact, 0.001, 1);
  EXPECT_EQ(*again.average[1][last].lower, *mixture.average[1][last].lower);
}

}  // namespace
