#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "data/datapackage.hpp"
#include "data/dataset.hpp"
#include "support/dataset_folder.hpp"

namespace recoil {
namespace {

using example::DatasetFolder;
using support::changed;

TEST(LoadDataset, ConvertsEveryColumnToSi) {
  const DatasetFolder folder;
  const Dataset dataset = load_dataset(folder.path());
  ASSERT_EQ(dataset.points.size(), 4U);
  const ImpactPoint& first = dataset.points[0];
  EXPECT_DOUBLE_EQ(first.diameter, 1.27e-6);
  EXPECT_DOUBLE_EQ(first.incident_velocity, 2.5);
  EXPECT_DOUBLE_EQ(first.restitution, 0.71);
  EXPECT_DOUBLE_EQ(first.restitution_sd.value(), 0.015);
  EXPECT_DOUBLE_EQ(first.velocity_sd.value(), 0.04);
  EXPECT_EQ(first.events, 40);
  EXPECT_EQ(first.captured, 3);
  EXPECT_FALSE(first.all_captured());
  EXPECT_EQ(first.line, 2);
}

TEST(LoadDataset, ReadsTheSizesOverWhichPointsAverage) {
  const DatasetFolder folder;
  const Dataset one_size = load_dataset(folder.path());
  EXPECT_FALSE(one_size.mixed_sizes);
  const std::string package = read_text_file(folder.path() / "datapackage.json");
  write_whole_file(folder.path() / "datapackage.json",
                   changed(package, "\"provenance\"", "\"mixed_sizes\": \"s.csv\", \"provenance\""),
                   Replacing::data);
  EXPECT_THROW(load_dataset(folder.path()), InputError);  // no such file
  write_whole_file(folder.path() / "s.csv", "lower,upper,count\n1,2,3\n2,4,1\n");
  const Dataset mixed = load_dataset(folder.path());
  ASSERT_TRUE(mixed.mixed_sizes);
  EXPECT_NEAR(mixed.mixed_sizes->mean_diameter(), (3 * 1.5e-6 + 3e-6) / 4.0, 1e-18);
  write_whole_file(folder.path() / "s.csv", "lower,upper,count\n1,2,3\n2,4,2\n", Replacing::data);
  EXPECT_NE(load_dataset(folder.path()).sha256, mixed.sha256);
  // Of another dataset they are not taken over.
  EXPECT_FALSE(stated_system(folder.path()).contains("mixed_sizes"));
}

TEST(LoadDataset, KnowsCapturedPointsAndDefaults) {
  const DatasetFolder folder;
  const Dataset dataset = load_dataset(folder.path());
  EXPECT_TRUE(dataset.points[1].all_captured());
  EXPECT_EQ(dataset.points[1].restitution, 0.0);
  EXPECT_FALSE(dataset.points[1].restitution_sd.has_value());
  EXPECT_EQ(dataset.points[2].events, 1);
  EXPECT_EQ(dataset.points[2].captured, 0);
  EXPECT_EQ(dataset.series, (std::vector<std::string>{"small", "large, coated"}));
  EXPECT_EQ(dataset.points[2].series, 1U);
  EXPECT_EQ(dataset.points[3].series, 0U);
  EXPECT_TRUE(dataset.warnings.empty());
}

TEST(LoadDataset, ReadsThePackage) {
  const DatasetFolder folder;
  const Dataset dataset = load_dataset(folder.path());
  EXPECT_EQ(dataset.id, "example-quartz");
  EXPECT_EQ(dataset.title, "Spheres on quartz");
  EXPECT_EQ(dataset.provenance, Provenance::measured);
  EXPECT_EQ(dataset.sources, (std::vector<std::string>{"A paper, https://example.org/paper"}));
  EXPECT_EQ(dataset.system.particle.name, "polystyrene");
  EXPECT_EQ(dataset.system.particle.density, 1050.0);
  EXPECT_EQ(dataset.system.surface.youngs_modulus, 73e9);
  EXPECT_EQ(dataset.system.surface.poisson_ratio, 0.17);
  EXPECT_FALSE(dataset.system.particle.surface_energy.has_value());
  EXPECT_FALSE(dataset.system.stiffness_K.has_value());
  EXPECT_EQ(dataset.columns.size(), 8U);
  EXPECT_EQ(dataset.columns[4].unit, "%");
  EXPECT_EQ(dataset.folder, folder.path());
}

TEST(LoadDataset, TheDensityOfTheSurfaceIsOptional) {
  EXPECT_EQ(load_dataset(DatasetFolder().path()).system.surface.density, 0.0);
  const DatasetFolder folder(
      changed(example::package, "\"surface\": {", "\"surface\": {\"density\": 2200,"));
  EXPECT_EQ(load_dataset(folder.path()).system.surface.density, 2200.0);
}

TEST(LoadDataset, ReadsTheConditions) {
  const DatasetFolder plain;
  EXPECT_EQ(load_dataset(plain.path()).system.conditions.of(Condition::ambient_pressure),
            std::nullopt);
  const DatasetFolder folder(
      changed(example::package, "\"surface\": {",
              "\"conditions\": {\"ambient_pressure\": 0, \"temperature\": 293}, \"surface\": {"));
  const Conditions stated = load_dataset(folder.path()).system.conditions;
  EXPECT_EQ(stated.of(Condition::ambient_pressure), 0.0);
  EXPECT_EQ(stated.of(Condition::temperature), 293.0);
  EXPECT_EQ(stated.of(Condition::neutralised), std::nullopt);
}

TEST(LoadDataset, ReadsTheOverrides) {
  const DatasetFolder folder(
      changed(example::package, "\"provenance\": \"measured\",",
              "\"provenance\": \"digitised\", \"stiffness_K\": 3.745e9, \"adhesion_energy\": 0,\n"
              "\"adhesion_force_f0\": 5.74, \"reference_diameter\": 1.28e-6,\n"
              "\"conditions\": { \"ambient_pressure\": 50 },"));
  const Dataset dataset = load_dataset(folder.path());
  EXPECT_EQ(dataset.system.conditions.of(Condition::ambient_pressure), 50.0);
  EXPECT_EQ(dataset.provenance, Provenance::digitised);
  EXPECT_EQ(dataset.system.stiffness_K.value(), 3.745e9);
  EXPECT_EQ(dataset.system.adhesion_energy.value(), 0.0);
  EXPECT_EQ(dataset.system.adhesion_force_f0.value(), 5.74);
  EXPECT_EQ(dataset.system.reference_diameter.value(), 1.28e-6);
}

TEST(StatedSystem, LeavesTheConditionsOfTheOtherExperiment) {
  const DatasetFolder folder(changed(example::package, "\"provenance\": \"measured\",",
                                     "\"provenance\": \"measured\", \"adhesion_energy\": 0.1,\n"
                                     "\"conditions\": { \"ambient_pressure\": 50 },"));
  const Json system = stated_system(folder.path());
  EXPECT_EQ(system["adhesion_energy"], 0.1);
  EXPECT_TRUE(system.contains("particle"));
  EXPECT_FALSE(system.contains("conditions"));
  EXPECT_FALSE(system.contains("provenance"));
}

TEST(LoadDataset, DividesReboundByIncidentVelocity) {
  const DatasetFolder folder(
      changed(example::package, R"("name": "restitution", "type": "number", "unit": "1")",
              R"("name": "rebound_velocity", "type": "number", "unit": "cm/s")"),
      "series,diameter,incident_velocity,rebound_velocity,restitution_sd,velocity_sd,events,"
      "captured\na,4.9,2.5,200,2,,,\na,4.9,1,0,,,3,3\na,4.9,1,,,,3,3\n");
  const Dataset dataset = load_dataset(folder.path());
  EXPECT_DOUBLE_EQ(dataset.points[0].restitution, 0.8);
  EXPECT_DOUBLE_EQ(dataset.points[0].restitution_sd.value(), 0.02);
  EXPECT_TRUE(dataset.points[1].all_captured());
  EXPECT_EQ(dataset.points[1].restitution, 0.0);
  EXPECT_TRUE(dataset.points[2].all_captured());
}

TEST(LoadDataset, ReadsErrorsOfTheDiameter) {
  const DatasetFolder folder(
      changed(example::package, R"("name": "velocity_sd", "type": "number", "unit": "cm/s")",
              R"("name": "diameter_sd", "type": "number", "unit": "um")"),
      "series,diameter,incident_velocity,restitution,restitution_sd,diameter_sd,events,captured\n"
      "a,4.9,2.5,0.8,,0.1,40,\na,4.9,2.5,0.7,,,40,0\n");
  const Dataset dataset = load_dataset(folder.path());
  EXPECT_DOUBLE_EQ(dataset.points[0].diameter_sd.value(), 1e-7);
  EXPECT_FALSE(dataset.points[1].diameter_sd.has_value());
  EXPECT_FALSE(dataset.points[0].counted) << "an empty cell is no count";
  EXPECT_TRUE(dataset.points[1].counted);
}

TEST(LoadDataset, TheOrderOfColumnsAndLineEndingsDoNotMatter) {
  const DatasetFolder folder(
      example::package,
      "captured,events,velocity_sd,restitution_sd,restitution,incident_velocity,diameter,series\r\n"
      "\r\n3 , 40,4,1.5, 0.71,2.5,\t1.27,\" small \"\r\n");
  const Dataset dataset = load_dataset(folder.path());
  ASSERT_EQ(dataset.points.size(), 1U);
  EXPECT_EQ(dataset.series[0], " small ") << "quoted blanks belong to the name";
  EXPECT_DOUBLE_EQ(dataset.points[0].diameter, 1.27e-6);
  EXPECT_EQ(dataset.points[0].captured, 3);
  EXPECT_EQ(dataset.points[0].line, 3);
}

TEST(LoadDataset, HonoursFrictionlessDelimiterAndMissingValues) {
  const DatasetFolder folder(
      changed(example::package, "\"path\": \"points.csv\",",
              "\"path\": \"points.csv\", \"dialect\": { \"delimiter\": \";\" },"),
      "series;diameter;incident_velocity;restitution;restitution_sd;velocity_sd;events;"
      "captured\n"
      "a;1.27;2.5;0.71;;;;\n");
  EXPECT_EQ(load_dataset(folder.path()).points.size(), 1U);

  const DatasetFolder missing(changed(example::package, "\"schema\": {",
                                      "\"schema\": { \"missingValues\": [\"\", \"NA\"],"),
                              changed(example::points, "0.912,,", "0.912,NA,"));
  EXPECT_FALSE(load_dataset(missing.path()).points[2].restitution_sd.has_value());
}

/// A dataset of the columns series, diameter [um], incident_velocity [mm/s], restitution and
/// events.
/// @param keys more keys of every number's field: ", \"decimalChar\": \",\""
std::string package_of_numbers(const std::string& keys, const std::string& dialect) {
  std::string fields = R"({ "name": "series", "type": "string" })";
  for (const char* const field :
       {R"("diameter", "type": "number", "unit": "um")",
        R"("incident_velocity", "type": "number", "unit": "mm/s")",
        R"("restitution", "type": "number", "unit": "1")", R"("events", "type": "integer")"}) {
    fields += fmt::format(R"(, {{ "name": {}{} }})", field, keys);
  }
  return fmt::format(
      R"({{ "name": "numbers", "resources": [ {{ "path": "points.csv", "dialect": {{ {} }},
         "schema": {{ "fields": [ {} ] }} }} ], "recoil": {{ "provenance": "synthetic",
         "particle": {{ "material": "ps", "density": 1050, "youngs_modulus": 2.56e9,
                        "poisson_ratio": 0.35 }},
         "surface": {{ "material": "si", "youngs_modulus": 131e9, "poisson_ratio": 0.28 }} }} }})",
      dialect, fields);
}

