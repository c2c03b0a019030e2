// The sampler and what it says of itself, against closed forms.
#include "uncertainty/ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace recoil {
namespace {

/// x_{t+1} = phi x_t + sqrt(1 - phi^2) z: autocorrelation phi^t, so that n steps are worth
/// n (1 - phi) / (1 + phi) independent draws.
std::vector<double> autoregressive(double phi, std::size_t n, std::uint64_t index) {
  RandomStream random(5, RandomPurpose::posterior, index);
  std::vector<double> chain;
  double x = random.normal();
  for (std::size_t i = 0; i < n; ++i) {
    chain.push_back(x);
    x = phi * x + std::sqrt(1.0 - phi * phi) * random.normal();
  }
  return chain;
}

TEST(Chains, EffectiveSizeIsThatOfAnAutoregression) {
  for (const double phi : {0.0, 0.5, 0.9}) {
    std::vector<std::vector<double>> chains;
    for (std::uint64_t c = 0; c < 8; ++c) chains.push_back(autoregressive(phi, 20000, c));
    const double expected = 8.0 * 20000.0 * (1.0 - phi) / (1.0 + phi);
    EXPECT_NEAR(effective_sample_size(chains) / expected, 1.0, 0.1) << phi;
    EXPECT_NEAR(split_r_hat(chains), 1.0, 0.003) << phi;
  }
}

TEST(Chains, ThatStandApartAreNotedAtOnce) {
  // Four chains of unit normals, the means of two of them 1 higher: of the eight halves the means
  // have the variance 4 * 2 * 0.25 / 7 = 2/7, so that r_hat^2 = 1 + 2/7.
  std::vector<std::vector<double>> chains;
  for (std::uint64_t c = 0; c < 4; ++c) {
    chains.push_back(autoregressive(0.0, 10000, c));
    for (double& x : chains.back()) x += c < 2 ? 1.0 : 0.0;
  }
  EXPECT_NEAR(split_r_hat(chains), std::sqrt(1.0 + 2.0 / 7.0), 0.01);
  EXPECT_LT(effective_sample_size(chains), 100.0);
  // And one that drifts is not like itself.
  std::vector<double> drift(1000);
  for (std::size_t i = 0; i < drift.size(); ++i) drift[i] = static_cast<double>(i);
  EXPECT_GT(split_r_hat({drift, drift}), 1.5);
  EXPECT_EQ(split_r_hat({{1.0, 1.0, 1.0, 1.0}, {2.0, 2.0, 2.0, 2.0}}), INFINITY);
}

TEST(Ensemble, FindsANormalDistributionWhateverItsScales) {
  // x of sd 1, y = 1000 (0.95 x + sqrt(1 - 0.95^2) z): correlation 0.95, scales 1 to 1000.
  constexpr double r = 0.95;
  const LogDensity density = [](std::span<const double> z) {
    const double x = z[0];
    const double y = z[1] / 1000.0;
    return -0.5 * (x * x - 2.0 * r * x * y + y * y) / (1.0 - r * r);
  };
  RandomStream random(7, RandomPurpose::posterior, 0);
  std::vector<std::vector<double>> start;
  for (int k = 0; k < 20; ++k) start.push_back({3.0 * random.normal(), 3000.0 * random.normal()});
  Ensemble ensemble(density, start, random);
  for (int k = 0; k < 1000; ++k) ensemble.step();
  std::vector<std::vector<double>> x(20), y(20);
  double cross = 0.0;
  constexpr int steps = 8000;
  for (int k = 0; k < steps; ++k) {
    ensemble.step();
    for (std::size_t w = 0; w < 20; ++w) {
      x[w].push_back(ensemble.walkers()[w][0]);
      y[w].push_back(ensemble.walkers()[w][1] / 1000.0);
      cross += x[w].back() * y[w].back() / (20.0 * steps);
    }
  }
  double mean = 0.0, square = 0.0;
  for (const auto& chain : x) {
    for (const double v : chain) {
      mean += v / (20.0 * steps);
      square += v * v / (20.0 * steps);
    }
  }
  const double draws = effective_sample_size(x);
  EXPECT_GT(draws, 2000.0);
  EXPECT_LT(split_r_hat(x), 1.01);
  EXPECT_NEAR(mean, 0.0, 4.0 / std::sqrt(draws));
  EXPECT_NEAR(square, 1.0, 4.0 * std::sqrt(2.0 / draws));
  EXPECT_NEAR(cross, r, 4.0 * std::sqrt((1.0 + r * r) / draws));
  // Two dimensions, a = 2: the acceptance of a normal distribution is about 0.7.
  EXPECT_NEAR(ensemble.acceptance(), 0.7, 0.07);
}

TEST(Ensemble, StaysInsideAndKnowsAnExponential) {
  // Mean and sd of exp(-x), x > 0, are 1.
  const LogDensity density = [](std::span<const double> z) {
    return z[0] > 0.0 ? -z[0] : -INFINITY;
  };
  RandomStream random(9, RandomPurpose::posterior, 0);
  std::vector<std::vector<double>> start;
  for (int k = 0; k < 10; ++k) start.push_back({random.uniform()});
  Ensemble ensemble(density, start, random);
  std::vector<std::vector<double>> chains(10);
  for (int k = 0; k < 20000; ++k) {
    ensemble.step();
    for (std::size_t w = 0; w < 10; ++w) {
      ASSERT_GT(ensemble.walkers()[w][0], 0.0);
      chains[w].push_back(ensemble.walkers()[w][0]);
    }
  }
  double mean = 0.0, square = 0.0;
  for (const auto& chain : chains) {
    for (const double v : chain) {
      mean += v / 200000.0;
      square += v * v / 200000.0;
    }
  }
  const double draws = effective_sample_size(chains);
  EXPECT_NEAR(mean, 1.0, 4.0 / std::sqrt(draws));
  EXPECT_NEAR(square, 2.0, 4.0 * std::sqrt(20.0 / draws));
}

}  // namespace
}  // namespace recoil
