// How impacts end, and where their energy goes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "impact/impact.hpp"

namespace recoil {
namespace {

double log_uniform(double low, double high) {
  const double t = *rc::gen::inRange(0, 1000001) / 1e6;
  return low * std::pow(high / low, t);
}

RC_GTEST_PROP(Energy, EveryBudgetClosesAndNothingIsGained, ()) {
  const double w = log_uniform(0.02, 1000.0);
  const double h = *rc::gen::inRange(0, 4) == 0 ? 0.0 : log_uniform(1e-5, 1.0);
  const double g = *rc::gen::inRange(0, 4) == 0 ? 0.0 : log_uniform(1e-5, 3.0);
  const bool adhesive = *rc::gen::inRange(0, 6) != 0;
  ImpactOptions options;
  options.budget = true;
  options.phase =
      *rc::gen::arbitrary<bool>() ? AdhesionDampingPhase::both : AdhesionDampingPhase::rebound;
  const ImpactResult impact =
      simulate_impact({h * w, adhesive ? std::pow(w, -0.8) : 0.0, g * w}, options);
  RC_ASSERT(impact.usable());
  RC_ASSERT(std::abs(impact.energy.audit()) < 1e-9);
  RC_ASSERT(impact.restitution_squared <= 1.0 + 1e-9 * impact.energy.largest);
  RC_ASSERT(impact.energy.hertz_loss >= 0.0);
  RC_ASSERT(impact.energy.adhesion_loss >= -1e-15);
  // The continuation below capture has a floor: minus twice the depth of the adhesive well.
  RC_ASSERT(impact.restitution_squared >= -8.0 / 15.0 / (w * w) * (1.0 + 1e-9));
  RC_ASSERT((impact.outcome == ImpactOutcome::captured) == (impact.restitution_squared <= 0.0));
}

RC_GTEST_PROP(Energy, HertzDampingNeverPulls, ()) {
  // 1 + C_H n' stays positive on the way out, so the Hunt-Crossley force never turns tensile.
  const double x = log_uniform(1e-3, 100.0);
  ImpactOptions options;
  options.budget = true;
  std::vector<ImpactMoment> history;
  RC_ASSERT(simulate_impact({x, 0.0, 0.0}, options, &history).usable());
  for (const ImpactMoment& moment : history) {
    RC_ASSERT(moment.hertz + moment.hertz_damping >= -1e-9 * (1.0 + x));
  }
}

TEST(Outcome, CaptureFailureAndStepLimitAreThreeThings) {
  ImpactOptions options;
  const ImpactResult captured = simulate_impact({0.0, 5.0, 0.5}, options);
  EXPECT_EQ(captured.outcome, ImpactOutcome::captured);
  EXPECT_LT(captured.restitution_squared, 0.0);

  options.max_steps = 10;
  const ImpactResult limited = simulate_impact({0.0, 0.5, 0.1}, options);
  EXPECT_EQ(limited.outcome, ImpactOutcome::step_limit);
  EXPECT_FALSE(limited.usable());

  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const ImpactGroups& bad : {ImpactGroups{nan, 0.1, 0.1}, ImpactGroups{0.1, infinity, 0.1},
                                  ImpactGroups{0.1, 0.1, -1.0}}) {
    const ImpactResult failed = simulate_impact(bad, {});
    EXPECT_EQ(failed.outcome, ImpactOutcome::integration_failure);
    EXPECT_TRUE(std::isfinite(failed.restitution_squared));
  }
}

TEST(Outcome, CreepIntoTheWellEndsOnItsFloor) {
  // So much damping that the sphere never turns again: the reference follows it until it settles.
  for (const double g : {3.0, 8.0}) {
    ImpactOptions options;
    options.gradient = true;
    const ImpactResult impact = simulate_impact({0.0, 1.0, g}, options);
    ASSERT_EQ(impact.outcome, ImpactOutcome::captured) << "g = " << g;
    EXPECT_NEAR(impact.restitution_squared, -8.0 / 15.0, 1e-9);
    EXPECT_NEAR(impact.gradient[1], -4.0 / 3.0, 1e-4);  // d/dbeta of -(8/15) beta^(5/2)
  }
}

TEST(Outcome, BothPhasesLoseTwiceAsMuchAtFirstOrder) {
  ImpactOptions options;
  const double one = 1.0 - simulate_impact({0.0, 0.3, 1e-4}, options).restitution_squared;
  options.phase = AdhesionDampingPhase::both;
  const double two = 1.0 - simulate_impact({0.0, 0.3, 1e-4}, options).restitution_squared;
  EXPECT_NEAR(two / one, 2.0, 1e-3);
}

TEST(Outcome, ComputedRestitutionOfBothReadings) {
  // e at (g, w) with C_H = 0, from an independent DOP853 integration in time.
  const auto e = [](double g, double w, AdhesionDampingPhase phase) {
    ImpactOptions options;
    options.phase = phase;
    return std::sqrt(simulate_impact({0.0, std::pow(w, -0.8), g * w}, options).restitution_squared);
  };
  using enum AdhesionDampingPhase;
  EXPECT_NEAR(e(0.05, 1.0, both), 0.795, 5e-4);
  EXPECT_NEAR(e(0.05, 20.0, both), 0.891, 5e-4);
  EXPECT_NEAR(e(0.05, 1.0, rebound), 0.895, 5e-4);
  EXPECT_NEAR(e(0.05, 20.0, rebound), 0.942, 5e-4);
  EXPECT_NEAR(e(0.2, 5.0, rebound), 0.785, 5e-4);
}

TEST(Outcome, HistoryEndsAtReleaseAndAddsUp) {
  ImpactOptions options;
  options.budget = true;
  std::vector<ImpactMoment> history;
  const ImpactResult impact = simulate_impact({0.02, 0.5, 0.15}, options, &history);
  ASSERT_GT(history.size(), 50U);
  EXPECT_EQ(history.front().time, 0.0);
  EXPECT_NEAR(history.back().time, impact.contact_time, 1e-12);
  EXPECT_NEAR(history.back().penetration, 0.0, 1e-9);
  // Momentum: the impulse of all forces is the change of velocity (trapezoids on uneven steps).
  double impulse = 0.0;
  for (std::size_t i = 1; i < history.size(); ++i) {
    const auto total = [](const ImpactMoment& m) {
      return m.hertz + m.hertz_damping + m.adhesion + m.adhesion_damping;
    };
    impulse +=
        0.5 * (total(history[i]) + total(history[i - 1])) * (history[i].time - history[i - 1].time);
  }
  EXPECT_NEAR(impulse, 1.0 + std::sqrt(impact.restitution_squared), 2e-3);
}

}  // namespace
}  // namespace recoil