constexpr const char* german = R"(, "decimalChar": ",", "groupChar": ".")";
constexpr const char* semicolons = R"("delimiter": ";")";
constexpr const char* numbers_header = "series;diameter;incident_velocity;restitution;events\n";

TEST(LoadDataset, NumbersAreReadWithTheMarksThatTheFieldsState) {
  // Table Schema: groupChar groups digits, so that 2.500 mm/s is 2.5 m/s.
  const Dataset dataset = parse_dataset(package_of_numbers(german, semicolons),
                                        numbers_header + std::string("a;4,9;2.500;0,57;20\n"
                                                                     "a;4,9;1.002.500,5;0,73;20\n"),
                                        "numbers");
  EXPECT_DOUBLE_EQ(dataset.points[0].diameter, 4.9e-6);
  EXPECT_DOUBLE_EQ(dataset.points[0].incident_velocity, 2.5);
  EXPECT_DOUBLE_EQ(dataset.points[0].restitution, 0.57);
  EXPECT_DOUBLE_EQ(dataset.points[1].incident_velocity, 1002.5005);
  for (const char* const cell : {"2.50", "25.00", "2.5000", "2,5,0", ".500", "2500.", "1.25.000"}) {
    EXPECT_THAT(support::message_of([&] {
                  parse_dataset(package_of_numbers(german, semicolons),
                                fmt::format("{}a;4,9;{};0,57;20\n", numbers_header, cell),
                                "numbers");
                }),
                testing::HasSubstr("is not a number"))
        << cell;
  }
}

