// The truth simulator of the ring-adhesion model against closed forms and expansions that it does
// not use.
#include <gsl/gsl_sf_lambert.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "validation/truth/impact_truth.hpp"
#include "validation/truth/truth.hpp"

namespace recoil {
namespace {

using std::numbers::pi;

TrueContact fluorescein_on_molybdenum() {
  TrueContact contact;
  contact.stiffness = 1.789e9;
  contact.adhesion = 8.9;
  contact.radius = 2.45e-6;
  contact.mass = 1350.0 * 4.0 / 3.0 * pi * std::pow(contact.radius, 3);
  return contact;
}

/// V_a = (2 pi f0)^(5/4) r^(1/4) K^(-3/4) m^(-1/2) [m/s].
double adhesion_velocity(const TrueContact& c) {
  return std::pow(2.0 * pi * c.adhesion, 1.25) * std::pow(c.radius, 0.25) *
         std::pow(c.stiffness, -0.75) / std::sqrt(c.mass);
}

double capture_velocity(const TrueContact& contact) {
  double captured = 1e-3 * adhesion_velocity(contact);
  double free = 5.0 * adhesion_velocity(contact);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (captured + free);
    (true_impact(contact, middle).rebounded ? free : captured) = middle;
  }
  return free;
}

TEST(RingAdhesionTruth, HuntCrossleyAloneFollowsLambertW) {
  TrueContact contact = fluorescein_on_molybdenum();
  contact.adhesion = 0.0;
  contact.C_H = 0.1;
  for (const double x : {0.01, 0.1, 0.5, 1.0, 3.0, 10.0}) {
    const double e = true_impact(contact, x / contact.C_H).restitution;
    const double exact = (1.0 + gsl_sf_lambert_W0(-(1.0 + x) * std::exp(-(1.0 + x)))) / x;
    EXPECT_NEAR(e, exact, 1e-9) << "C_H V = " << x;
  }
}

TEST(RingAdhesionTruth, WithoutDampingNothingIsLost) {
  const TrueContact contact = fluorescein_on_molybdenum();
  for (const double v : {0.05, 0.5, 2.0, 20.0, 200.0}) {
    EXPECT_NEAR(true_impact(contact, v).restitution, 1.0, 1e-9) << v << " m/s";
  }
}

TEST(RingAdhesionTruth, HertzContactTimeAndDepth) {
  TrueContact contact = fluorescein_on_molybdenum();
  contact.adhesion = 0.0;
  const double A = std::sqrt(contact.radius) * contact.stiffness / contact.mass;
  const double v = 5.2;
  const double depth = std::pow(5.0 * v * v / (4.0 * A), 0.4);
  const double factor = 2.0 * std::sqrt(pi) * std::tgamma(1.4) / std::tgamma(0.9);
  const TrueImpact impact = true_impact(contact, v);
  EXPECT_NEAR(impact.deepest / depth, 1.0, 1e-10);
  EXPECT_NEAR(impact.contact_time / (factor * depth / v), 1.0, 1e-8);
}

TEST(RingAdhesionTruth, CaptureLawOfSmallDamping) {
  // V*^2 = 2 J (C_A + 2 C_H) V_a^3, J = (5/3)^(3/2) sqrt((4/3)(5/3)^(3/2)) B(9/4, 3/2); for the
  // adhesion damping the next orders are (1 + 0.81 g + 0.62 g^2 + 0.78 g^3) on V*.
  const double beta = std::tgamma(2.25) * std::tgamma(1.5) / std::tgamma(3.75);
  const double J =
      std::pow(5.0 / 3.0, 1.5) * std::sqrt(4.0 / 3.0 * std::pow(5.0 / 3.0, 1.5)) * beta;
  EXPECT_NEAR(std::sqrt(2.0 * J), 1.2864, 1e-4);
  TrueContact contact = fluorescein_on_molybdenum();
  const double V_a = adhesion_velocity(contact);
  for (const double g : {1e-4, 0.01, 0.05, 0.1, 0.2, 0.3}) {
    contact.C_A = g / V_a;
    const double next = 1.0 + 0.81 * g + 0.62 * g * g + 0.78 * g * g * g;
    EXPECT_NEAR(capture_velocity(contact) / (std::sqrt(2.0 * J * g) * V_a), next, 2e-3) << g;
  }
  const double small = 1e-4;
  contact.C_A = 0.0;
  contact.C_H = small / V_a;
  EXPECT_NEAR(capture_velocity(contact) / (std::sqrt(4.0 * J * small) * V_a), 1.0, 1e-3);
}

TEST(RingAdhesionTruth, DampingBothPhasesDoublesTheSmallLoss) {
  TrueContact contact = fluorescein_on_molybdenum();
  contact.C_A = 1e-4 / adhesion_velocity(contact);
  const double v = 10.0;
  const auto loss = [&] { return 1.0 - std::pow(true_impact(contact, v).restitution, 2); };
  const double rebound_only = loss();
  contact.damped_in_both_phases = true;
  EXPECT_NEAR(loss() / rebound_only, 2.0, 1e-3);
}

TEST(RingAdhesionTruth, AdhesionLossIsTheWholeLossWithoutTheOther) {
  TrueContact contact = fluorescein_on_molybdenum();
  contact.C_A = 0.03;
  const TrueImpact alone = true_impact(contact, 5.2);
  EXPECT_NEAR(alone.adhesion_loss, 1.0 - alone.restitution * alone.restitution, 1e-9);
  // A captured sphere is at rest when it turns inwards: it has lost more than it brought.
  EXPECT_GT(true_impact(contact, 0.5).adhesion_loss, 1.0);
  contact.C_H = 1e-7;  // small losses add
  const double more = 1.0 - std::pow(true_impact(contact, 5.2).restitution, 2);
  contact.C_A = 0.0;
  const TrueImpact other = true_impact(contact, 5.2);
  EXPECT_EQ(other.adhesion_loss, 0.0);
  EXPECT_NEAR(more - alone.adhesion_loss, 1.0 - other.restitution * other.restitution, 1e-6);
}

TEST(RingAdhesionTruth, OnlyTheThreeVelocitiesCount) {
  // e depends on V/V_a, C_H V_a and C_A V_a alone.
  TrueContact one = fluorescein_on_molybdenum();
  one.C_H = 0.03;
  one.C_A = 0.08;
  TrueContact other = one;
  other.stiffness = 113e9;
  other.radius = 24.5e-6;
  other.mass = 4.9e-10;
  other.adhesion = 309.0;
  const double ratio = adhesion_velocity(other) / adhesion_velocity(one);
  other.C_H /= ratio;
  other.C_A /= ratio;
  for (const double v : {3.0, 10.0, 30.0}) {
    EXPECT_NEAR(true_impact(one, v).restitution, true_impact(other, ratio * v).restitution, 1e-9);
  }
}

TEST(RingAdhesionTruth, DerivedInputsReproduceTable1) {
  Material fluorescein{"", 1350.0, 1.2e9, 0.33, {}};
  const struct {
    double modulus, poisson, K, W, f0;
  } rows[] = {{320e9, 0.31, 1.789e9, 0.336, 8.90},
              {131e9, 0.28, 1.776e9, 0.216, 6.60},
              {90e9, 0.30, 1.771e9, 0.178, 5.81}};
  for (const auto& row : rows) {
    const DerivedContact contact =
        derive_recipe_contact(fluorescein, {"", 0.0, row.modulus, row.poisson, {}});
    EXPECT_NEAR(contact.stiffness / row.K, 1.0, 3e-3);
    EXPECT_NEAR(contact.adhesion_energy / row.W, 1.0, 1e-2);
    EXPECT_NEAR(recipe_adhesion_force(row.K, row.W, 4.9e-6) / row.f0, 1.0, 5e-3);
  }
}

}  // namespace
}  // namespace recoil
