// The law with a dashpot along the contact radius: closed forms, an independent integrator, and the
// two solvers against each other.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "impact/impact.hpp"
#include "support/independent_impact.hpp"

namespace recoil {
namespace {

ImpactOptions with_dashpot(AdhesionDampingPhase phase = AdhesionDampingPhase::rebound) {
  ImpactOptions options;
  options.phase = phase;
  options.dashpot = true;
  options.gradient = true;
  return options;
}

TEST(Dashpot, SmallLossesFollowTheSeriesOfKuwabaraAndKono) {
  // e = 1 - c k + d k^2 - ...; c = 2 x_m^(3/2) (2/5) B(3/5, 3/2) with x_m = (5/4)^(2/5).
  const double c =
      0.8 * std::pow(1.25, 0.6) * std::exp(std::lgamma(0.6) + std::lgamma(1.5) - std::lgamma(2.1));
  EXPECT_NEAR(c, 1.15345, 1e-5);
  for (const double kappa : {1e-3, 1e-2, 3e-2}) {
    const ImpactResult impact = simulate_impact({0.0, 0.0, 0.0, kappa}, with_dashpot());
    EXPECT_NEAR(std::sqrt(impact.restitution_squared), 1.0 - c * kappa + 0.7983 * kappa * kappa,
                0.6 * kappa * kappa * kappa + 1e-9);
    EXPECT_NEAR(impact.gradient[3], -2.0 * c + 2.0 * (c * c + 2.0 * 0.7983) * kappa,
                10.0 * kappa * kappa + 1e-7);
  }
}

TEST(Dashpot, WithAdhesionDampedInBothPhasesItIsMoreOfThatDamping) {
  // beta gamma x^(1/2) u and kappa x^(1/2) u are one force.
  ImpactOptions plain;
  plain.phase = AdhesionDampingPhase::both;
  plain.gradient = true;
  const ImpactResult one = simulate_impact({0.03, 0.4, 0.3 + 0.05 / 0.4, 0.0}, plain);
  const ImpactResult other =
      simulate_impact({0.03, 0.4, 0.3, 0.05}, with_dashpot(AdhesionDampingPhase::both));
  EXPECT_NEAR(one.restitution_squared, other.restitution_squared, 1e-9);
  EXPECT_NEAR(other.gradient[3], one.gradient[2] / 0.4, 1e-7);
}

TEST(Dashpot, BothSolversAgreeWithAnIndependentIntegratorAndItsComplexStep) {
  using Complex = std::complex<double>;
  for (const bool both : {false, true}) {
    for (const ImpactGroups& g :
         {ImpactGroups{0.0, 0.0, 0.0, 0.3}, ImpactGroups{0.02, 0.5, 0.1, 0.1},
          ImpactGroups{0.01, 0.1, 1.0, 0.02}, ImpactGroups{0.0, 2.5, 0.01, 0.05},
          ImpactGroups{0.1, 0.7, 0.2, 0.0}, ImpactGroups{0.05, 1.0, 0.3, 0.8}}) {
      const ImpactOptions options =
          with_dashpot(both ? AdhesionDampingPhase::both : AdhesionDampingPhase::rebound);
      const ImpactResult fast = simulate_impact_fast(g, options);
      const ImpactResult reference = simulate_impact(g, options);
      ASSERT_TRUE(fast.usable() && reference.usable());
      const independent::Groups<double> same{g.alpha, g.beta, g.gamma, g.kappa};
      const double expected = independent::twice_energy_left(same, both);
      EXPECT_NEAR(fast.restitution_squared, expected, 1e-9);
      EXPECT_NEAR(reference.restitution_squared, expected, 1e-9);
      for (std::size_t k = 0; k < 4; ++k) {
        independent::Groups<Complex> moved{g.alpha, g.beta, g.gamma, g.kappa};
        (k == 0   ? moved.alpha
         : k == 1 ? moved.beta
         : k == 2 ? moved.gamma
                  : moved.kappa) += Complex(0.0, 1e-30);
        const double slope = independent::twice_energy_left(moved, both).imag() / 1e-30;
        EXPECT_NEAR(fast.gradient[k], slope, 1e-7 * std::max(1.0, std::abs(slope))) << k;
        EXPECT_NEAR(reference.gradient[k], slope, 1e-7 * std::max(1.0, std::abs(slope))) << k;
      }
    }
  }
}

TEST(Dashpot, ThatNeverPullsIsThatOfTheIndependentIntegrator) {
  using Complex = std::complex<double>;
  constexpr double step = 1e-4;  // across the end of the push it is good to its square
  for (const ImpactGroups& g :
       {ImpactGroups{0.0, 0.0, 0.0, 0.3}, ImpactGroups{0.02, 0.05, 0.1, 0.4},
        ImpactGroups{0.1, 1e-6, 1.0, 2.0}, ImpactGroups{0.0, 1e-4, 0.01, 12.5},
        ImpactGroups{0.05, 0.7, 0.3, 0.8}, ImpactGroups{0.0, 1.5, 0.0, 1e-3}}) {
    ImpactOptions options = with_dashpot();
    options.never_pulls = true;
    const ImpactResult fast = simulate_impact_fast(g, options);
    const ImpactResult reference = simulate_impact(g, options);
    ASSERT_TRUE(fast.usable() && reference.usable());
    const independent::Groups<double> same{g.alpha, g.beta, g.gamma, g.kappa, true};
    EXPECT_NEAR(reference.restitution_squared, independent::twice_energy_left(same, false, step),
                1e-7);
    EXPECT_NEAR(fast.restitution_squared, reference.restitution_squared, 1e-9);
    for (std::size_t k = 0; k < 4; ++k) {
      independent::Groups<Complex> moved{g.alpha, g.beta, g.gamma, g.kappa, true};
      (k == 0   ? moved.alpha
       : k == 1 ? moved.beta
       : k == 2 ? moved.gamma
                : moved.kappa) += Complex(0.0, 1e-30);
      const double slope = independent::twice_energy_left(moved, false, step).imag() / 1e-30;
      EXPECT_NEAR(reference.gradient[k], slope, 1e-3 * std::max(1.0, std::abs(slope))) << k;
      EXPECT_NEAR(fast.gradient[k], reference.gradient[k], 1e-6 * std::max(1.0, std::abs(slope)))
          << k;
    }
  }
}

TEST(Dashpot, NeverPullsAtVanishingAdhesionAsWithoutOne) {
  for (const bool limited : {false, true}) {
    for (const double kappa : {0.02, 0.4, 3.0}) {
      ImpactOptions options = with_dashpot();
      options.never_pulls = limited;
      const double without = simulate_impact({0.05, 0.0, 0.1, kappa}, options).restitution_squared;
      for (const AdhesionLaw law : {AdhesionLaw::ring, AdhesionLaw::jkr, AdhesionLaw::dmt}) {
        options.adhesion = law;
        const ImpactGroups g{0.05, 1e-12, 0.1, kappa};
        EXPECT_NEAR(simulate_impact_fast(g, options).restitution_squared, without, 1e-7) << kappa;
        EXPECT_NEAR(simulate_impact(g, options).restitution_squared, without, 1e-7) << kappa;
      }
    }
  }
}

TEST(Dashpot, WithoutOneNothingChanges) {
  const ImpactGroups g{0.02, 0.5, 0.3};
  ImpactOptions plain;
  plain.gradient = true;
  EXPECT_NEAR(simulate_impact_fast(g, plain).restitution_squared,
              simulate_impact_fast(g, with_dashpot()).restitution_squared, 1e-10);
  EXPECT_EQ(simulate_impact(g, plain).gradient[3], 0.0);
}

TEST(Dashpot, IsRefusedWhereTheLawHasNone) {
  const ImpactGroups g{0.02, 0.5, 0.3, 0.1};
  EXPECT_FALSE(simulate_impact(g).usable());
  EXPECT_FALSE(simulate_impact_fast(g, {}).usable());
  EXPECT_FALSE(simulate_impact_fast({0.0, 0.5, 0.3, -0.1}, with_dashpot()).usable());
}

TEST(Dashpot, TheEnergyBudgetCloses) {
  ImpactOptions options = with_dashpot();
  options.gradient = false;
  options.budget = true;
  for (const bool never_pulls : {false, true}) {
    options.never_pulls = never_pulls;
    for (const double beta : {0.0, 0.01, 0.4}) {
      const ImpactResult impact = simulate_impact({0.05, beta, 0.2, 0.1}, options);
      EXPECT_GT(impact.energy.dashpot_loss, 0.01);
      EXPECT_NEAR(impact.energy.audit(), 0.0, 1e-9);
      if (never_pulls && beta == 0.0) {
        EXPECT_LE(impact.force_tension, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace recoil
