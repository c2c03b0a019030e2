// Table 1 of Li, Dunn & Brach (1999), recomputed from elastic constants.
#include "data/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace recoil {
namespace {

struct TableRow {
  const char* name;
  double E1, nu1, E2, nu2, diameter, K, W, f0;
};

// Elastic constants of the two solids; K [Pa], W_A [J/m2] and f0 [N/m] as the paper prints them.
const TableRow table_1[] = {
    {"molybdenum", 1.20e9, 0.33, 320e9, 0.31, 4.9e-6, 1.789e9, 0.336, 8.90},
    {"silicon", 1.20e9, 0.33, 131e9, 0.28, 4.9e-6, 1.776e9, 0.216, 6.60},
    {"mica", 1.20e9, 0.33, 90e9, 0.30, 4.9e-6, 1.771e9, 0.178, 5.81},
    {"quartz", 2.56e9, 0.35, 73e9, 0.17, 1.28e-6, 3.745e9, 0.235, 5.74},
};

ImpactSystem system_of(const TableRow& row) {
  ImpactSystem system;
  system.particle = {"particle", 1350.0, row.E1, row.nu1, std::nullopt};
  system.surface = {"surface", 0.0, row.E2, row.nu2, std::nullopt};
  return system;
}

TEST(Contact, ReproducesTableOne) {
  for (const TableRow& row : table_1) {
    const ContactProperties contact = derive_contact(system_of(row), row.diameter);
    EXPECT_NEAR(contact.stiffness / row.K, 1.0, 3e-3) << row.name;
    EXPECT_NEAR(contact.adhesion_energy / row.W, 1.0, 1e-2) << row.name;
    EXPECT_NEAR(contact.adhesion_force / row.f0, 1.0, 1e-2) << row.name;
    EXPECT_TRUE(contact.contradictions.empty()) << row.name;
  }
}

TEST(Contact, EquationsNineTenAndTwelveAgree) {
  // f0 = (18 K r gamma1 gamma2 / pi)^(1/3), eq. 12 as printed.
  const ContactProperties c = derive_contact(system_of(table_1[0]), 4.9e-6);
  const double twelve = std::cbrt(18.0 * c.stiffness * 2.45e-6 * c.gamma_particle *
                                  c.gamma_surface / std::numbers::pi);
  EXPECT_NEAR(c.adhesion_force / twelve, 1.0, 1e-12);
  // eq. 8: at equilibrium the ring force balances Hertz, 2 pi a f0 = sqrt(r) K n^(3/2), a^2 = r n.
  const double n = c.equilibrium_radius * c.equilibrium_radius / 2.45e-6;
  EXPECT_NEAR(2.0 * std::numbers::pi * c.equilibrium_radius * c.adhesion_force /
                  (std::sqrt(2.45e-6) * c.stiffness * std::pow(n, 1.5)),
              1.0, 1e-12);
}

TEST(Contact, AdhesionForceGrowsWithTheCubeRootOfTheRadius) {
  const ContactProperties at_reference = derive_contact(system_of(table_1[0]), 4.9e-6);
  const double derived = derive_contact(system_of(table_1[0]), 2.58e-6).adhesion_force;
  EXPECT_NEAR(at_reference.adhesion_force_at(at_reference.adhesion_force, 2.58e-6), derived, 1e-12);
}

TEST(Contact, SteelRowContradictsItselfAndSaysWhichIsUsed) {
  ImpactSystem steel;
  steel.particle = {"steel", 7900.0, 193e9, 0.30, std::nullopt};
  steel.surface = {"silicon", 0.0, 131e9, 0.28, std::nullopt};
  steel.stiffness_K = 11.4e9;
  steel.adhesion_force_f0 = 288.0;
  steel.reference_diameter = 49e-6;
  const ContactProperties contact = derive_contact(steel, 1e-6);
  EXPECT_EQ(contact.stiffness, 11.4e9);
  EXPECT_EQ(contact.adhesion_force, 288.0);
  EXPECT_NEAR(contact.stiffness_derived / 113e9, 1.0, 0.02);
  EXPECT_NEAR(contact.adhesion_force_derived / 143.6, 1.0, 0.02);
  ASSERT_EQ(contact.contradictions.size(), 2U);
  EXPECT_NE(contact.contradictions[0].find("the stated K = 11.4 GPa is used"), std::string::npos);
  EXPECT_NE(contact.contradictions[1].find("the stated f0 = 288 N/m is used"), std::string::npos);
}

TEST(Contact, NoAdhesionAtAll) {
  ImpactSystem system = system_of(table_1[0]);
  system.adhesion_energy = 0.0;
  const ContactProperties contact = derive_contact(system, 4.9e-6);
  EXPECT_EQ(contact.adhesion_force, 0.0);
  EXPECT_TRUE(contact.contradictions.empty());
}

}  // namespace
}  // namespace recoil
