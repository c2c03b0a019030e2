// Conditions of all points and of single ones: how they are read, and which series they make.
#include <gtest/gtest.h>

#include "data/dataset.hpp"
#include "support/dataset_folder.hpp"

namespace recoil {
namespace {

using example::DatasetFolder;
using support::changed;

std::string with_fields(const std::string& fields) {
  return changed(example::package, R"({ "name": "captured", "type": "integer" })",
                 R"({ "name": "captured", "type": "integer" }, )" + fields);
}

const std::string kHeader =
    "series,diameter,incident_velocity,restitution,restitution_sd,velocity_sd,events,captured,";

TEST(Conditions, OfPointsOverrideThoseOfAll) {
  const DatasetFolder folder(
      changed(with_fields(R"({ "name": "ambient_pressure", "type": "number", "unit": "kPa" })"),
              "\"surface\": {",
              "\"conditions\": {\"ambient_pressure\": 50, \"temperature\": 293}, \"surface\": {"),
      kHeader + "ambient_pressure\na,4.9,2.5,0.8,,,,,101.325\nb,4.9,2.5,0.7,,,,,\n");
  const Dataset dataset = load_dataset(folder.path());
  EXPECT_EQ(dataset.series, (std::vector<std::string>{"a", "b"}));
  EXPECT_DOUBLE_EQ(conditions_of(dataset, 0).of(Condition::ambient_pressure).value(), 101325.0);
  EXPECT_EQ(conditions_of(dataset, 1).of(Condition::ambient_pressure), 50.0);
  EXPECT_EQ(conditions_of(dataset, 0).of(Condition::temperature), 293.0);
  EXPECT_EQ(conditions_of(dataset, 0).of(Condition::neutralised), std::nullopt);
}

TEST(Conditions, TellPointsOfOneSeriesApart) {
  const DatasetFolder folder(
      with_fields(R"({ "name": "ambient_pressure", "type": "number", "unit": "Pa" },
                     { "name": "relative_humidity", "type": "number", "unit": "%" })"),
      kHeader +
          "ambient_pressure,relative_humidity\na,4.9,2.5,0.8,,,,,1e5,40\na,4.9,3.5,0.8,,,,,10,40\n"
          "a,4.9,4.5,0.8,,,,,1e5,40\nb,4.9,2.5,0.7,,,,,10,40\n");
  const Dataset dataset = load_dataset(folder.path());
  // Named by what differs, and only where something does.
  EXPECT_EQ(dataset.series, (std::vector<std::string>{"a (ambient_pressure 100000 Pa)",
                                                      "a (ambient_pressure 10 Pa)", "b"}));
  EXPECT_EQ(dataset.points[0].series, 0U);
  EXPECT_EQ(dataset.points[1].series, 1U);
  EXPECT_EQ(dataset.points[2].series, 0U);
  EXPECT_DOUBLE_EQ(conditions_of(dataset, 2).of(Condition::relative_humidity).value(), 0.4);
}

TEST(Conditions, EachMayBeAColumn) {
  struct Cell {
    Condition condition;
    const char* unit;
    const char* value;
  };
  const std::vector<Cell> cells = {{Condition::ambient_pressure, "Pa", "1e5"},
                                   {Condition::relative_humidity, "1", "0.5"},
                                   {Condition::temperature, "K", "293"},
                                   {Condition::target_thickness, "m", "0.01"},
                                   {Condition::probe_height, "m", "0.001"},
                                   {Condition::neutralised, "1", "1"},
                                   {Condition::surface_rms_roughness, "m", "1e-9"},
                                   {Condition::velocities_calibrated, "1", "1"},
                                   {Condition::sizes_calibrated, "1", "1"},
                                   {Condition::film_thickness, "m", "1e-9"},
                                   {Condition::sizes_equal, "1", "1"}};
  ASSERT_EQ(cells.size(), values_of<Condition>().size());
  for (const auto& [condition, unit, value] : cells) {
    const std::string name(name_of(condition));
    const DatasetFolder folder(
        with_fields("{ \"name\": \"" + name + "\", \"type\": \"number\", \"unit\": \"" + unit +
                    "\" }"),
        kHeader + name + "\na,4.9,2.5,0.8,,,,," + value + "\n");
    EXPECT_EQ(conditions_of(load_dataset(folder.path()), 0).of(condition), std::stod(value))
        << name;
  }
}

TEST(Conditions, ASettingIsATextWithoutAUnit) {
  const DatasetFolder folder(with_fields(R"({ "name": "setting", "type": "string" })"),
                             kHeader + "setting\na,4.9,2.5,0.8,,,,,monday\na,4.9,2.5,0.7,,,,,\n");
  const Dataset dataset = load_dataset(folder.path());
  EXPECT_EQ(dataset.points[0].setting, "monday");
  EXPECT_EQ(dataset.points[1].setting, "");
}

TEST(Conditions, MistakesSayWhatIsMeant) {
  const auto all = [](const std::string& conditions) {
    return changed(example::package, "\"surface\": {",
                   "\"conditions\": {" + conditions + "}, \"surface\": {");
  };
  const auto expect = [](const DatasetFolder& folder, const std::string& word,
                         const std::string& hint) {
    folder.expect({"", "", "", "datapackage.json:", word, hint});
  };
  expect(DatasetFolder(all("\"relative_humidity\": 50")), "relative_humidity = 50",
         "50 % is written 0.5");
  expect(DatasetFolder(all("\"neutralised\": 0.5")), "neutralised = 0.5",
         "1 means neutralised, 0 that they were not");
  expect(DatasetFolder(all("\"ambient_presure\": 10")), "ambient_presure", "ambient_pressure");
  expect(DatasetFolder(
             with_fields(R"({ "name": "target_thickness", "type": "number", "unit": "Pa" })"),
             kHeader + "target_thickness\na,4.9,2.5,0.8,,,,,1\n"),
         "that is the unit of a pressure", "use um");
}

}  // namespace
}  // namespace recoil
