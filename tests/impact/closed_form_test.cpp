// The reference solver against results that need no solver at all.
#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_gamma.h>
#include <gsl/gsl_sf_lambert.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "impact/impact.hpp"

namespace recoil {
namespace {

ImpactResult reference(double alpha, double beta, double gamma,
                       AdhesionDampingPhase phase = AdhesionDampingPhase::rebound) {
  ImpactOptions options;
  options.phase = phase;
  options.budget = true;
  options.gradient = true;
  options.tolerance = 1e-12;
  return simulate_impact({alpha, beta, gamma}, options);
}

/// Groups from w = V / V_a, h = C_H V_a, g = C_A V_a.
ImpactResult in_adhesion_units(double w, double h, double g,
                               AdhesionDampingPhase phase = AdhesionDampingPhase::rebound) {
  return reference(h * w, std::pow(w, -0.8), g * w, phase);
}

// Hunt & Crossley damping alone: C_H V (1 + e) = ln[(1 + C_H V) / (1 - e C_H V)], solved by
// Lambert's W.
double hunt_crossley(double x) {
  return (1.0 + gsl_sf_lambert_W0(-(1.0 + x) * std::exp(-(1.0 + x)))) / x;
}

TEST(ClosedForm, HuntCrossleyIsLambertW) {
  for (const double x : {1e-3, 0.1, 0.5, 1.0, 3.0, 10.0, 30.0}) {
    const ImpactResult impact = reference(x, 0.0, 0.0);
    ASSERT_EQ(impact.outcome, ImpactOutcome::rebound);
    EXPECT_NEAR(std::sqrt(impact.restitution_squared), hunt_crossley(x), 1e-9) << "x = " << x;
  }
}

TEST(ClosedForm, HuntCrossleyPublishedDigits) {
  EXPECT_NEAR(std::sqrt(reference(0.1, 0, 0).restitution_squared), 0.9374755799, 1e-9);
  EXPECT_NEAR(std::sqrt(reference(3.0, 0, 0).restitution_squared), 0.3068967983, 1e-9);
}

TEST(ClosedForm, HuntCrossleyGradient) {
  // Differentiating x (1 + e) = ln(1 + x) - ln(1 - e x) gives de/dx in closed form.
  for (const double x : {0.1, 0.5, 1.0, 3.0}) {
    const double e = hunt_crossley(x);
    const double by_x = (1.0 + e) - 1.0 / (1.0 + x) - e / (1.0 - e * x);
    const double by_e = x - x / (1.0 - e * x);
    EXPECT_NEAR(reference(x, 0, 0).gradient[0], 2.0 * e * (-by_x / by_e), 1e-7) << "x = " << x;
  }
}

TEST(ClosedForm, WithoutDampingEverythingComesBack) {
  for (const double beta : {0.0, 0.01, 0.3, 1.0, 3.0}) {
    const ImpactResult impact = reference(0.0, beta, 0.0);
    EXPECT_NEAR(impact.restitution_squared, 1.0, 1e-9) << "beta = " << beta;
    EXPECT_EQ(impact.outcome, ImpactOutcome::rebound);
  }
}

TEST(ClosedForm, HertzContactTimeAndDepth) {
  const ImpactResult impact = reference(0.0, 0.0, 0.0);
  const double depth = std::pow(1.25, 0.4);  // (5 / 4)^(2/5)
  EXPECT_NEAR(impact.penetration_max, depth, 1e-9);
  const double time = 2.0 * std::sqrt(std::numbers::pi) * gsl_sf_gamma(1.4) / gsl_sf_gamma(0.9);
  EXPECT_NEAR(impact.contact_time, time * depth, 1e-9);
  EXPECT_NEAR(impact.force_compression, std::pow(depth, 1.5), 1e-9);
  EXPECT_EQ(impact.force_tension, 0.0);
}

TEST(ClosedForm, DepthWithAdhesionIsTheTurningPointOfTheEnergy) {
  for (const double beta : {0.1, 1.0, 5.0}) {
    const double x = reference(0.0, beta, 0.0).penetration_max;
    EXPECT_NEAR(0.4 * std::pow(x, 2.5) - 2.0 / 3.0 * beta * std::pow(x, 1.5), 0.5, 1e-8);
  }
}

/// First-order loss at damping epsilon (g, h): 1 - e^2 = (2 / w^2) [g I(1/2) + 2 h I(3/2)],
/// I(p) = int x^p v dx over one way of the conservative motion.
double conservative_integral(double w, double power) {
  const auto speed_squared = [w](double x) {
    return w * w + 4.0 / 3.0 * std::pow(x, 1.5) - 0.8 * std::pow(x, 2.5);
  };
  double low = 0.0, high = 10.0 + 4.0 * w;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (speed_squared(middle) > 0.0 ? low : high) = middle;
  }
  struct Context {
    double w, power, turning;
  } context{w, power, low};
  gsl_function function;
  function.params = &context;
  function.function = [](double theta, void* p) {  // x = x_max sin^2: the end behaves
    const auto& c = *static_cast<Context*>(p);
    const double s = std::sin(theta);
    const double x = c.turning * s * s;
    const double v2 = c.w * c.w + 4.0 / 3.0 * std::pow(x, 1.5) - 0.8 * std::pow(x, 2.5);
    return std::pow(x, c.power) * std::sqrt(std::max(v2, 0.0)) * 2.0 * c.turning * s *
           std::cos(theta);
  };
  gsl_integration_workspace* space = gsl_integration_workspace_alloc(1000);
  double value = 0.0, error = 0.0;
  gsl_integration_qags(&function, 0.0, std::numbers::pi / 2.0, 0.0, 1e-10, 1000, space, &value,
                       &error);
  gsl_integration_workspace_free(space);
  return value;
}

TEST(ClosedForm, FirstOrderLossAtAnyVelocity) {
  for (const double w : {0.5, 1.0, 5.0, 50.0}) {
    const double g = 1e-5, h = 2e-6;
    const double expected =
        2.0 / (w * w) *
        (g * conservative_integral(w, 0.5) + 2.0 * h * conservative_integral(w, 1.5));
    const double loss = 1.0 - in_adhesion_units(w, h, g).restitution_squared;
    EXPECT_NEAR(loss / expected, 1.0, 1e-3) << "w = " << w;
    const double both =
        1.0 - in_adhesion_units(w, h, g, AdhesionDampingPhase::both).restitution_squared;
    const double expected_both =
        2.0 / (w * w) *
        (2.0 * g * conservative_integral(w, 0.5) + 2.0 * h * conservative_integral(w, 1.5));
    EXPECT_NEAR(both / expected_both, 1.0, 1e-3) << "w = " << w;
  }
}

TEST(ClosedForm, LossAtHighVelocity) {
  // 1 - e^2 -> 1.1534 g w^(1/5) + (4/3) h w for weak damping far above V_a.
  const double w = 1e5;
  EXPECT_NEAR((1.0 - in_adhesion_units(w, 0.0, 1e-6).restitution_squared) /
                  (1.1534 * 1e-6 * std::pow(w, 0.2)),
              1.0, 1e-3);
  EXPECT_NEAR(
      (1.0 - in_adhesion_units(w, 1e-10, 0.0).restitution_squared) / (4.0 / 3.0 * 1e-10 * w), 1.0,
      1e-3);
}

/// w* by bisection on the sign of the energy left.
double capture_by_bisection(double h, double g, AdhesionDampingPhase phase) {
  double low = 1e-4, high = 5.0;
  for (int i = 0; i < 26; ++i) {  // to 2e-7; each step is a slow impact, near capture
    const double middle = std::sqrt(low * high);
    (in_adhesion_units(middle, h, g, phase).restitution_squared > 0.0 ? high : low) = middle;
  }
  return low;
}

TEST(CaptureLaw, SmallDamping) {
  // w*^2 = 2 J (g + 2 h), J = (5/3)^(3/2) sqrt((4/3)(5/3)^(3/2)) B(9/4, 3/2) (rebound reading)
  const double J = std::pow(5.0 / 3.0, 1.5) * std::sqrt(4.0 / 3.0 * std::pow(5.0 / 3.0, 1.5)) *
                   gsl_sf_beta(2.25, 1.5);
  EXPECT_NEAR(J, 0.827350, 1e-6);
  for (const auto& [h, g] : {std::pair{0.0, 1e-4}, std::pair{5e-5, 0.0}, std::pair{2e-5, 6e-5}}) {
    EXPECT_NEAR(capture_by_bisection(h, g, AdhesionDampingPhase::rebound) /
                    std::sqrt(2.0 * J * (g + 2.0 * h)),
                1.0, 2e-4);
    EXPECT_NEAR(
        capture_by_bisection(h, g, AdhesionDampingPhase::both) / std::sqrt(4.0 * J * (g + h)), 1.0,
        2e-4);
  }
}

TEST(CaptureLaw, NextOrders) {
  for (const double g : {0.01, 0.05, 0.1, 0.2, 0.3}) {
    const double law = 1.2864 * std::sqrt(g) * (1.0 + 0.81 * g + 0.62 * g * g + 0.78 * g * g * g);
    EXPECT_NEAR(capture_by_bisection(0.0, g, AdhesionDampingPhase::rebound) / law, 1.0, 2e-3)
        << "g = " << g;
  }
}

TEST(ClosedForm, KuwabaraKonoSeries) {
  // In the limit of no conservative adhesion the C_A term is the dashpot n^(1/2) n' of Kuwabara &
  // Kono: e = 1 - 1.15345 b + 0.7983 b^2 - ..., b = beta gamma.
  const double tiny = 1e-9;
  for (const double b : {1e-3, 5e-3, 2e-2}) {
    const ImpactResult impact = reference(0.0, tiny, b / tiny, AdhesionDampingPhase::both);
    EXPECT_NEAR(std::sqrt(impact.restitution_squared), 1.0 - 1.15345 * b + 0.7983 * b * b,
                0.6 * b * b * b + 1e-7)
        << "b = " << b;
  }
}

RC_GTEST_PROP(Scaling, RestitutionDependsOnThreeVelocitiesOnly, ()) {
  // e(V; K, f0, r, rho, C) is unchanged by any change that keeps V_a, and e(lambda V; C / lambda,
  // lambda V_a) = e(V).
  const double scale = std::pow(10.0, *rc::gen::inRange(-200, 201) / 100.0);
  const double f0 = std::pow(10.0, *rc::gen::inRange(-100, 101) / 100.0);
  const ImpactConditions c{4.9e-6, 5.0, 1350.0, 1.789e9, 8.9, 3e-3, 0.03};
  ImpactConditions changed = c;
  changed.adhesion_force = c.adhesion_force * f0;
  changed.stiffness = c.stiffness * std::pow(f0, 5.0 / 3.0);  // V_a ~ f0^(5/4) K^(-3/4)
  changed.density = c.density;
  changed.velocity = c.velocity * scale;
  changed.hertz_damping = c.hertz_damping / scale;
  changed.adhesion_damping = c.adhesion_damping / scale;
  changed.adhesion_force *= std::pow(scale, 0.8);  // V_a ~ f0^(5/4)
  RC_ASSERT(std::abs(adhesion_velocity(changed) / adhesion_velocity(c) / scale - 1.0) < 1e-12);
  const double e2 = simulate_impact(impact_groups(c)).restitution_squared;
  RC_ASSERT(std::abs(simulate_impact(impact_groups(changed)).restitution_squared - e2) < 1e-9);
}

}  // namespace
}  // namespace recoil
