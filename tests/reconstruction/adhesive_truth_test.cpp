// The truth by JKR and DMT: closed forms, and the fitter's solver, which shares nothing with it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data/contact.hpp"
#include "impact/impact.hpp"
#include "validation/truth/impact_truth.hpp"
#include "validation/truth/truth.hpp"

namespace recoil {
namespace {

TrueContact fluorescein(bool jkr) {
  TrueContact contact;
  contact.law = jkr ? TrueAdhesion::jkr : TrueAdhesion::dmt;
  contact.stiffness = 1.789e9;
  contact.adhesion = 0.2;
  contact.radius = 2.45e-6;
  contact.mass = 1350.0 * 4.0 / 3.0 * std::numbers::pi * std::pow(contact.radius, 3);
  return contact;
}

TEST(AdhesiveTruth, JkrLosesItsClosedFormAndDmtNothing) {
  const TrueContact jkr = fluorescein(true);
  const double modulus = 0.75 * jkr.stiffness;
  const double lost = 7.092196 * std::cbrt(std::pow(jkr.adhesion, 5) * std::pow(jkr.radius, 4) /
                                           (modulus * modulus));
  for (const double V : {0.7, 2.0, 30.0}) {
    const double expected = 1.0 - lost / (0.5 * jkr.mass * V * V);
    EXPECT_NEAR(std::pow(true_impact(jkr, V).restitution, 2), expected, 1e-6);
    EXPECT_NEAR(true_impact(fluorescein(false), V).restitution, 1.0, 1e-9);
  }
  EXPECT_EQ(true_impact(jkr, 0.999 * std::sqrt(2.0 * lost / jkr.mass)).restitution, 0.0);
}

TEST(AdhesiveTruth, AgreesWithTheSolverOfTheFit) {
  for (const bool jkr : {true, false}) {
    for (const bool both : {true, false}) {
      TrueContact contact = fluorescein(jkr);
      contact.C_H = 5e-3;
      contact.C_A = 0.05;
      contact.damped_in_both_phases = both;
      for (const double V : {0.5, 1.5, 5.0, 40.0}) {
        const ImpactConditions conditions{
            2.0 * contact.radius,
            V,
            1350.0,
            contact.stiffness,
            adhesion_force_for(contact.adhesion, contact.radius, contact.stiffness),
            contact.C_H,
            contact.C_A};
        ImpactOptions options;
        options.adhesion = jkr ? AdhesionLaw::jkr : AdhesionLaw::dmt;
        options.phase = both ? AdhesionDampingPhase::both : AdhesionDampingPhase::rebound;
        const double expected =
            simulate_impact(impact_groups(conditions), options).restitution_squared;
        EXPECT_NEAR(true_impact(contact, V).restitution, std::sqrt(std::max(0.0, expected)), 1e-8)
            << V << (jkr ? " jkr" : " dmt");
      }
    }
  }
}

TEST(AdhesiveTruth, CapturesWhereItsImpactsAre) {
  Truth truth;
  truth.law = TrueAdhesion::jkr;
  truth.density = 1350.0;
  truth.stiffness = 1.789e9;
  truth.work = 0.2;
  truth.C_A = 0.05;
  const double capture = true_capture_velocity(truth, 4.9e-6);
  EXPECT_GT(true_restitution(truth, 4.9e-6, 1.001 * capture), 0.0);
  EXPECT_EQ(true_restitution(truth, 4.9e-6, 0.999 * capture), 0.0);
  truth.work = 0.0;
  EXPECT_NEAR(true_restitution(truth, 4.9e-6, capture), 1.0, 1e-9);
}

}  // namespace
}  // namespace recoil
