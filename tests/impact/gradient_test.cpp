// Sensitivities of the reference solver against the complex step of an independent integrator.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "impact/impact.hpp"
#include "support/independent_impact.hpp"

namespace recoil {
namespace {

using Complex = std::complex<double>;

std::array<double, 3> complex_step(const ImpactGroups& g, bool both) {
  constexpr double h = 1e-30;
  std::array<double, 3> gradient{};
  for (std::size_t k = 0; k < 3; ++k) {
    independent::Groups<Complex> groups{g.alpha, g.beta, g.gamma};
    (k == 0 ? groups.alpha : k == 1 ? groups.beta : groups.gamma) += Complex(0.0, h);
    gradient[k] = independent::twice_energy_left(groups, both).imag() / h;
  }
  return gradient;
}

class Gradient : public testing::TestWithParam<std::tuple<ImpactGroups, AdhesionDampingPhase>> {};

TEST_P(Gradient, MatchesComplexStep) {
  const auto& [groups, phase] = GetParam();
  ImpactOptions options;
  options.phase = phase;
  options.gradient = true;
  const ImpactResult impact = simulate_impact(groups, options);
  ASSERT_TRUE(impact.usable());
  const bool both = phase == AdhesionDampingPhase::both;
  const independent::Groups<double> same{groups.alpha, groups.beta, groups.gamma};
  EXPECT_NEAR(impact.restitution_squared, independent::twice_energy_left(same, both), 1e-9);
  const std::array<double, 3> expected = complex_step(groups, both);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(impact.gradient[k], expected[k], 1e-7 * std::max(1.0, std::abs(expected[k])))
        << "group " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Impacts, Gradient,
    testing::Combine(testing::Values(ImpactGroups{0.3, 0.0, 0.0},    // no adhesion
                                     ImpactGroups{0.01, 0.1, 2.0},   // fast
                                     ImpactGroups{0.05, 0.5, 0.3},   // moderate
                                     ImpactGroups{0.005, 1.2, 0.1},  // slow
                                     ImpactGroups{0.0, 0.7, 0.2},    // C_H = 0
                                     ImpactGroups{0.1, 0.7, 0.0},    // C_A = 0
                                     ImpactGroups{0.02, 3.0, 0.02},  // captured
                                     ImpactGroups{2.0, 0.4, 1.5}),   // strong damping
                     testing::Values(AdhesionDampingPhase::rebound, AdhesionDampingPhase::both)));

/// Groups of the impact at relative distance `d` from capture for g = C_A V_a, C_H = 0.
ImpactGroups near_capture(double g, double capture, double d) {
  const double w = capture * (1.0 + d);
  return {0.0, std::pow(w, -0.8), g * w};
}

TEST(GradientNearCapture, ContinuesSmoothlyThroughTheThreshold) {
  const double g = 0.05;
  double low = 0.1, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const bool comes_back = simulate_impact(near_capture(g, middle, 0.0)).restitution_squared > 0.0;
    (comes_back ? high : low) = middle;
  }
  ImpactOptions options;
  options.gradient = true;
  options.tolerance = 1e-12;
  for (const double d : {1e-2, 1e-4, 1e-6}) {
    const ImpactGroups above = near_capture(g, low, d);
    const ImpactGroups below = near_capture(g, low, -d);
    const ImpactResult rebound = simulate_impact(above, options);
    const ImpactResult captured = simulate_impact(below, options);
    EXPECT_EQ(rebound.outcome, ImpactOutcome::rebound) << "d = " << d;
    EXPECT_EQ(captured.outcome, ImpactOutcome::captured) << "d = " << d;
    EXPECT_LT(captured.restitution_squared, 0.0);
    // C1: value and gradient meet; the gradient's gap closes like sqrt(d).
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(rebound.gradient[k] / captured.gradient[k], 1.0, 1.0 * std::sqrt(d)) << "k " << k;
    }
    // The slope along g, from differences of the energy across the threshold itself.
    const ImpactGroups more{0.0, above.beta, above.gamma * (1.0 + d)};
    const ImpactGroups less{0.0, above.beta, above.gamma * (1.0 - d)};
    const double difference = simulate_impact(more, options).restitution_squared -
                              simulate_impact(less, options).restitution_squared;
    EXPECT_NEAR(difference / (2.0 * d * above.gamma) / rebound.gradient[2], 1.0,
                std::max(0.5 * std::sqrt(d), 2e-4));
  }
}

TEST(GradientNearCapture, MatchesComplexStepOnBothSides) {
  for (const double d : {1e-3, -1e-3}) {
    // w* of g = 0.05 from the capture law with its next orders, good to 1e-4.
    const ImpactGroups groups = near_capture(0.05, 0.2997197, d);
    ImpactOptions options;
    options.gradient = true;
    options.tolerance = 1e-12;
    const ImpactResult impact = simulate_impact(groups, options);
    const std::array<double, 3> expected = complex_step(groups, false);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(impact.gradient[k] / expected[k], 1.0, 1e-6) << "group " << k << ", d = " << d;
    }
  }
}

}  // namespace
}  // namespace recoil
