// The fast solver never gives a different answer from the reference.
#include "impact/fast_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "impact/dop853.hpp"

namespace recoil {
namespace {

TEST(Dop853, RowsAndWeightsFulfilTheOrderConditionsTheyMust) {
  double nodes[dop853::stages] = {};
  for (int i = 0; i < dop853::stages; ++i) {
    for (int j = 0; j < i; ++j) nodes[i] += dop853::stage[i][j];
  }
  for (int order = 1; order <= 8; ++order) {  // quadrature: sum b c^(k-1) = 1/k
    double sum = 0.0;
    for (int i = 0; i < dop853::stages; ++i) {
      sum += dop853::weight[i] * std::pow(nodes[i], order - 1);
    }
    EXPECT_NEAR(sum, 1.0 / order, 1e-14) << "order " << order;
  }
  double nested = 0.0;  // sum b_i a_ij c_j^5 = 1/42 (order 7)
  for (int i = 0; i < dop853::stages; ++i) {
    for (int j = 0; j < i; ++j) {
      nested += dop853::weight[i] * dop853::stage[i][j] * std::pow(nodes[j], 5);
    }
  }
  EXPECT_NEAR(nested, 1.0 / 42.0, 1e-14);
}

struct Draw {
  double w, h, g;
  AdhesionDampingPhase phase;
};

ImpactGroups groups_of(const Draw& d) { return {d.h * d.w, std::pow(d.w, -0.8), d.g * d.w}; }

class WideBox {
 public:
  Draw next() {
    Draw d{between(0.05, 500.0), zero_or(1e-5, 0.3), zero_or(1e-5, 1.0),
           flip() ? AdhesionDampingPhase::both : AdhesionDampingPhase::rebound};
    return d;
  }
  /// Moves `d` to a relative distance 1e-6 to 1e-1 from its capture velocity, on either side.
  bool approach_capture(Draw& d) {
    if (d.h == 0.0 && d.g == 0.0) return false;
    ImpactOptions options;
    options.phase = d.phase;
    double low = 1e-3, high = 50.0;
    for (int i = 0; i < 50; ++i) {
      Draw trial = d;
      trial.w = std::sqrt(low * high);
      const bool back = simulate_impact_fast(groups_of(trial), options).restitution_squared > 0.0;
      (back ? high : low) = trial.w;
    }
    d.w = low * (1.0 + (flip() ? 1.0 : -1.0) * between(1e-6, 1e-1));
    return high < 49.0;
  }
  bool flip() { return unit_(random_) < 0.5; }

 private:
  double between(double low, double high) { return low * std::pow(high / low, unit_(random_)); }
  double zero_or(double low, double high) {
    return unit_(random_) < 0.2 ? 0.0 : between(low, high);
  }

  std::mt19937_64 random_{20260101};
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

void compare(const Draw& draw) {
  ImpactOptions options;
  options.phase = draw.phase;
  options.gradient = true;
  options.tolerance = 1e-12;
  const ImpactResult fast = simulate_impact_fast(groups_of(draw), options);
  const ImpactResult reference = simulate_impact(groups_of(draw), options);
  ASSERT_EQ(fast.outcome, reference.outcome) << draw.w << " " << draw.h << " " << draw.g;
  // e^2 below capture is as large as the adhesive well, 0.533 / w^2.
  const double yardstick = std::max(1.0, 0.534 / (draw.w * draw.w));
  EXPECT_NEAR(fast.restitution_squared, reference.restitution_squared, 1e-9 * yardstick)
      << draw.w << " " << draw.h << " " << draw.g;
  for (std::size_t k = 0; k < 3; ++k) {
    const double size = std::max(1.0, std::abs(reference.gradient[k]));
    EXPECT_NEAR(fast.gradient[k], reference.gradient[k], 1e-7 * size)
        << "group " << k << " at " << draw.w << " " << draw.h << " " << draw.g;
  }
}

TEST(FastSolver, AgreesWithTheReferenceOverAWideBox) {
  WideBox box;
  for (int i = 0; i < 400; ++i) compare(box.next());
}

TEST(FastSolver, AgreesWithTheReferenceNearCapture) {
  WideBox box;
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    Draw draw = box.next();
    if (!box.approach_capture(draw)) continue;
    compare(draw);
    ++compared;
  }
  EXPECT_GT(compared, 150);
}

TEST(FastSolver, WithoutAdhesion) {
  for (const double alpha : {0.0, 0.1, 1.0, 10.0}) {
    ImpactOptions options;
    options.gradient = true;
    const ImpactResult fast = simulate_impact_fast({alpha, 0.0, 0.0}, options);
    const ImpactResult reference = simulate_impact({alpha, 0.0, 0.0}, options);
    EXPECT_NEAR(fast.restitution_squared, reference.restitution_squared, 1e-9);
    EXPECT_NEAR(fast.gradient[0], reference.gradient[0], 1e-7);
  }
}

TEST(FastSolver, KnowsTheCreepIntoTheWellWithoutFollowingIt) {
  for (const double g : {5.0, 21.0, 30.0}) {
    for (const double w : {0.5, 1.0, 10.0}) {
      const ImpactGroups groups{0.0, std::pow(w, -0.8), g * w};
      const ImpactResult fast = simulate_impact_fast(groups, {});
      const ImpactResult reference = simulate_impact(groups, {});
      ASSERT_EQ(reference.outcome, ImpactOutcome::captured);
      EXPECT_EQ(fast.outcome, ImpactOutcome::captured);
      EXPECT_NEAR(fast.restitution_squared, reference.restitution_squared, 1e-9 / (w * w));
    }
  }
}

TEST(FastSolver, HandsOverInsteadOfGuessing) {
  const long before = reference_handovers();
  const ImpactResult deep = simulate_impact_fast({0.0, 1e4, 1e-7}, {});
  EXPECT_TRUE(deep.usable());
  const ImpactResult reference = simulate_impact({0.0, 1e4, 1e-7}, {});
  EXPECT_EQ(deep.outcome, reference.outcome);
  EXPECT_GE(reference_handovers(), before);
}

}  // namespace
}  // namespace recoil
