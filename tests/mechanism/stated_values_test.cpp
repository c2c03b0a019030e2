// What stated conditions make of parameters, worked out by hand.
#include <gtest/gtest.h>

#include "mechanism/mechanism.hpp"
#include "one_point.hpp"

namespace recoil {
namespace {

std::optional<double> stated(const std::string& id, std::size_t parameter, Condition condition,
                             double value, const Surroundings& at = one_point::kSoft) {
  Conditions conditions;
  conditions.set(condition, value);
  const auto said = stated_value(find_mechanism(id)->info.parameters.at(parameter), at, conditions);
  if (!said) return std::nullopt;
  EXPECT_EQ(said->by, condition);
  return said->value;
}

TEST(StatedValues, NothingIsSaidWithoutACondition) {
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    for (const Parameter& parameter : mechanism.info.parameters) {
      EXPECT_FALSE(stated_value(parameter, one_point::kSoft, {})) << parameter.name;
    }
  }
}

TEST(StatedValues, AGasHasThePressureAndTheWayThatAreStated) {
  EXPECT_EQ(stated("gas_film", 0, Condition::ambient_pressure, 101325.0), 101325.0);
  EXPECT_EQ(stated("gas_film", 1, Condition::probe_height, 2e-3), 2e-3);
  EXPECT_EQ(stated("gas_film", 0, Condition::probe_height, 2e-3), std::nullopt);
  // Flights may have been reduced already, but in vacuum nothing brakes them.
  EXPECT_EQ(stated("flight_drag", 0, Condition::ambient_pressure, 101325.0), std::nullopt);
  EXPECT_EQ(stated("flight_drag", 0, Condition::ambient_pressure, 1.0), 0.0);
}

TEST(StatedValues, AFilmIsAsThickAsStatedAndRestsOnTheStatedRoughness) {
  EXPECT_EQ(stated("liquid_film", 1, Condition::film_thickness, 3e-6), 3e-6);
  EXPECT_EQ(stated("liquid_film", 1, Condition::film_thickness, 0.0), 0.0);
  EXPECT_EQ(stated("liquid_film", 2, Condition::surface_rms_roughness, 2e-8), 2e-8);
  EXPECT_EQ(stated("liquid_film", 0, Condition::film_thickness, 3e-6), std::nullopt);
  EXPECT_EQ(stated("liquid_film", 0, Condition::film_thickness, 0.0), 0.0);
}

TEST(StatedValues, ALiquidIsLookedForWhereOneIsStated) {
  const Mechanism& film = *find_mechanism("liquid_film");
  Surroundings at = one_point::kSoft;
  EXPECT_FALSE(film.is_possible_at(at));
  at.conditions.set(Condition::film_thickness, 0.0);
  EXPECT_FALSE(film.is_possible_at(at));
  at.of_series.resize(2);
  at.of_series[1].set(Condition::film_thickness, 1e-6);
  EXPECT_TRUE(film.is_possible_at(at));
  EXPECT_TRUE(find_mechanism("gas_film")->is_possible_at(one_point::kSoft));
}

/// gamma V_m / (R T) = 0.0728 N/m 1.805e-5 m3/mol / (8.31446 J/(mol K) 293.15 K) = 0.53912 nm.
TEST(StatedValues, ABridgeIsAsLongAsTheMeniscusIsWide) {
  const auto length = [](double h) {
    return stated("capillary", 0, Condition::relative_humidity, h).value();
  };
  EXPECT_NEAR(length(0.5), 0.53912e-9 / 0.693147, 1e-14);
  EXPECT_NEAR(length(0.9), 0.53912e-9 / 0.105361, 1e-13);
  EXPECT_EQ(length(0.0), 0.0);
  EXPECT_EQ(length(1.0), 1e-5);  // where water condenses anyhow: the largest that is tried
}

/// Vapour of less than 100 Pa makes a meniscus of 0.17 nm at most, less than a molecule of water.
TEST(StatedValues, NoBridgeInVacuum) {
  EXPECT_EQ(stated("capillary", 0, Condition::ambient_pressure, 0.0), 0.0);
  EXPECT_EQ(stated("capillary", 0, Condition::ambient_pressure, 99.0), 0.0);
  EXPECT_EQ(stated("capillary", 0, Condition::ambient_pressure, 101325.0), std::nullopt);
  Conditions both;
  both.set(Condition::ambient_pressure, 1.0);
  both.set(Condition::relative_humidity, 0.9);
  const auto said =
      stated_value(find_mechanism("capillary")->info.parameters.front(), one_point::kSoft, both);
  EXPECT_EQ(said->value, 0.0);
  EXPECT_EQ(said->by, Condition::ambient_pressure);
}

/// A rubber ball of 40 mm (5 MPa, nu 0.49, 1100 kg/m3) at 1 m/s on glass (70 GPa, 0.22, 2500 kg/m3)
/// touches for 2.943275 n / V = 3.139 ms; shear waves of 3387.5 m/s cross 5.32 m of glass twice.
TEST(StatedValues, APlateIsThickWhenNoWaveComesBackInTime) {
  ImpactSystem system;
  system.particle = {"rubber", 1100.0, 5e6, 0.49, {}};
  system.surface = {"glass", 2500.0, 70e9, 0.22, {}};
  system.reference_diameter = 0.04;
  const Surroundings at = one_point::around(system);
  const double H =
      find_mechanism("plate_flexure")->info.taken_away->least(plain_sphere(at, 0.04, 1.0, 0));
  EXPECT_NEAR(H / 5.316503, 1.0, 1e-5);
}

/// A wafer of silicon, 0.5 mm: (4 / sqrt(3)) (0.5 mm)^2 (131 GPa 2330 kg/m3 / (1 - 0.28^2))^(1/2)
/// = 10.507 kg/s.
TEST(StatedValues, APlateYieldsByItsThickness) {
  ImpactSystem wafer = one_point::fluorescein();
  wafer.surface = {"silicon", 2330.0, 131e9, 0.28, {}};
  const Surroundings at = one_point::around(wafer);
  EXPECT_NEAR(stated("plate_flexure", 0, Condition::target_thickness, 0.5e-3, at).value(),
              1.0 / 10.507, 1e-5);
  EXPECT_NEAR(stated("plate_flexure", 0, Condition::target_thickness, 1e-3, at).value(),
              0.25 / 10.507, 1e-5);
  wafer.surface.density = 0.0;  // not stated: nobody knows how heavy it is
  EXPECT_EQ(stated("plate_flexure", 0, Condition::target_thickness, 1e-3, one_point::around(wafer)),
            std::nullopt);
}

TEST(StatedValues, SomeConditionsOnlyTakeAway) {
  EXPECT_EQ(stated("electrostatic_image", 0, Condition::neutralised, 1.0), 0.0);
  EXPECT_EQ(stated("electrostatic_image", 0, Condition::neutralised, 0.0), std::nullopt);
  EXPECT_EQ(stated("velocity_offset", 0, Condition::velocities_calibrated, 1.0), 0.0);
  EXPECT_EQ(stated("velocity_offset", 0, Condition::velocities_calibrated, 0.0), std::nullopt);
  EXPECT_EQ(stated("size_calibration", 0, Condition::sizes_calibrated, 1.0), 0.0);
  EXPECT_EQ(stated("polydispersity", 0, Condition::sizes_equal, 1.0), 0.0);
  EXPECT_EQ(stated("polydispersity", 0, Condition::sizes_equal, 0.0), std::nullopt);
  EXPECT_EQ(stated("height_origin", 0, Condition::velocities_calibrated, 1.0), 0.0);
  EXPECT_EQ(stated("asperity_loss", 0, Condition::surface_rms_roughness, 5e-10), 0.0);
  EXPECT_EQ(stated("asperity_loss", 0, Condition::surface_rms_roughness, 5e-8), std::nullopt);
  EXPECT_EQ(stated("probe_plane", 0, Condition::probe_height, 0.0), 0.0);
  EXPECT_EQ(stated("probe_plane", 0, Condition::probe_height, 1e-3), std::nullopt);
}

/// Whatever a condition takes away does nothing at the value that the catalogue advises.
TEST(StatedValues, WhatIsAdvisedTakesAway) {
  int advised = 0;
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    if (!mechanism.info.taken_away) continue;
    ++advised;
    const Parameter& strength = mechanism.info.parameters.front();
    ASSERT_FALSE(strength.stated_by.empty()) << mechanism.info.id;
    Conditions changed;
    changed.set(mechanism.info.taken_away->condition, mechanism.info.taken_away->value);
    const auto value = stated_value(strength, one_point::kSoft, changed);
    ASSERT_TRUE(value) << mechanism.info.id;
    EXPECT_LT(std::abs(value->value - strength.null_value),
              1e-3 * (strength.initial - strength.null_value))
        << mechanism.info.id;
  }
  EXPECT_GE(advised, 7);
}

}  // namespace
}  // namespace recoil
