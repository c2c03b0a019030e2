// One binary, every instruction set, the same digits.
#include "impact/fast_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "impact/impact.hpp"
#include "impact/partial.hpp"

namespace recoil {
namespace {

std::vector<ImpactGroups> mixed_impacts(std::size_t count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, unit(random));
  };
  std::vector<ImpactGroups> impacts;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = between(0.1, 300.0);
    const double alpha = between(1e-5, 0.5) * w;
    const double gamma = between(1e-5, 0.5) * w;
    impacts.push_back({alpha, std::pow(w, -0.8), gamma, 0.0, between(0.05, 50.0)});
  }
  return impacts;
}

void expect_same_digits(const ImpactResult& a, const ImpactResult& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.restitution_squared, b.restitution_squared);
  EXPECT_EQ(a.gradient, b.gradient);
  EXPECT_EQ(a.steps, b.steps);
}

TEST(FastKernel, EveryInstructionSetGivesTheSameDigits) {
  const std::vector<ImpactGroups> impacts = mixed_impacts(203);
  ASSERT_EQ(std::string(fast_kernels().back().name), "baseline");
#ifdef RECOIL_AVX512_EXPECTED
  if (__builtin_cpu_supports("avx512vl")) {
    ASSERT_EQ(std::string(fast_kernels().front().name), "avx512");
  }
#endif
  for (const AdhesionLaw law : values_of<AdhesionLaw>()) {
    for (const bool gradient : {false, true}) {
      ImpactOptions options;
      options.adhesion = law;
      options.gradient = gradient;
      std::vector<ImpactResult> baseline(impacts.size());
      fast_kernels().back().simulate(impacts, options, baseline);
      for (const FastKernel& kernel : fast_kernels()) {
        std::vector<ImpactResult> results(impacts.size());
        kernel.simulate(impacts, options, results);
        for (std::size_t i = 0; i < impacts.size(); ++i) {
          expect_same_digits(results[i], baseline[i]);
        }
      }
    }
  }
}

TEST(FastKernel, AnImpactDoesNotNoticeItsNeighbours) {
  const std::vector<ImpactGroups> impacts = mixed_impacts(50);
  ImpactOptions options;
  options.gradient = true;
  std::vector<ImpactResult> together(impacts.size());
  simulate_impacts_fast(impacts, options, together);
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    expect_same_digits(together[i], simulate_impact_fast(impacts[i], options));
  }
}

TEST(FastKernel, AnImpactThatIsAnsweredAtOnceLeavesTheOthersInPlace) {
  std::vector<ImpactGroups> impacts = mixed_impacts(9);
  impacts[0] = {std::nan(""), 0.1, 0.1};
  impacts[4] = {3.0, 1.0, 0.0};  // creeps into the well
  impacts[8] = {0.0, 1.0, 3.0};
  std::vector<ImpactResult> together(impacts.size());
  simulate_impacts_fast(impacts, {}, together);
  EXPECT_EQ(together[0].outcome, ImpactOutcome::integration_failure);
  for (std::size_t i = 1; i < impacts.size(); ++i) {
    expect_same_digits(together[i], simulate_impact_fast(impacts[i], {}));
  }
  simulate_impacts_fast({}, {}, {});
}

// f = x^2 y + 3 (x + y), differentiated by hand.
TEST(Partial, ProductsAndSums) {
  const auto x = variable<0>(2.0);
  const auto y = variable<5>(7.0);
  const auto f = x * x * y + 3.0 * (x + y);
  static_assert(f.carries(0) && f.carries(5) && !f.carries(1));
  EXPECT_DOUBLE_EQ(f.value, 28.0 + 27.0);
  EXPECT_DOUBLE_EQ(f.derivative<0>(), 28.0 + 3.0);
  EXPECT_DOUBLE_EQ(f.derivative<5>(), 4.0 + 3.0);
  EXPECT_DOUBLE_EQ(f.derivative<1>(), 0.0);
  EXPECT_DOUBLE_EQ((-(f + 1.0)).derivative<0>(), -31.0);
}

}  // namespace
}  // namespace recoil
