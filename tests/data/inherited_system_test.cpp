// Which constants of a dataset another one with the same materials takes over.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "data/datapackage.hpp"

namespace {

using recoil::Json;
using recoil::leave_out_contradictions;
using recoil::LeftOverride;

// Steel on silicon. By hand: K = (4/3) / ((1 - 0.3^2) / 193e9 + (1 - 0.28^2) / 131e9) = 113.4738
// GPa (eq. 6); W = 2 sqrt(gamma1 gamma2) with gamma = E (1.3e-10 / pi)^2 / 2e-10 (eq. 11) = 2.72271
// J/m2; f0 = (9 W^2 K r / (2 pi))^(1/3) (eq. 12) = 308.8546 N/m at 49 um with the printed W = 2.72.
Json steel() {
  return Json::parse(R"json({
    "particle": {"material": "steel", "density": 7900, "youngs_modulus": 193e9,
                 "poisson_ratio": 0.3},
    "surface": {"material": "silicon", "youngs_modulus": 131e9, "poisson_ratio": 0.28}})json");
}

std::vector<std::string> keys_of(const std::vector<LeftOverride>& left) {
  std::vector<std::string> keys;
  for (const LeftOverride& one : left) keys.push_back(one.key);
  return keys;
}

using Keys = std::vector<std::string>;

TEST(InheritedSystem, ThePrintedSteelRowKeepsItsSlipForItself) {
  Json system = steel();
  system["stiffness_K"] = 11.4e9;
  system["adhesion_energy"] = 2.72;
  system["adhesion_force_f0"] = 288.0;
  system["reference_diameter"] = 49e-6;
  const auto left = leave_out_contradictions(system);
  ASSERT_EQ(keys_of(left), (Keys{"stiffness_K", "adhesion_force_f0"}));
  EXPECT_EQ(left[0].stated, 11.4e9);
  EXPECT_NEAR(left[0].derived, 113.473821e9, 1e3);
  EXPECT_EQ(left[1].stated, 288.0);
  EXPECT_NEAR(left[1].derived, 308.854598, 1e-5);
  Json rest = steel();
  rest["adhesion_energy"] = 2.72;  // agrees
  EXPECT_EQ(system, rest);
}

TEST(InheritedSystem, WhatAgreesStays) {
  Json system = steel();
  system["stiffness_K"] = 113e9;  // 0.4 % below
  system["adhesion_energy"] = 2.70;
  system["adhesion_force_f0"] = 309.0;
  system["reference_diameter"] = 49e-6;
  const Json before = system;
  EXPECT_TRUE(leave_out_contradictions(system).empty());
  EXPECT_EQ(system, before);
}

TEST(InheritedSystem, AForceThatAgreesOnlyWithAWrongStiffnessGoesWithIt) {
  Json system = steel();
  system["stiffness_K"] = 11.4e9;
  system["adhesion_force_f0"] = 143.6;  // eq. 12 with K = 11.4 GPa
  system["reference_diameter"] = 49e-6;
  EXPECT_EQ(keys_of(leave_out_contradictions(system)), (Keys{"stiffness_K", "adhesion_force_f0"}));
  EXPECT_EQ(system, steel());
}

TEST(InheritedSystem, NoAdhesionContradictsNothing) {
  Json system = steel();
  system["adhesion_energy"] = 0;
  EXPECT_TRUE(leave_out_contradictions(system).empty());
  EXPECT_EQ(system["adhesion_energy"], 0);
  system["adhesion_energy"] = 0.05;
  EXPECT_EQ(keys_of(leave_out_contradictions(system)), Keys{"adhesion_energy"});
}

TEST(InheritedSystem, AStatedSurfaceEnergyIsWhatTheAdhesionEnergyIsHeldAgainst) {
  Json system = steel();
  system["particle"]["surface_energy"] = 0.04;
  system["surface"]["surface_energy"] = 0.09;
  system["adhesion_energy"] = 0.12;  // 2 sqrt(0.04 * 0.09)
  EXPECT_TRUE(leave_out_contradictions(system).empty());
}

TEST(InheritedSystem, WhatIsStatedAnewIsKeptAndDecides) {
  // With W = 0.05 J/m2 eq. 12 gives 308.8546 (0.05 / 2.72)^(2/3) = 21.5124 N/m.
  Json system = steel();
  system["adhesion_energy"] = 0.05;
  system["adhesion_force_f0"] = 308.8546;
  system["reference_diameter"] = 49e-6;
  const auto left = leave_out_contradictions(system, {"adhesion_energy"});
  ASSERT_EQ(keys_of(left), Keys{"adhesion_force_f0"});
  EXPECT_NEAR(left[0].derived, 21.51236, 1e-4);
  EXPECT_EQ(system["adhesion_energy"], 0.05);
}

TEST(InheritedSystem, WhatCannotBeReadIsLeftToItsReader) {
  Json system = steel();
  system["stiffness_K"] = 11.4e9;
  system["surface"].erase("youngs_modulus");
  const Json before = system;
  EXPECT_TRUE(leave_out_contradictions(system).empty());
  EXPECT_EQ(system, before);
}

}  // namespace
