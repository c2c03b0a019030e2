// Oblique impacts: the component along the normal is read, and what has no meaning is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data/dataset.hpp"
#include "support/dataset_folder.hpp"

namespace example {
namespace {

using recoil::Dataset;
using recoil::load_dataset;
using recoil::PointRemark;
using support::changed;

const std::string oblique_fields = R"({ "name": "series", "type": "string" },
        { "name": "diameter", "type": "number", "unit": "um" },
        { "name": "incident_velocity", "type": "number", "unit": "m/s" },
        { "name": "incidence_angle", "type": "number", "unit": "deg" },
        { "name": "restitution", "type": "number", "unit": "1" },
        { "name": "tangential_restitution", "type": "number", "unit": "1" },
        { "name": "velocity_sd", "type": "number", "unit": "m/s" },
        { "name": "setting_velocity_sd", "type": "number", "unit": "m/s" },
        { "name": "events", "type": "integer" },
        { "name": "captured", "type": "integer" })";

const std::string oblique_rows =
    "series,diameter,incident_velocity,incidence_angle,restitution,tangential_restitution,"
    "velocity_sd,setting_velocity_sd,events,captured\n"
    "a,5,2,60,0.8,0.9,0.1,0.04,10,0\n"
    "a,5,3,0,0.7,,0.1,,10,0\n"
    "a,5,1,30,,,0.02,,10,10\n"
    "a,5,4,8,0.9,0.71,,,10,0\n";

/// The package of `oblique_rows`.
std::string oblique_package() {
  const std::size_t first = package.find("{ \"name\": \"series\"");
  const std::size_t end = package.find("\n      ]", first);
  return package.substr(0, first) + oblique_fields + package.substr(end);
}

TEST(IncidenceAngle, TheNormalComponentAndItsErrorsAreRead) {
  const Dataset dataset = load_dataset(DatasetFolder(oblique_package(), oblique_rows).path());
  const double root = std::sqrt(3.0);
  ASSERT_EQ(dataset.points.size(), 4U);
  EXPECT_NEAR(dataset.points[0].incident_velocity, 1.0, 1e-15);  // 2 cos(60 deg)
  EXPECT_NEAR(dataset.points[0].velocity_sd.value(), 0.05, 1e-16);
  EXPECT_NEAR(dataset.points[0].setting_velocity_sd.value(), 0.02, 1e-16);
  EXPECT_NEAR(dataset.points[0].incidence_angle, std::numbers::pi / 3.0, 1e-15);
  EXPECT_EQ(dataset.points[0].restitution, 0.8);
  EXPECT_EQ(dataset.points[0].tangential_restitution, 0.9);
  EXPECT_EQ(dataset.points[1].incident_velocity, 3.0);  // along the normal: unchanged to the bit
  EXPECT_EQ(dataset.points[1].velocity_sd, 0.1);
  EXPECT_EQ(dataset.points[1].tangential_restitution, std::nullopt);
  EXPECT_TRUE(dataset.points[2].all_captured());
  EXPECT_NEAR(dataset.points[2].incident_velocity, root / 2.0, 1e-15);
  EXPECT_NEAR(dataset.points[2].velocity_sd.value(), 0.01 * root, 1e-16);
}

TEST(IncidenceAngle, RadiansAreAUnit) {
  const DatasetFolder folder(
      changed(oblique_package(), "\"deg\"", "\"rad\""),
      changed(changed(changed(oblique_rows, "2,60", "2,1.2"), "1,30", "1,0.5"), "4,8,0.9",
              "4,0.1,0.9"));
  EXPECT_NEAR(load_dataset(folder.path()).points[0].incident_velocity, 2.0 * std::cos(1.2), 1e-15);
}

TEST(IncidenceAngle, TheReboundVelocityIsComparedWithTheNormalComponent) {
  const std::string with_rebound =
      changed(oblique_package(), "\"restitution\", \"type\": \"number\", \"unit\": \"1\"",
              "\"rebound_velocity\", \"type\": \"number\", \"unit\": \"m/s\"");
  const std::string of_rebound =
      changed(oblique_rows, "angle,restitution", "angle,rebound_velocity");
  EXPECT_NEAR(load_dataset(DatasetFolder(with_rebound, of_rebound).path()).points[0].restitution,
              0.8, 1e-15);  // 0.8 m/s over 1 m/s
  DatasetFolder(with_rebound, changed(of_rebound, "60,0.8", "60,1.3"))
      .expect({"", "", "", "points.csv:2:10: ", "rebound_velocity = 1.3", "normal component"});
}

TEST(IncidenceAngle, ManyDegreesAreRemarked) {
  const Dataset dataset = load_dataset(DatasetFolder(oblique_package(), oblique_rows).path());
  ASSERT_EQ(dataset.warnings.size(), 1U);  // 60 and 30 degrees, not 8 and 0
  EXPECT_EQ(dataset.warnings[0].remark, PointRemark::oblique);
  EXPECT_EQ(dataset.warnings[0].count, 2U);
  EXPECT_EQ(dataset.warnings[0].first_line, 2);
  EXPECT_NEAR(dataset.warnings[0].largest, std::numbers::pi / 3.0, 1e-15);
}

TEST(IncidenceAngle, WhatHasNoMeaningIsOneClearLine) {
  const auto expect_of_points = [](const std::string& old_text, const std::string& new_text,
                                   const std::string& begin, const std::string& word,
                                   const std::string& hint) {
    SCOPED_TRACE(new_text);
    DatasetFolder(oblique_package(), changed(oblique_rows, old_text, new_text))
        .expect({"", "", "", begin, word, hint});
  };
  expect_of_points("2,60", "2,90", "points.csv:2:7: ", "incidence_angle = 90 deg",
                   "from the normal, below 90 deg");
  expect_of_points("2,60", "2,-60", "points.csv:2:7: ", "it cannot be negative", "magnitude");
  expect_of_points("2,60", "2,120",
                   "points.csv:2:7: ", "120 deg it has to lie between 0 and 90 deg",
                   "from the normal, below 90 deg");
  expect_of_points("2,60", "2,", "points.csv:2:7: ", "'incidence_angle' is empty", "write 0");
  expect_of_points("2,60", "2,89.999999", "points.csv:2:7: ", "a normal velocity of 3.49",
                   "from the normal");
  expect_of_points("0.7,,", "0.7,0.9,", "points.csv:3:13: ", "at an angle of 0",
                   "leave the cell empty");
  expect_of_points("1,30,,,", "1,30,,0.8,", "points.csv:4:11: ", "although all were captured",
                   "leave the cell empty");
  expect_of_points("0.8,0.9", "0.8,90", "points.csv:2:14: ", "tangential_restitution = 90",
                   "in per cent");
  expect_of_points("0.8,0.9", "0.8,-1.5", "points.csv:2:14: ", "between -1 and 1.2", "in per cent");
}

TEST(IncidenceAngle, TheSchemaStatesItsUnit) {
  DatasetFolder(changed(oblique_package(), ", \"unit\": \"deg\"", ""), oblique_rows)
      .expect({"", "", "", "datapackage.json:13:9: ", "'unit' is missing", "use rad, deg"});
  DatasetFolder(changed(oblique_package(), "\"deg\"", "\"um\""), oblique_rows)
      .expect({"", "", "", "datapackage.json:13:", "'incidence_angle' in 'um'", "deg"});
  const std::string without =
      changed(oblique_package(),
              "\n        { \"name\": \"incidence_angle\", \"type\": \"number\", "
              "\"unit\": \"deg\" },",
              "");
  DatasetFolder(without, oblique_rows)
      .expect({"", "", "", "datapackage.json:14:19: ", "without 'incidence_angle'",
               "add the column incidence_angle"});
}

}  // namespace
}  // namespace example
