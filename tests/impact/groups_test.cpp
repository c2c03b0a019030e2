// The dimensionless groups of an impact and the scales that lead back to SI.
#include <gtest/gtest.h>

#include <cmath>

#include "data/contact.hpp"
#include "impact/impact.hpp"

namespace recoil {
namespace {

TEST(Groups, AdhesionVelocityOfThePublishedSystems) {
  // V_a [m/s] = (2 pi f0)^(5/4) r^(1/4) K^(-3/4) m^(-1/2), worked out by hand from Table 1.
  const auto V_a = [](double d, double rho, double K, double f0) {
    return adhesion_velocity({d, 1.0, rho, K, f0, 0.0, 0.0});
  };
  EXPECT_NEAR(V_a(4.9e-6, 1350, 1.789e9, 8.9), 2.41, 0.01);
  EXPECT_NEAR(V_a(4.9e-6, 1350, 1.776e9, 6.6), 1.67, 0.01);
  EXPECT_NEAR(V_a(1.27e-6, 1050, 3.745e9, 5.74), 4.91, 0.03);
  EXPECT_NEAR(V_a(49e-6, 7950, 114e9, 309.0), 0.210, 0.002);
}

TEST(Groups, ScalesTurnTheGroupsBackIntoSI) {
  const ImpactConditions c{4.9e-6, 5.2, 1350.0, 1.789e9, 8.9, 3e-3, 0.03};
  const ImpactScales scales = impact_scales(c);
  const ImpactGroups groups = impact_groups(c);
  EXPECT_NEAR(groups.beta, std::pow(c.velocity / adhesion_velocity(c), -0.8), 1e-12);
  // Hertz force at n_c in SI against the force scale.
  EXPECT_NEAR(std::sqrt(2.45e-6) * c.stiffness * std::pow(scales.length, 1.5) / scales.force, 1.0,
              1e-12);
  EXPECT_NEAR(scales.energy, sphere_mass(c.diameter, c.density) * 5.2 * 5.2, 1e-24);
}

}  // namespace
}  // namespace recoil