TEST(LoadDataset, TheDialectIsHonoured) {
  const Dataset dataset = parse_dataset(
      package_of_numbers("", R"("delimiter": ";", "header": false, "commentChar": "#")"),
      "# \"a comment\na;4.9;2500;0.57;20\n#b;1;1;1;1\n", "numbers");
  ASSERT_EQ(dataset.points.size(), 1U);
  EXPECT_DOUBLE_EQ(dataset.points[0].incident_velocity, 2.5);
  EXPECT_EQ(dataset.points[0].events, 20);
}

TEST(LoadDataset, AFieldHasItsOwnMissingValues) {
  const std::string package =
      changed(example::package, R"("restitution_sd", "type": "number")",
              R"("restitution_sd", "type": "number", "missingValues": ["-"])");
  EXPECT_FALSE(parse_dataset(package, changed(example::points, "0.912,,", "0.912,-,"), "x")
                   .points[2]
                   .restitution_sd.has_value());
  EXPECT_THROW(parse_dataset(package, changed(example::points, ",4,40,3", ",-,40,3"), "x"),
               InputError);
}

TEST(LoadDataset, CapturedMayBeTrueOrFalse) {
  const auto package = [](const std::string& keys) {
    return changed(package_of_numbers("", ""), R"("events", "type": "integer")",
                   R"("captured", "type": "boolean")" + keys);
  };
  const auto points = [](const std::string& yes, const std::string& no) {
    return fmt::format(
        "series,diameter,incident_velocity,restitution,captured\na,4,500,,{}\na,4,2000,0.8,{}\n",
        yes, no);
  };
  for (const auto& [yes, no] : std::vector<std::pair<std::string, std::string>>{
           {"true", "false"}, {"TRUE", "FALSE"}, {"True", "False"}, {"1", "0"}}) {
    const Dataset dataset = parse_dataset(package(""), points(yes, no), "x");
    EXPECT_TRUE(dataset.points[0].all_captured());
    EXPECT_EQ(dataset.points[1].captured, 0);
  }
  const std::string own = package(R"(, "trueValues": ["yes"], "falseValues": ["no"])");
  EXPECT_TRUE(parse_dataset(own, points("yes", "no"), "x").points[0].all_captured());
  EXPECT_THAT(support::message_of([&] { parse_dataset(own, points("true", "no"), "x"); }),
              testing::HasSubstr("points.csv:2:10: 'true' is neither true nor false"));
}

TEST(LoadDataset, WhatChangesTheMeaningOfACellIsNotIgnored) {
  const auto refused = [](const std::string& keys, const std::string& dialect) {
    return support::message_of([&] {
      parse_dataset(package_of_numbers(keys, dialect),
                    numbers_header + std::string("a;4.9;2500;0.57;20\n"), "x");
    });
  };
  using testing::HasSubstr;
  EXPECT_EQ(refused("", semicolons), "no error");
  EXPECT_EQ(refused(R"(, "constraints": { "minimum": 0.1, "required": true })", semicolons),
            "no error");
  EXPECT_THAT(refused(R"(, "constraints": { "minimum": 1e6 })", semicolons),
              HasSubstr("points.csv:2:3: diameter = 4.9 (the schema's minimum is 1e+06)"));
  EXPECT_THAT(refused(R"(, "constraints": { "pattern": "x" })", semicolons),
              HasSubstr("the constraint 'pattern' is not checked"));
  EXPECT_THAT(refused(R"(, "bareNumber": false)", semicolons), HasSubstr("'bareNumber'"));
  EXPECT_THAT(refused(R"(, "format": "any")", semicolons), HasSubstr("'format'"));
  EXPECT_THAT(refused("", R"("delimiter": ";", "quoteChar": "'")"), HasSubstr("'quoteChar'"));
  EXPECT_THAT(refused("", R"("delimiter": ";", "headerRows": [2])"), HasSubstr("'headerRows'"));
}

TEST(LoadDataset, KeysThatOnlyFrictionlessKnowsAreAllowed) {
  const DatasetFolder folder(changed(example::package, "\"title\": \"Spheres on quartz\",",
                                     "\"profile\": \"tabular-data-package\", \"keywords\": [1],"));
  const Dataset dataset = load_dataset(folder.path());
  EXPECT_EQ(dataset.title, "example-quartz") << "the name stands in for a missing title";
}

TEST(LoadDataset, TheFolderNamesAPackageWithoutName) {
  const DatasetFolder folder(changed(example::package, "\"name\": \"example-quartz\",", ""));
  EXPECT_EQ(load_dataset(folder.path()).id, folder.path().filename().string());
  EXPECT_EQ(load_dataset(folder.path() / "").id, folder.path().filename().string());
}

TEST(LoadDataset, ChecksumIsOfBothTexts) {
  const DatasetFolder folder;
  const Dataset dataset = load_dataset(folder.path());
  EXPECT_EQ(dataset.sha256, sha256_hex(example::package + "\n" + example::points));
  EXPECT_EQ(parse_dataset(example::package, example::points, folder.path()).sha256, dataset.sha256);
}

TEST(LoadDataset, WarnsOncePerPeculiarity) {
  const DatasetFolder folder(example::package,
                             "series,diameter,incident_velocity,restitution,restitution_sd,"
                             "velocity_sd,events,captured\n"
                             "a,5,1,1.05,,,,\n"
                             "a,5,2,1.2,,,,\n"
                             "a,5,3,0,,,,\n"
                             "a,5,1,1.05,,,,\n"
                             "a,5000,1,0.9,,,,\n");
  const Dataset dataset = load_dataset(folder.path());
  ASSERT_EQ(dataset.points.size(), 5U);
  ASSERT_EQ(dataset.warnings.size(), 4U);
  const auto expect = [&](std::size_t i, PointRemark remark, std::size_t count, int line) {
    EXPECT_EQ(dataset.warnings[i].remark, remark);
    EXPECT_EQ(dataset.warnings[i].count, count);
    EXPECT_EQ(dataset.warnings[i].first_line, line);
  };
  expect(0, PointRemark::restitution_above_one, 3, 2);
  expect(1, PointRemark::unmarked_zero, 1, 4);
  expect(2, PointRemark::unusual_diameter, 1, 6);
  expect(3, PointRemark::repeated, 1, 5);
}

TEST(LoadDataset, WarnsOfUnitsThatContradictEachOther) {
  const std::string header =
      "series,diameter,incident_velocity,restitution,restitution_sd,velocity_sd,events,captured\n";
  const auto warnings = [&](const std::string& rows) {
    return load_dataset(DatasetFolder(example::package, header + rows).path()).warnings;
  };
  // Errors in mm/s beside velocities in m/s; e in per cent that is called a ratio of per cent.
  const auto errors = warnings("a,5,0.1,0.5,,300,,\na,5,2,0.6,,0.2,,\n");
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].remark, PointRemark::error_above_velocity);
  EXPECT_EQ(errors[0].count, 1U);
  const auto tiny = warnings("a,5,1,0.005,,,,\na,5,2,0.007,,,,\na,5,0.1,,,,3,3\n");
  ASSERT_EQ(tiny.size(), 1U);
  EXPECT_EQ(tiny[0].remark, PointRemark::tiny_restitution);
  EXPECT_EQ(tiny[0].count, 2U);
  EXPECT_TRUE(warnings("a,5,1,0.005,,,,\na,5,2,0.6,,0.2,,\n").empty());
}

TEST(LoadDataset, ARestitutionOfZeroIsACapture) {
  const std::string header =
      "series,diameter,incident_velocity,restitution,restitution_sd,velocity_sd,events,captured\n";
  const Dataset dataset = load_dataset(
      DatasetFolder(example::package, header + "a,5,1,0,0.01,,,\na,5,2,0,,,20,\na,5,3,0.5,,,,\n")
          .path());
  EXPECT_EQ(dataset.points[0].captured, 1);
  EXPECT_EQ(dataset.points[1].captured, 20);
  EXPECT_EQ(dataset.points[2].captured, 0);
  ASSERT_EQ(dataset.warnings.size(), 1U);
  EXPECT_EQ(dataset.warnings[0].remark, PointRemark::unmarked_zero);
  EXPECT_EQ(dataset.warnings[0].count, 2U);
  // A capture that is marked needs no word, and one that is denied is a contradiction.
  EXPECT_TRUE(load_dataset(
                  DatasetFolder(example::package, header + "a,5,1,0,,,,1\na,5,2,,,,20,20\n").path())
                  .warnings.empty());
  for (const std::string row : {"a,5,1,0,,,,0\n", "a,5,1,0,,,20,5\n"}) {
    const DatasetFolder folder(example::package, header + row);
    EXPECT_NE(support::message_of([&] {
                load_dataset(folder.path());
              }).find("points.csv:2:7: a rebound of 0 although 'captured' is "),
              std::string::npos)
        << row;
  }
}

TEST(LoadDataset, SaysThatThePointsAreAnotherFile) {
  const auto warns = [](const std::string& stated) {
    const DatasetFolder folder(changed(example::package, "\"path\": \"points.csv\"",
                                       "\"path\": \"points.csv\", " + stated));
    const Dataset dataset = load_dataset(folder.path());
    return !dataset.warnings.empty() && dataset.warnings.back().remark == PointRemark::other_bytes;
  };
  const std::string right = sha256_hex(example::points);
  EXPECT_FALSE(warns("\"bytes\": " + std::to_string(example::points.size())));
  EXPECT_TRUE(warns("\"bytes\": " + std::to_string(example::points.size() + 1)));
  EXPECT_FALSE(warns("\"hash\": \"sha256:" + right + "\""));
  EXPECT_TRUE(warns("\"hash\": \"sha256:" + right.substr(1) + "0\""));
  EXPECT_TRUE(warns("\"hash\": \"d41d8cd98f00b204e9800998ecf8427e\""));  // md5 of no bytes
  const DatasetFolder folder(changed(example::package, "\"path\": \"points.csv\"",
                                     "\"path\": \"points.csv\", \"hash\": \"crc32:0\""));
  EXPECT_NE(support::message_of([&] { load_dataset(folder.path()); }).find("a hash by 'crc32'"),
            std::string::npos);
}

TEST(LoadDataset, DistinctDiametersAscend) {
  const DatasetFolder folder;
  const auto diameters = distinct_diameters(load_dataset(folder.path()));
  ASSERT_EQ(diameters.size(), 2U);
  EXPECT_DOUBLE_EQ(diameters[0], 1.27e-6);
  EXPECT_DOUBLE_EQ(diameters[1], 4.9e-6);
}

TEST(LoadDataset, TextsWithoutFilesGiveTheSame) {
  const Dataset dataset = parse_dataset(example::package, example::points, "no/such/folder");
  EXPECT_EQ(dataset.points.size(), 4U);
  EXPECT_THROW(parse_dataset(example::package, "", "no/such/folder"), InputError);
}

TEST(LoadDataset, ReadsTheErrorsOfConstants) {
  using recoil::Body;
  using recoil::Constant;
  const DatasetFolder folder(support::changed(
      support::changed(example::package, "1050", R"({ "value": 1050, "sd": 10 })"), "0.17",
      R"({ "value": 0.17, "sd": 0.01 }, "surface_energy": { "value": 0.3, "relative_sd": 0.5 })"));
  const recoil::ImpactSystem system = recoil::load_dataset(folder.path()).system;
  EXPECT_EQ(system.particle.density, 1050.0);
  EXPECT_EQ(system.error_of(Body::particle, Constant::density), 10.0);
  EXPECT_EQ(system.surface.poisson_ratio, 0.17);
  EXPECT_EQ(system.error_of(Body::surface, Constant::poisson_ratio), 0.01);
  EXPECT_EQ(system.surface.surface_energy, 0.3);
  EXPECT_EQ(system.error_of(Body::surface, Constant::surface_energy), 0.15);
  EXPECT_EQ(system.error_of(Body::surface, Constant::youngs_modulus), 0.0);
}

TEST(LoadDataset, ReadsStrengthAndPermittivity) {
  const DatasetFolder folder(support::changed(
      support::changed(example::package, "1050", R"(1050, "yield_strength": 40e6)"), "0.17",
      R"(0.17, "hardness": 9e9, "yield_strength": 1e9, "relative_permittivity": 3.8)"));
  const recoil::ImpactSystem system = recoil::load_dataset(folder.path()).system;
  EXPECT_EQ(system.particle.yield_pressure(), 112e6);  // 2.8 times (Tabor)
  EXPECT_EQ(system.surface.yield_pressure(), 9e9);
  EXPECT_EQ(system.surface.relative_permittivity, 3.8);
  const DatasetFolder plain(example::package);
  EXPECT_FALSE(recoil::load_dataset(plain.path()).system.surface.yield_pressure());
}

TEST(LoadDataset, ALinkToAFileElsewhereIsNotRead) {
  const DatasetFolder folder(example::package);
  const support::TemporaryFolder other;
  other.write("secret", "the secret line\n");
  std::filesystem::rename(folder / "points.csv", folder / "own.csv");
  std::filesystem::create_symlink("own.csv", folder / "points.csv");
  EXPECT_NO_THROW(recoil::load_dataset(folder.path()));
  std::filesystem::remove(folder / "points.csv");
  std::filesystem::create_symlink(other / "secret", folder / "points.csv");
  const std::string told = support::message_of([&] { recoil::load_dataset(folder.path()); });
  EXPECT_EQ(told.find("the secret line"), std::string::npos) << told;
  EXPECT_NE(told, "no error");
}

TEST(LoadDataset, ReadsManySeriesInATimeInProportionToTheirNumber) {
  // Were every series compared with every other one, this would take minutes.
  std::string points =
      "series,diameter,incident_velocity,restitution,restitution_sd,velocity_sd,events,captured\n";
  for (int i = 0; i < 100000; ++i) points += fmt::format("s{},4.9,2.5,0.8,,,,\n", i);
  const DatasetFolder folder(example::package, points);
  EXPECT_EQ(load_dataset(folder.path()).series.size(), 100000U);
}

}  // namespace
}  // namespace recoil
